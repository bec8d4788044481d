#!/usr/bin/env bash
# Builds everything, passes the whole test suite (under PoCL, unless VOROCL_DEVICE says otherwise), and lists at the end
# which tests were skipped. Arguments are ctest's: tools/test.sh -R jump
set -euo pipefail
cd "$(dirname "$0")/.."

tools/setup.sh build test
cmake --preset release -DVOROCL_BUILD_TESTS=ON >/dev/null
cmake --build --preset release
export VOROCL_DEVICE="${VOROCL_DEVICE-Portable Computing Language}"  # PoCL, also where there is a GPU
status=0
ctest --preset release --parallel "$(nproc)" "$@" || status=$?

skipped=$(awk '/^[0-9]+\/[0-9]+ Testing: / { name = $3 } /: skipped$/ { print "  " name ": " $0 }' \
  build/Testing/Temporary/LastTest.log)
if [ -n "$skipped" ]; then
  printf 'Skipped, for want of what "tools/setup.sh check" installs:\n%s\n' "$skipped"
fi
exit "$status"
