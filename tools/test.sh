#!/usr/bin/env bash
# Builds everything, passes the tests (under PoCL, unless VOROCL_DEVICE says otherwise), and lists at the end which were
# skipped: test.sh [--all] [ARGUMENT OF CTEST]...
#   tools/test.sh            all but the checks
#   tools/test.sh -R jump    some of them; of the checks with --all before it
#   tools/test.sh --all      the checks, too, as .ci/run does: the Python package, projects that use the library, checkers of
#                            kernels and of memory, every fault of the command, the documentation
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "${1:-}" = --all ]; then shift; else set -- --label-exclude checks "$@"; fi

tools/setup.sh build test
cmake --preset release -DVOROCL_BUILD_TESTS=ON >/dev/null
cmake --build --preset release
export VOROCL_DEVICE="${VOROCL_DEVICE-Portable Computing Language}"  # PoCL, also where there is a GPU
status=0
ctest --preset release --no-tests=error --parallel "$(nproc)" "$@" || status=$?

skipped=$(awk '/^[0-9]+\/[0-9]+ Testing: / { name = $3 } /: skipped$/ { print "  " name ": " $0 }' \
  build/Testing/Temporary/LastTest.log)
if [ -n "$skipped" ]; then
  printf 'Skipped, for want of what "tools/setup.sh check" installs:\n%s\n' "$skipped"
fi
exit "$status"
