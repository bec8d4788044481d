#!/usr/bin/env bash
# All figures of a GPU. Needs no network and no root: g++, CMake, Ninja, Python and the GPU's driver, and what
# `tools/setup.sh gpu FOLDER` put into FOLDER where there was a network. From a fresh clone:
#   tools/gpu_report.sh --with FOLDER                    measures all pieces and writes output/gpu.json and output/gpu.md
#   tools/gpu_report.sh --with FOLDER --piece still      one piece. Each takes at most 8 minutes; one that is cut off, or says
#                                                        that there is more to do, goes on where it was when it is run again
# The pieces: check (known diagrams and the core's tests), still (seeds at centres of pixels, points, points that crowd, volumes,
# masks), moving (seeds, and points from a device's buffer), hurtful (sets of seeds), all with times and labels by their hashes,
# kernels (the time of each kernel), cupy (CuPy's distance transform of the same seeds and masks beside them).
# tools/checks/gpu/report.py has the other options.
set -euo pipefail
cd "$(dirname "$0")/.."

with= arguments=()
while [ $# -gt 0 ]; do
  if [ "$1" = --with ]; then with=$(realpath "${2:?"--with needs a folder"}"); shift; else arguments+=("$1"); fi
  shift
done
if [ -n "$with" ]; then
  export CMAKE_PREFIX_PATH=$with VOROCL_GPU_FOLDER=$with
  export LD_LIBRARY_PATH=$with/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
fi

missing=()
for program in g++ cmake ninja python3; do command -v $program >/dev/null || missing+=("$program"); done
has_header() { g++ ${with:+"-I$with/include"} -fsyntax-only -x c++ - <<<"#include <$1>" 2>/dev/null; }
for header in CL/cl.h CL/opencl.hpp boost/test/test_tools.hpp; do has_header $header || missing+=("the header $header"); done

if [ ${#missing[@]} -gt 0 ]; then
  printf 'gpu_report.sh: missing: %s\n' "${missing[@]}" >&2
  echo "gpu_report.sh: for headers, run tools/setup.sh gpu FOLDER where there is a network, and give --with FOLDER here" >&2
  exit 2
fi
: "${VOROCL_DEVICE:=NVIDIA}"
export VOROCL_DEVICE
exec python3 tools/checks/gpu/report.py "${arguments[@]}"
