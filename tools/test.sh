#!/usr/bin/env bash
# Builds VoroCL and passes the whole test suite (under PoCL, unless VOROCL_DEVICE says otherwise).
set -euo pipefail
cd "$(dirname "$0")/.."

tools/build.sh
export VOROCL_DEVICE="${VOROCL_DEVICE-Portable Computing Language}"  # PoCL, also where there is a GPU
cd build
ctest --output-on-failure --parallel "$(nproc)" "$@"
