#!/usr/bin/env bash
# All figures of a GPU by one command: builds the core's tests and the command, passes the tests on the device, times
# jfa, djfa and exact at three sizes and all densities, and writes the tables, with the device's name, to FILE:
#   tools/gpu_report.sh [FILE]               FILE: default output/gpu.md
# The exact diagram's labels are held against those of the vector shape on the CPU, by their hashes. With CuPy installed,
# cupyx.scipy.ndimage.distance_transform_edt() is timed beside them.
#   VOROCL_DEVICE  the device; default NVIDIA       REPEAT  runs of each, of which the median is taken; default 9
#   SIZES          sides in pixels; default "2048 8192 10000"
#   BUILD          an existing build's folder with the command; default: built in build/, and tested
set -euo pipefail
cd "$(dirname "$0")/.."
: "${VOROCL_DEVICE:=NVIDIA}" "${SIZES:=2048 8192 10000}" "${REPEAT:=9}"
export VOROCL_DEVICE
report=${1:-output/gpu.md}
mkdir -p "$(dirname "$report")"

if [ -z "${BUILD:-}" ]; then
  BUILD=build
  tools/setup.sh build test
  cmake --preset release -DVOROCL_BUILD_TESTS=ON >/dev/null
  cmake --build --preset release
  ctest --test-dir build/tests/core --output-on-failure
fi
vorocl=$BUILD/tools/vorocl
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

medians() { # SIDE SEEDS: jfa, djfa and exact in milliseconds
  "$vorocl" bench --random "$2" --size "$1x$1" --methods jfa,djfa,exact --repeat "$REPEAT" --json |
    python3 -c 'import json, sys
for result in json.load(sys.stdin)["results"]: print("%.3f" % result["median_ms"], end=" | ")'
}

device_name() {
  "$vorocl" bench --random 1 --size 16x16 --methods exact --repeat 1 --json |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["device"])'
}

labels_hash() { # DEVICE SIDE SEEDS
  VOROCL_DEVICE=$1 "$vorocl" render --random "$3" --size "$2x$2" --method exact --labels "$work/labels.npy" >/dev/null
  sha256sum <"$work/labels.npy"
}

edt() { # SIDE SEEDS: by CuPy, in milliseconds
  python3 - "$@" "$REPEAT" <<'END' 2>/dev/null || printf -- '-'
import sys
import cupy
from cupyx.scipy.ndimage import distance_transform_edt
side, seeds, repeat = map(int, sys.argv[1:])
pixels = cupy.ones(side * side, dtype=bool)
pixels[cupy.random.randint(0, side * side, seeds)] = False
times = []
for _ in range(repeat):
    begin, end = cupy.cuda.Event(), cupy.cuda.Event()
    begin.record()
    distance_transform_edt(pixels.reshape(side, side), return_distances=False, return_indices=True)
    end.record()
    end.synchronize()
    times.append(cupy.cuda.get_elapsed_time(begin, end))
print("%.3f" % sorted(times)[len(times) // 2], end="")
END
}

wrong=0
{
  echo "# Measured on $(device_name)"
  echo
  echo "Medians of $REPEAT runs in milliseconds; edt is CuPy's distance transform with indices. Labels of the exact method"
  echo "are the CPU's where it says so."
  echo
  echo "| side | seeds | jfa | djfa | exact | edt | labels |"
  echo "| --- | --- | --- | --- | --- | --- | --- |"
  for side in $SIZES; do
    for share in 65536 4096 256 64 16 4; do # pixels per seed
      seeds=$((side * side / share))
      [ "$seeds" -gt 0 ] || continue
      verdict="the CPU's"
      if [ "$(labels_hash "$VOROCL_DEVICE" "$side" "$seeds")" != "$(labels_hash "Portable" "$side" "$seeds")" ]; then
        verdict=WRONG wrong=1
      fi
      echo "| $side | $seeds | $(medians "$side" "$seeds")$(edt "$side" "$seeds") | $verdict |"
    done
  done
} >"$report"
cat "$report"
exit $wrong
