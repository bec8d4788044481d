#!/usr/bin/env bash
# Makes the same files with one, a few and many compute units of the CPU, which share out the work otherwise, and
# compares their bytes: check_units.sh COMMAND. The number of units is PoCL's to choose.
set -euo pipefail
command=$1
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
export VOROCL_DEVICE="Portable Computing Language"

make() { # UNITS
  export POCL_MAX_PTHREAD_COUNT=$1
  mkdir "$1"
  "$command" devices | grep "CPU, $1 compute units" >/dev/null || { echo "PoCL has not $1 compute units" >&2; exit 1; }
  # Seeds that are painted, dense ones in planes and volumes; then those that are sorted.
  "$command" render --random 60007 --size 523x391 --labels "$1/dense.npy" >/dev/null
  "$command" render --random 50021 --size 71x67x53 --labels "$1/dense-volume.npy" >/dev/null
  "$command" render --points points.csv --size 523x391 --bounds 0,0,523,391 --labels "$1/points.npy" >/dev/null
  "$command" render --random 20011 --size 523x391 --method jfa --labels "$1/flooded.npy" >/dev/null
  "$command" cells --random 3001 --size 71x67x53 --cells "$1/cells.csv" --adjacency "$1/pairs.csv" >/dev/null
  "$command" cells --exact --points points.csv --bounds 0,0,523,391 --crs EPSG:3857 --polygons "$1/polygons.geojson" >/dev/null
}

awk 'BEGIN { srand(1); print "x,y"; for (i = 0; i < 7001; ++i) print 523 * rand() "," 391 * rand() * rand() }' >points.csv
make 1
for units in 2 7 61; do
  make "$units"
  diff -rq 1 "$units"
done
