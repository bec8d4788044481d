#!/usr/bin/env bash
# Reads the labels of vorocl tiles with Zarr and GDAL: check_planes.sh COMMAND
# Exits with 77 where no Python has them (Debian: python3-zarr, python3-gdal), or vorocl was built without libgeotiff.
set -euo pipefail
has_readers() { "$1" -c 'import numpy, zarr, osgeo.gdal' 2>/dev/null; }
if has_readers python3; then
  python=python3
elif has_readers /usr/bin/python3; then
  python=/usr/bin/python3
else
  echo "Python's zarr (python3-zarr), GDAL (python3-gdal) or NumPy are not installed: skipped"
  exit 77
fi
if [ ! -e "$(dirname "$1")/vorocl_geotiff.so" ]; then
  echo "vorocl was built without libgeotiff (libgeotiff-dev): skipped"
  exit 77
fi
exec "$python" "$(dirname "$0")/check_planes.py" "$1"
