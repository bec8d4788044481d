#!/usr/bin/env bash
# Builds the command and draws the regions of the world's cities. The last word it prints is the picture's name.
set -euo pipefail
cd "$(dirname "$0")/.."

tools/setup.sh build
[ -f build/build.ninja ] || cmake --preset release -DVOROCL_BUILD_TESTS=OFF >/dev/null # Boost.Test may not be there
cmake --build --preset release --target vorocl_tool
mkdir -p output
build/tools/vorocl render --points samples/cities-5000.csv --size 1800x900 --metric great-circle --edges \
  -o output/cities.png
# For what comes next: in the background, at a low priority.
nice build/tools/vorocl prepare >output/prepare.log 2>&1 </dev/null &
echo "The regions of 5,000 cities, each pixel in the colour of its nearest one: output/cities.png"
