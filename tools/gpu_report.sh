#!/usr/bin/env bash
# All figures of a GPU by one command: builds the core's tests and the command, passes the tests on the device, checks its
# labels of known diagrams, times jfa, djfa and exact at three sizes and all densities, with the sets made to hurt and with
# seeds that move, and writes the tables, with the device's name, to FILE:
#   tools/gpu_report.sh [FILE]               FILE: default output/gpu.md
# The exact diagram's labels are held against those of the vector shape on the CPU, by their hashes. With CuPy installed,
# cupyx.scipy.ndimage.distance_transform_edt() is timed beside them. The sets made to hurt need NumPy.
#   VOROCL_DEVICE  the device; default NVIDIA       REPEAT  runs of each, of which the median is taken; default 9
#   SIZES          sides in pixels; default "2048 8192 10000". The sets made to hurt are of the first one
#   FRAMES         after the first one, of moving seeds; default 30
#   BUILD          an existing build's folder with the command; default: built in build/, and tested
set -euo pipefail
cd "$(dirname "$0")/.."
: "${VOROCL_DEVICE:=NVIDIA}" "${SIZES:=2048 8192 10000}" "${REPEAT:=9}" "${FRAMES:=30}"
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
vorocl=$(realpath "$BUILD")/tools/vorocl
"$vorocl" devices --check
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Where seeds come from: the options of the command that say so, for so many random ones or those of a file.
source_of() { # SIDE SEEDS|FILE
  if [ -e "$2" ]; then echo "--points $2 --bounds 0,0,$1,$1"; else echo "--random $2"; fi
}

bench_json() { # SIDE SEEDS|FILE
  "$vorocl" bench $(source_of "$@") --size "$1x$1" --methods jfa,djfa,exact --repeat "$REPEAT" --json
}

device_name() {
  bench_json 16 1 | python3 -c 'import json, sys; print(json.load(sys.stdin)["device"])'
}

medians() { # SIDE SEEDS|FILE: jfa, djfa and exact in milliseconds
  bench_json "$@" | python3 -c 'import json, sys
for result in json.load(sys.stdin)["results"]: print("%.3f" % result["median_ms"], end=" | ")'
}

# By CuPy, in milliseconds.
edt() { # SIDE SEEDS|FILE
  python3 - "$@" "$REPEAT" <<'END' 2>/dev/null || printf -- '-'
import sys
import cupy
from cupyx.scipy.ndimage import distance_transform_edt
side, seeds, repeat = int(sys.argv[1]), sys.argv[2], int(sys.argv[3])
pixels = cupy.ones((side, side), dtype=bool)
if seeds.endswith(".npy"):
    x, y = cupy.load(seeds).astype(int).T
else:
    x, y = cupy.random.randint(0, side, (2, int(seeds)))
pixels[y, x] = False
times = []
for _ in range(repeat):
    begin, end = cupy.cuda.Event(), cupy.cuda.Event()
    begin.record()
    distance_transform_edt(pixels, return_distances=False, return_indices=True)
    end.record()
    end.synchronize()
    times.append(cupy.cuda.get_elapsed_time(begin, end))
print("%.3f" % sorted(times)[len(times) // 2], end="")
END
}

labels_hash() { # DEVICE COMMAND...: of all files that a command writes in its folder
  rm -rf "$work/labels"
  mkdir "$work/labels"
  (cd "$work/labels" && VOROCL_DEVICE=$1 "${@:2}" >/dev/null && cat -- * | sha256sum)
}

verdict() { # COMMAND...
  local own cpu
  own=$(labels_hash "$VOROCL_DEVICE" "$@")
  cpu=$(labels_hash "Portable Computing Language" "$@")
  if [ -n "$own" ] && [ "$own" = "$cpu" ]; then echo "the CPU's"; else echo WRONG; fi
}

still() { # SIDE SEEDS|FILE: the cells of a row of a table
  echo "$(medians "$@")$(edt "$@") | $(verdict "$vorocl" render $(source_of "$@") --size "$1x$1" --method exact \
    --labels labels.npy)"
}

milliseconds_per_frame() { # METHOD SIDE SEEDS
  "$vorocl" simulate --random "$3" --size "$2x$2" --method "$1" --step-length 1 --frames "$FRAMES" --json |
    python3 -c 'import json, sys; print("%.3f" % (json.load(sys.stdin)["milliseconds"] / (int(sys.argv[1]) + 1)))' "$FRAMES"
}

moving() { # SIDE SEEDS: the cells of a row of a table
  for method in jfa djfa exact; do printf '%s | ' "$(milliseconds_per_frame $method "$@")"; done
  verdict "$vorocl" simulate --random "$2" --size "$1x$1" --method exact --step-length 1 --frames "$FRAMES" \
    --every "$FRAMES" --labels labels%d.npy
}

sizes_and_densities() { # calls COMMAND with SIDE SEEDS for each
  local side share
  for side in $SIZES; do
    for share in 65536 4096 256 64 16 4; do # pixels per seed
      [ $((side * side / share)) -eq 0 ] || "$@" "$side" $((side * side / share))
    done
  done
}

row_of() { echo "| $2 | $3 | $("$1" "$2" "$3") |"; }

{
  echo "# Measured on $(device_name)"
  echo
  echo "Medians of $REPEAT runs in milliseconds; edt is CuPy's distance transform with indices. Labels of the exact method"
  echo "are the CPU's where it says so."
  echo
  echo "| side | seeds | jfa | djfa | exact | edt | labels |"
  echo "| --- | --- | --- | --- | --- | --- | --- |"
  sizes_and_densities row_of still
  echo
  echo "Seeds that move by up to a pixel along each axis and frame: milliseconds per frame, the mean of $((FRAMES + 1)) frames;"
  echo "dJFA's first one is a whole JFA. Labels are those of the first and the last frame."
  echo
  echo "| side | seeds | jfa | djfa | exact | labels |"
  echo "| --- | --- | --- | --- | --- | --- |"
  sizes_and_densities row_of moving
  echo
  side=${SIZES%% *}
  if mkdir "$work/sets" && python3 docs/hurtful_sets.py "$work/sets" "$side" 2>/dev/null; then
    echo "Sets made to hurt (docs/hurtful_sets.py)."
    echo
    echo "| side | set | jfa | djfa | exact | edt | labels |"
    echo "| --- | --- | --- | --- | --- | --- | --- |"
    for set in "$work"/sets/*.npy; do echo "| $side | $(basename "$set" .npy) | $(still "$side" "$set") |"; done
  else
    echo "The sets made to hurt are left out: NumPy is not installed."
  fi
} >"$report"
cat "$report"
! grep -q WRONG "$report"
