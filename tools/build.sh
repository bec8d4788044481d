#!/usr/bin/env bash
# Installs what is missing and builds everything in the folder build/, or in the one that is given.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}

tools/setup.sh
cmake -S . -B "$build" -G Ninja -DVOROCL_WARNINGS_AS_ERRORS=ON >/dev/null
cmake --build "$build"
