#!/usr/bin/env bash
# Configures the project as where there is no libgeotiff, and checks that the error names the option that leaves it out, and
# that the option does: option_of_geotiff.sh CMAKE SOURCE FOLDER
set -euo pipefail
cmake=$1 source=$2 folder=$3

rm -rf "$folder"
configure=("$cmake" -S "$source" -B "$folder" -DVOROCL_BUILD_TESTS=OFF -DGEOTIFF_LIBRARY=)
if said=$("${configure[@]}" 2>&1); then
  echo "the project was configured without libgeotiff"
  exit 1
fi
grep -qF -- '-DVOROCL_GEOTIFF=OFF' <<<"$said" || { echo "$said"; exit 1; }

"${configure[@]}" -DVOROCL_GEOTIFF=OFF >/dev/null
if "$cmake" --build "$folder" --target help | grep vorocl_geotiff; then
  echo "the module of GeoTIFF's keys is built all the same"
  exit 1
fi
