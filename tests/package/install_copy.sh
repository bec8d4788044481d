#!/usr/bin/env bash
# Installs a build into a fresh folder, and checks what lies there: install_copy.sh CMAKE BUILD PREFIX
set -euo pipefail
cmake=$1 build=$2 prefix=$3

rm -rf "$prefix"
"$cmake" --install "$build" --prefix "$prefix" >/dev/null
if find "$prefix" -name '*.cl' | grep .; then
  echo "kernels are installed, and they are to be inside the library"
  exit 1
fi
for header in vorocl.h vorocl.hpp version.hpp diagram.hpp; do
  [ -f "$prefix/include/vorocl/$header" ] || { echo "vorocl/$header is not installed"; exit 1; }
done
