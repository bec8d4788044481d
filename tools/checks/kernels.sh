#!/usr/bin/env bash
# Checks the kernels without a GPU: every .cl file compiles in strict OpenCL C 1.2 without a warning, and (with a test
# program as argument, which checks its labels) runs under Oclgrind without a finding. Exits with 77 where a checker is not installed.
set -euo pipefail
cd "$(dirname "$0")/../.."

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
  clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -include tools/checks/refused_calls.h -fsyntax-only -Ikernels \
    -Wall -Wextra -Wconversion -Werror -Wno-unused-function -Wno-unused-const-variable \
    -DVOROCL_GUARD=16 -DVOROCL_BITS_X=11 -DVOROCL_BITS_Y=10 -DVOROCL_BITS_Z=10 "$@" "$kernel"
}

# What programs are built for, one set of options per line: every vector width, and of the scalar and of the widest
# kernels all metrics, neighbourhoods, axes and windows. What a program includes is compiled with it, and once alone.
builds_of() { # KERNEL
  local kernel=$1 width metric axes places
  if grep -qF "#include \"${kernel#kernels/}\"" $(kernel_files); then
    echo "1 -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9"
    return
  fi
  if [[ $kernel == kernels/exact/*diagram.cl ]]; then  # planes, and Euclidean volumes, with vectors of its own
    local planes=-DVOROCL_PERIODIC=1 volumes=-DVOROCL_PERIODIC=1 flat=-DVOROCL_FLAT
    if [[ $kernel == */group/* ]]; then
      planes='-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y' volumes="$planes -DVOROCL_PERIODIC_Z" flat=
    fi
    for places in -DVOROCL_DIMENSIONS=3 '' "$short_lists"; do  # with weights
      echo "1 -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_FRACTIONS -DVOROCL_WEIGHTED $planes $places"
    done
    for places in "-DVOROCL_EUCLIDEAN -DVOROCL_DIMENSIONS=3 $volumes" "-DVOROCL_MANHATTAN $planes" \
        "-DVOROCL_EUCLIDEAN -DVOROCL_WEIGHTED $planes $short_lists"; do  # tilted
      echo "1 -DVOROCL_NEIGHBOURS=9 -DVOROCL_FRACTIONS -DVOROCL_TILTED $places"
    done
    for places in '' -DVOROCL_FRACTIONS "-DVOROCL_FRACTIONS $short_lists"; do
      for axes in '' "$volumes" '-DVOROCL_SPACING_X=2 -DVOROCL_SPACING_Y=1 -DVOROCL_SPACING_Z=4' \
          "-DVOROCL_SPACING_X=2 -DVOROCL_SPACING_Y=3 -DVOROCL_SPACING_Z=1 $volumes $flat"; do
        echo "1 -DVOROCL_EUCLIDEAN -DVOROCL_DIMENSIONS=3 -DVOROCL_NEIGHBOURS=9 $places $axes"
      done
      for metric in EUCLIDEAN MANHATTAN; do
        for axes in '' "$planes"; do
          echo "1 -DVOROCL_$metric -DVOROCL_NEIGHBOURS=9 $places $axes"
        done
      done
    done
    return
  fi
  for width in 1 2 4 8 16; do echo "$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9"; done
  for width in 1 2 16; do echo "$width -DVOROCL_MANHATTAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_FAR"; done
  for width in 1 16; do
    echo "$width -DVOROCL_MANHATTAN -DVOROCL_NEIGHBOURS=9"
    for metric in EUCLIDEAN MANHATTAN; do
      echo "$width -DVOROCL_$metric -DVOROCL_NEIGHBOURS=9 -DVOROCL_FAR -DVOROCL_FRACTIONS"
      [[ $kernel != kernels/*/*flooding.cl ]] || echo "$width -DVOROCL_$metric -DVOROCL_NEIGHBOURS=5"
    done
    echo "$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_FAR"
    for axes in -DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y '-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y'; do
      echo "$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 $axes"
    done
    if [[ $kernel == kernels/volumes/* || $kernel == kernels/core/seeds.cl ]]; then
      for axes in -DVOROCL_PERIODIC_Z '-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y -DVOROCL_PERIODIC_Z'; do
        echo "$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_DIMENSIONS=3 $axes"
      done
      echo "$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_DIMENSIONS=3 -DVOROCL_SPACING_X=2 -DVOROCL_SPACING_Y=1 -DVOROCL_SPACING_Z=4"
    fi
    if [[ $kernel == kernels/measures/* ]]; then  # of windows that show a whole period, where seeds may lie outside
      for axes in -DVOROCL_PERIODIC_X '-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y -DVOROCL_FRACTIONS -DVOROCL_TILTED'; do
        echo "$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_FAR $axes"
      done
      for axes in '' '-DVOROCL_TILTED -DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Z -DVOROCL_SPACING_X=2 -DVOROCL_SPACING_Y=1 -DVOROCL_SPACING_Z=4'; do
        echo "$width -DVOROCL_MANHATTAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_DIMENSIONS=3 $axes"
        echo "$width -DVOROCL_EUCLIDEAN -DVOROCL_NEIGHBOURS=9 -DVOROCL_DIMENSIONS=3 -DVOROCL_FAR -DVOROCL_FRACTIONS $axes"
      done
    fi
    if [[ $kernel == kernels/exact/* ]]; then  # the tests' own lists, nearly every one of which overflows
      for metric in EUCLIDEAN MANHATTAN 'EUCLIDEAN -DVOROCL_FRACTIONS' 'MANHATTAN -DVOROCL_FRACTIONS' \
        'EUCLIDEAN -DVOROCL_FRACTIONS -DVOROCL_WEIGHTED'; do
        echo "$width -DVOROCL_$metric -DVOROCL_NEIGHBOURS=9 $short_lists"
      done
    fi
  done
}

strict_compile() {
  command -v clang >/dev/null || { echo "clang is not installed: skipped"; exit 77; }
  refuse_plain_inline
  local kernel width options short_lists
  short_lists=$(grep -oE -- '-D[A-Z_]+=[A-Z0-9_]+' tests/support/list_length.hpp | tr '\n' ' ')
  for kernel in $(kernel_files); do
    while read -r width options; do compile "$kernel" "-DVOROCL_WIDTH=$width" $options; done < <(builds_of "$kernel")
  done
  echo "$(kernel_files | wc -l) kernel files compile without a warning"
}

# Oclgrind exits with 0 whatever it finds: its log is what counts. It does not know what LLVM leaves where it has inlined functions
# whose pointers are told apart, so nothing is inlined.
simulate() {
  command -v oclgrind >/dev/null || { echo "Oclgrind is not installed: skipped"; exit 77; }

  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  VOROCL_DEVICE=oclgrind oclgrind --build-options -cl-opt-disable --data-races --log "$log" "$@"
  if [ -s "$log" ]; then
    echo "Oclgrind found:"
    cat "$log"
    exit 1
  fi
  echo "Oclgrind found nothing"
}

if [ $# -eq 0 ]; then strict_compile; else simulate "$@"; fi
