#!/usr/bin/env bash
# Builds VoroCL and draws the regions of the world's cities. The last word it prints is the picture's name.
set -euo pipefail
cd "$(dirname "$0")/.."

tools/build.sh
mkdir -p output
build/tools/vorocl render --points samples/cities-5000.csv --bounds 0,0,360,180 --size 1800x900 --method jfa \
  --edges -o output/cities.png
echo "The regions of 5,000 cities, each pixel in the colour of its nearest one: output/cities.png"
