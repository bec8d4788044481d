#!/usr/bin/env bash
# Builds a C program against an installed copy as pkg-config says, without a note of the compiler, and runs it:
#   pkg_config.sh LIBDIR VERSION FILE.c COMPILER...
# Exits with 77 where pkg-config is not installed.
set -euo pipefail
libdir=$1 version=$2 source=$3
shift 3
command -v pkg-config >/dev/null || { echo "pkg-config is not installed: skipped"; exit 77; }

export PKG_CONFIG_PATH=$libdir/pkgconfig
[ "$(pkg-config --modversion vorocl)" = "$version" ] || { echo "pkg-config knows another version"; exit 1; }
if [ -f "$libdir/pkgconfig/vorocl-picture.pc" ]; then pkg-config --exists --print-errors vorocl-picture; fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# shellcheck disable=SC2046
notes=$("$@" -std=c99 -Wall -Wextra "$source" $(pkg-config --cflags --libs vorocl) -o "$folder/program" 2>&1)
[ -z "$notes" ] || { echo "$notes"; exit 1; }
LD_LIBRARY_PATH=$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} "$folder/program"
