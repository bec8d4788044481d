#!/usr/bin/env bash
# Configures the project as where a library is missing, and checks that the error names the option that leaves it out, and
# that the option does: option_of_library.sh CMAKE SOURCE FOLDER OPTION VARIABLE_OF_LIBRARY NAME_IN_BUILD
set -euo pipefail
cmake=$1 source=$2 folder=$3 option=$4 library=$5 name=$6

rm -rf "$folder"
configure=("$cmake" -S "$source" -B "$folder" -DVOROCL_BUILD_TESTS=OFF "-D$library=")
if said=$("${configure[@]}" 2>&1); then
  echo "the project was configured without $library"
  exit 1
fi
grep -qF -- "-D$option=OFF" <<<"$said" || { echo "$said"; exit 1; }

"${configure[@]}" "-D$option=OFF" >/dev/null
if "$cmake" --build "$folder" --target help | grep "$name"; then
  echo "$name is built all the same"
  exit 1
fi
