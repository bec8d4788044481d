#!/usr/bin/env bash
# Reads the labels of vorocl tiles with Zarr and GDAL: check_planes.sh COMMAND
# Exits with 77 where no Python has them (Debian: python3-zarr, python3-gdal), or vorocl was built without libgeotiff.
set -euo pipefail
if ! python=$("$(dirname "$0")/find_python.sh" numpy zarr osgeo.gdal); then
  echo "Python's zarr (python3-zarr), GDAL (python3-gdal) or NumPy are not installed: skipped"
  exit 77
fi
if [ ! -e "$(dirname "$1")/vorocl_geotiff.so" ]; then
  echo "vorocl was built without libgeotiff (libgeotiff-dev): skipped"
  exit 77
fi
exec "$python" "$(dirname "$0")/check_planes.py" "$1"
