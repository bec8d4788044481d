#!/usr/bin/env bash
# Checks that clang-format (of version 14) and clang-tidy have nothing to say:
#   check_style.sh format              all sources; of kernels the length of lines alone
#   check_style.sh lint [FOLDER]...    the sources in the folders, or in all; takes some 10 seconds for each
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1-} in
format)
  find include python src tools tests -name '*.[ch]' -o -name '*.[ch]pp' | xargs clang-format --dry-run -Werror
  if grep -rnE '^.{121,}' kernels; then
    echo "These lines of kernels have more than 120 columns." >&2
    exit 1
  fi
  ;;
lint)
  shift
  [ $# -gt 0 ] || set -- src tools tests
  # As Clang compiles it: it cannot read the precompiled headers of another compiler.
  CC=clang CXX=clang++ cmake --preset dev -B build-lint -DVOROCL_MPI=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null
  find "$@" -name '*.cpp' -not -path 'tests/package/*' -not -path 'tests/benchmarks/*' -not -path 'tools/simulated_warps/*' |
    xargs --max-procs "$(nproc)" --max-args 1 clang-tidy --quiet -p build-lint
  ;;
*)
  echo "check_style.sh format | lint [FOLDER]..." >&2
  exit 2
  ;;
esac
