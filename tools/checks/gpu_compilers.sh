#!/usr/bin/env bash
# Checks without a GPU that every kernel which a GPU gets fits one: gpu_compilers.sh [MAKER]...
#   nvidia (without any)   clang compiles it for PTX as the library builds it, and ptxas assembles it for an A100 (sm_80) and an
#                          H100 (sm_90)
#   amd                    clang compiles it for a Radeon VII (gfx906), an MI200 (gfx90a) and a Radeon RX 6000 (gfx1030)
#   intel                  Intel's ocloc compiles it for Gen9 (skl), Gen12 (tgllp) and an Arc (dg2), and says what scratch memory it has
# No kernel may have a stack frame or spilled registers, more registers than its GPU's limit or more than 20 KB of local memory.
# Prints the table. Exits with 77 where a tool is missing; tools/setup.sh check (for Intel: intel) installs them, and these name others:
#   CLANG   a clang with the maker's target       LIBCLC   the folder of libclc's .bc files of the same version
#   PTXAS   ptxas, of CUDA 11.4 or newer          OCLOC    ocloc, of Intel's compute runtime
set -euo pipefail
cd "$(dirname "$0")/../.."
: "${CLANG:=clang}" "${LIBCLC:=/usr/lib/clc}"
[ $# -gt 0 ] || set -- nvidia
cache=${XDG_CACHE_HOME:-$HOME/.cache}/vorocl
: "${PTXAS:=$(command -v ptxas || echo "$cache/ptxas/nvidia/cuda_nvcc/bin/ptxas")}"
if [ -z "${OCLOC:-}" ] && ! OCLOC=$(command -v ocloc); then
  OCLOC=$cache/ocloc/usr/bin/ocloc
  libraries=$(printf '%s:' "$cache"/ocloc/usr/lib/{*-linux-gnu,llvm-*/lib})
fi
most_local=20480
# With so many registers, half of the warps that an A100 or an H100 can hold fit beside each other (32 of 64 on a multiprocessor), 4
# of the 10 waves of a SIMD of gfx906, which has 256 registers per lane, 4 of the 8 of gfx90a, which has 512, and all 16 of gfx1030.
most_registers='sm_80 64 sm_90 64 gfx906 64 gfx90a 128 gfx1030 64'

needs() { # MAKER TOOL NAME
  [[ " $makers " != *" $1 "* ]] || command -v "$2" >/dev/null || [ -d "$2" ] || { echo "$3 is not installed: skipped"; exit 77; }
}
makers=$*
for maker in nvidia amd; do
  needs $maker "$CLANG" clang
  needs $maker "$LIBCLC" "libclc ($LIBCLC)"
done
needs nvidia "$PTXAS" ptxas
needs intel "$OCLOC" ocloc

# A GPU gets all programs but those of the vector shape of exact diagrams. Exact cells and great circles are not checked.
kernel_files() {
  grep -lE '^ *(VECTOR_KERNEL|kernel) void' kernels/{core,flooding,measures,motion}/*.cl
  echo kernels/exact/group/diagram.cl
  echo kernels/exact/far.cl
  echo kernels/masks/group/transform.cl
  echo kernels/volumes/jump_flooding.cl
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

of_all=(-cl-std=CL1.2 -Ikernels -DVOROCL_WIDTH=1 -DVOROCL_GUARD=16 -DVOROCL_BITS_X=11 -DVOROCL_BITS_Y=10 -DVOROCL_BITS_Z=10)

# Drivers inline every function, as far as is known.
compile() { # TARGET LIBRARY FILE OPTION...
  "$CLANG" -S -x cl "${of_all[@]}" -target "$1" -Xclang -finclude-default-header -O3 \
    -mllvm -inline-threshold=1000000 -mllvm -inlinehint-threshold=1000000 \
    -Xclang -mlink-builtin-bitcode -Xclang "$LIBCLC/$2" -Wno-linker-warnings "${@:4}" "$3" -o "$work/kernel.s"
}

# What programs are built for besides a plain grid: places, and periodic axes.
more_options() { # FILE METRIC
  if [[ $1 == kernels/exact/group/diagram.cl ]]; then
    printf '%s\n' '-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y' -DVOROCL_FRACTIONS '-DVOROCL_FRACTIONS -DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y'
  fi
  if [[ $1 == kernels/exact/group/diagram.cl && $2 == EUCLIDEAN ]]; then
    local places periodic='-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y'
    echo "-DVOROCL_FRACTIONS -DVOROCL_WEIGHTED $periodic"
    for places in '' -DVOROCL_FRACTIONS '-DVOROCL_FRACTIONS -DVOROCL_WEIGHTED'; do
      printf -- "-DVOROCL_DIMENSIONS=3 $places%s\n" '' " $periodic -DVOROCL_PERIODIC_Z"
    done
    echo "-DVOROCL_FRACTIONS -DVOROCL_TILTED $periodic"
    echo "-DVOROCL_DIMENSIONS=3 -DVOROCL_FRACTIONS -DVOROCL_WEIGHTED -DVOROCL_TILTED $periodic -DVOROCL_PERIODIC_Z"
    echo '-DVOROCL_DIMENSIONS=3 -DVOROCL_FRACTIONS -DVOROCL_SPACING_X=2 -DVOROCL_SPACING_Y=1 -DVOROCL_SPACING_Z=4'
  fi
  if [[ $1 == kernels/masks/* ]]; then echo -DVOROCL_FAR; fi
  if [[ $1 == kernels/measures/* || $1 == kernels/core/seeds.cl ]]; then echo '-DVOROCL_DIMENSIONS=3 -DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y -DVOROCL_PERIODIC_Z'; fi
  if [[ $1 == kernels/volumes/* ]]; then echo '-DVOROCL_PERIODIC_X -DVOROCL_PERIODIC_Y -DVOROCL_PERIODIC_Z'; fi
}

# What the compilers report as lines of: file, kernel, options, GPU, registers, stack, spilled bytes, local memory.
report_nvidia() { # FILE OPTION...
  local architecture
  compile nvptx64-nvidia-nvcl nvptx64--nvidiacl.bc "$@" -Xclang -target-cpu -Xclang sm_80 -Xclang -target-feature -Xclang +ptx74
  for architecture in sm_80 sm_90; do
    "$PTXAS" -v -arch=$architecture "$work/kernel.s" -o "$work/kernel.cubin" 2>"$work/log" || { cat "$work/log" >&2; return 1; }
    awk -v OFS='\t' -v file="${1#kernels/}" -v options="${*:2}" -v architecture=$architecture '
      /Compiling entry function/ { split($0, quoted, "\047"); kernel = quoted[2] }
      /bytes stack frame/ { stack += $1; spilled += $5 + $9 }
      /Used [0-9]+ registers/ {
        match($0, /Used [0-9]+/); registers = substr($0, RSTART + 5, RLENGTH - 5)
        memory = match($0, /[0-9]+ bytes smem/) ? substr($0, RSTART, RLENGTH) + 0 : 0
        print file, kernel, options, architecture, registers, stack, spilled, memory
        stack = spilled = 0
      }' "$work/log"
  done
}

report_amd() { # FILE OPTION...
  local architecture
  for architecture in gfx906 gfx90a gfx1030; do
    compile amdgcn-amd-amdhsa amdgcn--amdhsa.bc "$@" -nogpulib -mcpu=$architecture
    awk -v OFS='\t' -v file="${1#kernels/}" -v options="${*:2}" -v architecture=$architecture '
      /^  - \.a/ { kernel = "" }
      /^    \.group_segment_fixed_size:/ { memory = $2 }
      /^    \.name:/ { kernel = $2 }
      /^    \.private_segment_fixed_size:/ { stack = $2 }
      /^    \.vgpr_count:/ { registers = $2 }
      /^    \.vgpr_spill_count:/ { print file, kernel, options, architecture, registers, stack, 4 * $2, memory }' "$work/kernel.s"
  done
}

# ocloc tells neither registers nor local memory. A kernel's patch tokens tell what memory a thread has for its stack and what is
# spilled: the last word of 18 scratch memory, the fourth of 38 private memory.
report_intel() { # FILE OPTION...
  local device
  for device in skl tgllp dg2; do
    rm -rf "$work/intel"
    LD_LIBRARY_PATH=${libraries:-} "$OCLOC" compile -q -file "$1" -device $device -options "${of_all[*]} ${*:2}" -output kernel \
      -output_no_suffix -out_dir "$work/intel" >"$work/log" 2>&1 || { cat "$work/log" >&2; return 1; }
    LD_LIBRARY_PATH=${libraries:-} "$OCLOC" disasm -file "$work/intel/kernel" -dump "$work/intel/parts" -device $device >"$work/log" 2>&1 ||
      { cat "$work/log" >&2; return 1; }
    awk -v OFS='\t' -v file="${1#kernels/}" -v options="${*:2}" -v device=$device '
      function digit(hex, at) { return index("123456789abcdef", substr(hex, at, 1)) }
      function byte(hex) { return length(hex) == 2 ? 16 * digit(hex, 1) + digit(hex, 2) : digit(hex, 1) }
      function word(at) { return byte($at) + 256 * (byte($(at + 1)) + 256 * (byte($(at + 2)) + 256 * byte($(at + 3)))) }
      function tell() { if (kernel != "") print file, kernel, options, device, "-", memory, 0, "-" }
      /KernelName / { tell(); kernel = $2; memory = 0 }
      $2 == "Token" { token = $3 }
      $1 == "Hex" && token == 18 { memory += word(6) }
      $1 == "Hex" && token == 38 { memory += word(14) }
      END { tell() }' "$work/intel/parts/PTM.txt"
  done
}

# The report of a maker, once for all options that leave the same source.
report() { # MAKER FILE OPTION...
  local source
  source=$work/$1.$("$CLANG" -E -P -x cl "${of_all[@]}" "${@:3}" "$2" | sha256sum | cut -d ' ' -f 1)
  [ -e "$source" ] || "report_$1" "${@:2}"
  touch "$source"
}

for maker in "$@"; do
  [[ $maker =~ ^(nvidia|amd|intel)$ ]] || { echo "There is no maker \"$maker\", but nvidia, amd and intel." >&2; exit 2; }
  for file in $(kernel_files); do
    for metric in EUCLIDEAN MANHATTAN; do
      for neighbours in 9 5; do report "$maker" "$file" -DVOROCL_$metric -DVOROCL_NEIGHBOURS=$neighbours; done
      more_options "$file" "$metric" | while read -r option; do
        report "$maker" "$file" -DVOROCL_$metric -DVOROCL_NEIGHBOURS=9 $option
      done
    done
  done
done >"$work/rows"

# One line for all options with the same figures.
awk -F '\t' -v OFS='\t' -v limits="$most_registers" -v memory=$most_local '
  BEGIN {
    for (i = split(limits, words, " "); i > 0; i -= 2) registers[words[i - 1]] = words[i]
    print "file", "kernel", "GPU", "registers", "stack", "spilled", "local", "verdict"
  }
  !seen[$1, $2, $4, $5, $6, $7, $8]++ {
    fits = $5 + 0 <= registers[$4] + 0 && $6 == 0 && $7 == 0 && $8 + 0 <= memory
    print $1, $2, $4, $5, $6, $7, $8, fits ? "fits" : "TOO MUCH (" $3 ")"
    if (!fits) ++failed
  }
  END { exit failed > 0 }' "$work/rows" >"$work/table" && verdict=0 || verdict=1
column -t -s $'\t' "$work/table"
exit $verdict
