#!/usr/bin/env bash
# The scripts that make docs/evaluation.md, on tiny tables: test_evaluation_scripts.sh VOROCL. Exits with 77 where
# python3-matplotlib is not installed.
set -euo pipefail
command=$1
scripts=$(dirname "$(realpath "$0")")/../../tools/studies
study() { "$scripts/study.py" "$@" --vorocl "$command"; }
/usr/bin/python3 -c 'import matplotlib' 2>/dev/null || { echo "python3-matplotlib is not installed: skipped"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export MPLCONFIGDIR=$folder/matplotlib
is_png() { [ "$(head -c 4 "$1")" = $'\x89PNG' ] || { echo "$1 is no picture"; exit 1; }; }
refuses() { # refuses TEXT SCRIPT ARGUMENT...: one line, which says TEXT
  local text=$1
  shift
  if PATH=$scripts:$PATH "$@" >/dev/null 2>said; then echo "$* was done"; exit 1; fi
  if [ "$(wc -l <said)" -ne 1 ] || ! grep -qF -- "$text" said; then echo "\"$text\" was wanted, and it said:"; cat said; exit 1; fi
}

# Lengths of regions, against a loop over the pixels.
"$command" render --random 60 --size 57x40 --method exact --labels labels.npy -o labels.png >/dev/null
"$scripts/figures.py" lengths labels.npy -o lengths.png >lengths.csv
is_png lengths.png
/usr/bin/python3 - <<'PYTHON'
import csv
import math
import numpy

places = {}
for y, row in enumerate(numpy.load("labels.npy").tolist()):
    for x, label in enumerate(row):
        places.setdefault(label, []).append((x, y))
expected = {"square root of the area": [], "larger side of the bounding box": []}
for pixels in places.values():
    xs, ys = zip(*pixels)
    expected["square root of the area"].append(math.sqrt(len(pixels)))
    expected["larger side of the bounding box"].append(max(max(xs) - min(xs), max(ys) - min(ys)) + 1)
l_avg = math.sqrt(57 * 40 / len(places))
rows = list(csv.DictReader(open("lengths.csv")))
assert [row["length"] for row in rows] == list(expected), rows
for row in rows:
    lengths = expected[row["length"]]
    mean = sum(lengths) / len(lengths)
    deviation = math.sqrt(sum((length - mean) ** 2 for length in lengths) / len(lengths))
    under = 100 * sum(length < 2 * l_avg for length in lengths) / len(lengths)
    for column, value in [("regions", len(places)), ("l_avg", l_avg), ("mean", mean), ("deviation", deviation),
                          ("greatest", max(lengths)), ("percent_under_2_l_avg", under)]:
        assert abs(float(row[column]) - value) < 1e-5, (row["length"], column, row[column], value)
PYTHON
refuses 'missing.npy' figures.py lengths missing.npy -o a.png
refuses 'labels.png' figures.py lengths labels.png -o a.png

"$scripts/figures.py" montage -o montage.png --columns 2 "one=labels.png" "" "two=lengths.png"
is_png montage.png
refuses 'missing.png' figures.py montage -o a.png "one=missing.png"

# The study: it goes on where a run has ended, and a table of other settings is refused.
tiny=(--sizes 40,64 --seeds "2%,20%" --frames 3 --timed-frames 2 --repeats 1)
study evaluate "${tiny[@]}" -o evaluation.csv >/dev/null
head -n -1 evaluation.csv >ended.csv
study evaluate "${tiny[@]}" -o ended.csv --resume | grep -qx '64 x 64 pixels, 819 seeds: ended.csv has 24 rows'
! study evaluate "${tiny[@]}" -o ended.csv --resume | grep .
without_times() { cut -d, -f 11-17,24- "$1"; }
cmp <(without_times evaluation.csv) <(without_times ended.csv)
refuses 'ended.csv exists; --resume goes on with it' study.py evaluate -o ended.csv --vorocl "$command"
refuses 'ended.csv is of another study: rng_seed is 1 there and 2 here' \
  study.py evaluate "${tiny[@]}" --rng-seed 2 -o ended.csv --resume --vorocl "$command"
refuses '0% of 40 x 40 pixels are 0 seeds' study.py evaluate --sizes 40 --seeds 0% -o a.csv --vorocl "$command"
refuses '--sizes takes n,... and --seeds S|P%' study.py evaluate --sizes x -o a.csv --vorocl "$command"
refuses "cannot run ./none: No such file or directory" study.py evaluate -o a.csv --vorocl ./none
refuses 'no usable OpenCL device' env VOROCL_DEVICE=none study.py evaluate -o a.csv --vorocl "$command"
[ ! -e a.csv ] || { echo "a table was made all the same"; exit 1; }

# The tables.
study ablation --sizes 40 --seeds 2% --frames 3 --timed-frames 2 --repeats 1 -o ablation.csv >/dev/null
for name in machine lengths similarity times published ablation; do
  printf 'before %s\n<!-- table %s -->\nold\n<!-- end -->\n' "$name" "$name"
done >document.md
"$scripts/evaluation_tables.py" document.md .
[ "$(grep -c '^before' document.md)" -eq 6 ] || { echo "text around the tables is gone"; exit 1; }
! grep -q '^old' document.md || { echo "an old table has stayed"; exit 1; }
rows() { sed -n "/<!-- table $1 -->/,/<!-- end -->/p" document.md | grep -c '^| '; }
[ "$(rows times) $(rows similarity) $(rows ablation) $(rows lengths)" = "6 6 29 4" ] || { echo "rows are missing:"; cat document.md; exit 1; }
grep -q 'speedup of dJFAe, 1,000², 100 pixels per seed | notebook | 2.1 × | not run' document.md
cp document.md again.md
"$scripts/evaluation_tables.py" again.md .
cmp document.md again.md
sed -i '/table times/d' document.md
refuses 'must have one place "<!-- table times -->"' evaluation_tables.py document.md .
refuses 'evaluation.csv' evaluation_tables.py again.md figures
