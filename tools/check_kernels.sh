#!/usr/bin/env bash
# Checks the kernels without a GPU: every .cl file compiles in strict OpenCL C 1.2 without a warning, and (with a test
# program as argument) runs under Oclgrind without a finding. Exits with 77 where a checker is not installed.
set -euo pipefail
cd "$(dirname "$0")/.."

kernel_files() { find kernels tests tools -name '*.cl' | sort; }

# Under C99, which OpenCL C follows, a driver may leave a call to a plain `inline` function undefined.
refuse_plain_inline() {
  if grep -nE '\<inline\>' $(kernel_files) | grep -vE '\<static inline\>|//.*\<inline\>'; then
    echo "These functions are to be static inline"
    exit 1
  fi
}

compile() { # KERNEL OPTION...
  local kernel=$1
  shift
  clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Ikernels -Wall -Wextra -Wconversion -Werror \
    -Wno-unused-function -Wno-unused-const-variable -DVOROCL_GUARD=16 "$@" "$kernel"
}

strict_compile() {
  command -v clang >/dev/null || { echo "clang is not installed: skipped"; exit 77; }
  refuse_plain_inline
  local kernel width metric neighbours axes reach short_lists
  # The tests' own options, of which nearly every list overflows.
  short_lists=$(grep -oE -- '-D[A-Z_]+=[A-Z0-9_]+' tests/support/list_length.hpp)
  for kernel in $(kernel_files); do
    for width in 1 2 4 8 16; do
      for metric in EUCLIDEAN MANHATTAN; do
        for neighbours in 5 9; do
          compile "$kernel" -DVOROCL_WIDTH=$width -DVOROCL_$metric -DVOROCL_NEIGHBOURS=$neighbours
        done
      done
      for axes in -DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y '-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y'; do
        compile "$kernel" -DVOROCL_WIDTH=$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 $axes
      done
      if [[ $kernel == kernels/measures/* ]]; then  # of windows that show a whole period, in outer positions
        for axes in -DVOROCL_PERIODIC_X '-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y -DVOROCL_FAR'; do
          compile "$kernel" -DVOROCL_WIDTH=$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_OUTER_SEEDS $axes
        done
      fi
      if [[ $kernel == kernels/exact/* ]]; then
        compile "$kernel" -DVOROCL_WIDTH=$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 $short_lists
        compile "$kernel" -DVOROCL_WIDTH=$width -DVOROCL_MANHATTAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_OUTER_SEEDS $short_lists
      fi
      for metric in EUCLIDEAN MANHATTAN; do
        for reach in '' -DVOROCL_FAR; do
          compile "$kernel" -DVOROCL_WIDTH=$width -DVOROCL_$metric -DVOROCL_NEIGHBOURS=9 -DVOROCL_OUTER_SEEDS $reach
        done
      done
    done
  done
  echo "$(kernel_files | wc -l) kernel files compile without a warning"
}

# Oclgrind exits with 0 whatever it finds: its log is what counts.
simulate() {
  command -v oclgrind >/dev/null || { echo "Oclgrind is not installed: skipped"; exit 77; }

  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  VOROCL_DEVICE=oclgrind oclgrind --data-races --log "$log" "$@"
  if [ -s "$log" ]; then
    echo "Oclgrind found:"
    cat "$log"
    exit 1
  fi
  echo "Oclgrind found nothing"
}

if [ $# -eq 0 ]; then strict_compile; else simulate "$@"; fi
