#!/usr/bin/env bash
# Asks an installed copy for a component that does not exist, and checks that CMake's error names those that do:
#   unknown_component.sh CMAKE PREFIX FOLDER
set -euo pipefail
cmake=$1 prefix=$2 folder=$3

rm -rf "$folder"
mkdir "$folder"
printf '%s\n' 'cmake_minimum_required(VERSION 3.20)' 'project(unknown LANGUAGES C)' \
  'find_package(VoroCL REQUIRED COMPONENTS nonsense)' >"$folder/CMakeLists.txt"
if said=$("$cmake" -S "$folder" -B "$folder/build" -DCMAKE_PREFIX_PATH="$prefix" 2>&1); then
  echo "a component that does not exist was found"
  exit 1
fi
grep -qF 'VoroCL has no component "nonsense", only picture and mpi' <<<"$said" || { echo "$said"; exit 1; }

# An optional one is missing, and VoroCL is there all the same.
sed -i 's/REQUIRED COMPONENTS/REQUIRED OPTIONAL_COMPONENTS/' "$folder/CMakeLists.txt"
"$cmake" -S "$folder" -B "$folder/build" >/dev/null
