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
for name in '64 points-64' '600x300 cities' '64 ring-65536' '8x8x8 points-64' '64 noise-64' '8x8x8 balls' '64 points-64 2'; do
  shows "^\| $name \|.* / .* \| right \|$"
done
shows '^\| 64 64 \| jfa \| seed_wave \| 4096 \|'
shows '^\| 64 balls \| exact \| mark_pixels \|'
shows '^Of [0-9]+ known diagrams 0 are wrong: none'
shows '^\| test_plan \| passed \|$'
[ ! -e "$work/bin/python3" ] || shows '^\| 64 every-pixel \| 4096 \|'
python3 -c "import cupy" 2>/dev/null || shows '^Nothing of cupy: ModuleNotFoundError'
# What is there is not measured again.
report 0 pocl "$2" --piece still
! grep -q '^still: 64' "$work/log" || fail "it measured again"

# Brute force in the place of CuPy's distance transform, which needs a GPU: it agrees, and then it does not.
if [ -e "$work/bin/python3" ]; then
  mkdir -p "$work/python/cupyx/scipy"
  cat >"$work/python/cupy.py" <<'END'
from types import SimpleNamespace
from numpy import asarray, load, ones, random, rint
__version__ = "0"
event = SimpleNamespace(record=lambda: None, synchronize=lambda: None)
cuda = SimpleNamespace(Event=lambda: event, get_elapsed_time=lambda begin, end: 0.25)
END
  cat >"$work/python/cupyx/scipy/ndimage.py" <<'END'
import numpy
def distance_transform_edt(pixels, return_distances, return_indices, float64_distances):
    squares = numpy.full(pixels.shape, 1e9)
    for place in numpy.argwhere(~pixels) if return_distances else []:
        squares = numpy.minimum(squares, sum((axis - x) ** 2 for axis, x in zip(numpy.indices(pixels.shape), place)))
    return numpy.sqrt(squares)
END
  PYTHONPATH=$work/python report 0 pocl "$2" --piece cupy
  shows '^\| 64 noise-64 \| .* / 0.250 \| .* \| right \|$'
  shows '^\| 64 every-pixel \| .* / 0.250 \| '
  sed -i 's/1e9/1/' "$work/python/cupyx/scipy/ndimage.py"
  rm "$work/pocl.json"
  PYTHONPATH=$work/python report 1 pocl "$2" --piece still,cupy --cases noise-64 --milliseconds 0
  shows 'still: 64 noise-64: WRONG: CuPy has other distances'
fi

# Kernels that err.
cp -r "$source/kernels" "$work/kernels"
sed -i 's/height, step), out/height, 1), out/' "$work/kernels/flooding/jump_flooding.cl"
sed -i 's/length = sqrt(TO_FLOATS(n->square))/length = TO_FLOATS(n->square)/' "$work/kernels/masks/targets.cl"
VOROCL_KERNEL_DIR=$work/kernels report 1 wrong "$2" --piece still --densities 64 --cases 64 --milliseconds 0
shows 'still: 64 64: WRONG: jfa'
shows 'still: 64 points-64: WRONG: jfa'
shows 'still: 8x8x8 noise-64: WRONG: exact'

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
  LD_LIBRARY_PATH=$work/driver VOROCL_DEVICE=oclgrind report 0 simulated "$2" --piece still --cases '64 64'
  shows '^# Measured on Oclgrind'
  shows '^\| 64 64 \| 64 \|.* \| right \|$'
fi
[ ! -e "$work/installed" ] || fail "it wanted to install something"
