#!/usr/bin/env bash
# The GPU's report with small sizes and without network or packages: on PoCL, on a device that no ICD file names, and with
# what is missing or wrong: test_gpu_report.sh SOURCE BUILD
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "$1"
  cat "$work/log"
  exit 1
}
# Nothing is to install anything. The Python is one with NumPy, if there is one.
mkdir "$work/bin"
for installer in apt-get sudo pip pip3; do
  printf '#!/bin/sh\ntouch "%s/installed"\nexit 1\n' "$work" >"$work/bin/$installer"
done
for python in python3 /usr/bin/python3; do
  if [ ! -e "$work/bin/python3" ] && $python -c "import numpy" 2>/dev/null; then
    ln -s "$($python -c 'import sys; print(sys.executable)')" "$work/bin/python3"
  fi
done
chmod +x "$work"/bin/*
export PATH=$work/bin:$PATH

report() { # EXIT_CODE NAME BUILD OPTION...
  local expected=$1 code=0
  shift
  "$source/tools/gpu_report.sh" --build "$2" --sizes 64 --densities 64,4 --frames 2 --milliseconds 1 "${@:3}" \
    --out "$work/$1.json" >"$work/log" 2>&1 || code=$?
  [ $code -eq "$expected" ] || fail "exit code $code and not $expected: gpu_report.sh ${*:3}"
}
shows() { grep -qE "$1" "$work/log" || fail "it does not show: $1"; }

# On PoCL: all pieces, at first without time for any.
export VOROCL_DEVICE="Portable Computing Language"
report 3 pocl "$2" --limit 0 --piece still
shows 'still: there is more to do'
pieces=check,still,moving,kernels,cupy
[ ! -e "$work/bin/python3" ] || pieces+=,hurtful
report 0 pocl "$2" --tests test_plan --piece "$pieces"
shows '^\| 64 64 \| 64 \|.* / .* \| right \|$'
shows '^\| 64 1024 2 \| 1024 \|.* \| not compared \|$'
shows '^\| 64 64 \| jfa \| seed_wave \| 4096 \|'
shows '^Of [0-9]+ known diagrams 0 are wrong: none'
shows '^\| test_plan \| passed \|$'
[ ! -e "$work/bin/python3" ] || shows '^\| 64 every-pixel \| 4096 \|'
python3 -c "import cupy" 2>/dev/null || shows '^Nothing of cupy: ModuleNotFoundError'
# What is there is not measured again.
report 0 pocl "$2" --piece still
! grep -q '^still: 64' "$work/log" || fail "it measured again"

# A kernel that errs.
cp -r "$source/kernels" "$work/kernels"
sed -i 's/height, step), out/height, 1), out/' "$work/kernels/flooding/jump_flooding.cl"
VOROCL_KERNEL_DIR=$work/kernels report 1 wrong "$2" --piece still
shows 'still: 64 64: WRONG: jfa'

# Without PoCL: no driver at all, and one that no ICD file names.
mkdir "$work/none" "$work/driver"
export OCL_ICD_VENDORS=$work/none
report 1 none "$2" --piece still
shows 'there is no OpenCL driver: no .icd file in '
simulator=/usr/lib/oclgrind/liboclgrind-rt-icd.so
if [ -e $simulator ]; then
  ln -s $simulator "$work/driver/libnvidia-opencl.so.1"
  # It does not know what LLVM leaves where it has inlined functions (see kernels.sh).
  export OCLGRIND_BUILD_OPTIONS=-cl-opt-disable
  LD_LIBRARY_PATH=$work/driver VOROCL_DEVICE=oclgrind report 0 simulated "$2" --piece still --densities 64
  shows '^# Measured on Oclgrind'
  shows '^\| 64 64 \| 64 \|.* \| right \|$'
fi
[ ! -e "$work/installed" ] || fail "it wanted to install something"
