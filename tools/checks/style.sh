#!/usr/bin/env bash
# Checks that clang-format (of version 14) and clang-tidy have nothing to say:
#   style.sh format              all sources; of kernels the length of lines alone
#   style.sh lint [FOLDER]...    the sources in the folders, or in all; takes some 10 seconds for each
#   style.sh quick [FOLDER]...   the same, or of src and tools, for a sixth of the time: the sources of a folder as one, and
#                                      without clang's analyzer
set -euo pipefail
cd "$(dirname "$0")/../.."

configure() { # FOLDER OPTION...: as Clang compiles it, which cannot read the precompiled headers of another compiler
  CC=clang CXX=clang++ cmake --preset dev -B "$1" -DVOROCL_MPI=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON "${@:2}" >/dev/null
}

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
  configure build-lint
  find "$@" -name '*.cpp' -not -path 'tests/package/*' -not -path 'tests/benchmarks/*' |
    xargs --max-procs "$(nproc)" --max-args 1 clang-tidy --quiet -p build-lint
  ;;
quick)
  shift
  [ $# -gt 0 ] || set -- src tools
  rm -rf build-lint-quick  # with what was united before
  configure build-lint-quick -DCMAKE_UNITY_BUILD=ON -DVOROCL_BUILD_TESTS=OFF
  # That it includes sources is no mistake of such a file. The longest begin.
  find build-lint-quick -path '*/Unity/*' -exec grep -lE "\"$PWD/($(IFS='|' && echo "$*"))/" {} + | xargs wc -l | sort -rn |
    awk '$2 != "total" { print $2 }' |
    xargs --max-procs "$(nproc)" --max-args 1 clang-tidy --quiet -p build-lint-quick \
      --checks=-clang-analyzer-*,-bugprone-suspicious-include
  ;;
*)
  echo "style.sh format | lint [FOLDER]... | quick [FOLDER]..." >&2
  exit 2
  ;;
esac
