#!/usr/bin/env bash
# The figures of a tiny evaluation: test_plot_evaluation.sh VOROCL. Exits with 77 where python3-matplotlib is not installed.
set -euo pipefail
command=$1
plot=$(dirname "$(realpath "$0")")/../../tools/studies/figures.py
/usr/bin/python3 -c 'import matplotlib' 2>/dev/null || { echo "python3-matplotlib is not installed: skipped"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export MPLCONFIGDIR=$folder/matplotlib

"$(dirname "$plot")/study.py" evaluate --vorocl "$command" --sizes 40,64 --seeds 2%,20% --frames 5 --timed-frames 3 -o table.csv >/dev/null
"$plot" evaluation table.csv -o figures
for name in similarity times speedup; do
  for axis in n density; do
    [ "$(head -c 4 "figures/${name}_$axis.png")" = $'\x89PNG' ] || { echo "${name}_$axis.png is no picture"; exit 1; }
  done
done
[ "$(find figures -type f | wc -l)" -eq 6 ] || { echo "there are other files too:"; find figures; exit 1; }

# refuses TEXT FILE: nothing is drawn, and one line says TEXT.
refuses() {
  if "$plot" evaluation "$2" -o none 2>said; then echo "$2 was drawn"; exit 1; fi
  if [ "$(wc -l <said)" -ne 1 ] || ! grep -qF "$1" said; then echo "\"$1\" was wanted, and it said:"; cat said; exit 1; fi
  [ ! -e none ] || { echo "a folder was made for $2"; exit 1; }
}
printf 'x,y\n1,2\n' >points.csv
refuses 'points.csv is no table of study.py evaluate: it has no column version' points.csv
refuses 'cannot read missing.csv: No such file' missing.csv
head -n 1 table.csv >empty.csv
refuses 'holds no configuration' empty.csv
{ cat table.csv; tail -n 1 table.csv | sed 's/^[^,]*/9.9/'; } >mixed.csv
refuses 'differ in version' mixed.csv
head -c -40 table.csv >cut.csv
refuses 'cut.csv:25' cut.csv
