#!/usr/bin/env bash
# Checks what the preset packager installs, on Debian 12 with what "tools/setup.sh build check" installs:
#   package.sh          the recipe for conda can be rendered; two copies of the last commit, in folders whose names
#                             differ in length, install the same bytes; and the shared library has the ABI that this
#                             minor version's first release recorded, and at most more of it
#   package.sh record   records the ABI in packaging/abi, for a release
set -euo pipefail
cd "$(dirname "$0")/../.."
action=${1-check}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

install_copy() { # FOLDER OPTION...: a copy of the last commit, and what it installs in FOLDER/installed
  local folder=$1
  shift
  mkdir -p "$folder/source"
  git archive HEAD | tar -x -C "$folder/source"
  (
    cd "$folder/source"
    cmake --preset packager -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_LIBDIR=lib "$@"
    cmake --build --preset packager
    DESTDIR=$folder/installed cmake --install build-packager
  ) >"$folder.log" 2>&1 || { tail -n 40 "$folder.log"; exit 1; }
}

# The ABI is read from debug information. That of GCC 12 differs from build to build, in lists of places of variables: the
# bytes are compared without.
CXXFLAGS="-g ${CXXFLAGS-}" install_copy "$work/library" -DVOROCL_BUILD_TOOLS=OFF -DVOROCL_BUILD_PICTURE=OFF
library=$(echo "$work"/library/installed/usr/lib/libvorocl.so.*.*.*)
abi=$(readelf -d "$library" | sed -n 's/.*soname: \[libvorocl\.so\.\(.*\)\]/\1/p')
headers=$work/library/installed/usr/include/vorocl
dump=packaging/abi/libvorocl-$abi.abi.xz

case $action in
record)
  abidw --drop-private-types --headers-dir "$headers" --no-corpus-path --no-comp-dir-path --no-show-locs "$library" |
    xz -9 >"$dump"
  echo "The ABI $abi is recorded in $dump."
  ;;
check)
  python3 -m venv "$work/conda"
  "$work/conda/bin/python" -m pip install --quiet py-rattler-build
  "$work/conda/bin/python" packaging/conda/check_recipe.py "${library##*.so.}"
  echo "The recipe for conda can be rendered."

  install_copy "$work/one"
  install_copy "$work/another"
  if ! diff -r "$work/one/installed" "$work/another/installed"; then
    echo "Two builds of the same commit differ."
    exit 1
  fi
  echo "Both builds install the same bytes."

  if [ ! -e "$dump" ]; then
    echo "No release has recorded the ABI $abi."
    exit 0
  fi
  xz -dc "$dump" >"$work/recorded.abi"
  # The report, and what of it makes programs that were linked with the release fail: all but new functions.
  abidiff --drop-private-types --headers-dir2 "$headers" "$work/recorded.abi" "$library" || true
  if ! abidiff --drop-private-types --headers-dir2 "$headers" --no-added-syms "$work/recorded.abi" "$library" >/dev/null; then
    echo "The ABI $abi is not what it was: undo the change, or raise the minor version."
    exit 1
  fi
  echo "The ABI $abi is the recorded one."
  ;;
*)
  echo "package.sh [record]" >&2
  exit 2
  ;;
esac
