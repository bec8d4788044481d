#!/usr/bin/env bash
# Makes the figures, tables and .csv files of docs/evaluation.md anew, in some 20 minutes on two cores that have
# nothing else to do: evaluation_figures.sh [VOROCL [PART]...]. The parts are pictures, lengths, evaluation, large,
# similarities, plans, resolution, ablation and tables; without any, all of them.
set -euo pipefail
cd "$(dirname "$0")/../.."
vorocl=$(realpath "${1:-build/tools/vorocl}")
study() { tools/studies/study.py "$@" --vorocl "$vorocl"; }
shift || true
parts=" ${*:-pictures lengths evaluation large similarities plans resolution ablation tables} "
out=$PWD/docs/evaluation
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export POCL_AFFINITY=1 MPLCONFIGDIR=$work/matplotlib
mkdir -p "$out"
wants() { [[ $parts == *" $1 "* ]]; }
montage() { tools/studies/figures.py montage -o "$out/$1.png" "${@:2}"; }

if wants pictures; then
  "$vorocl" render --random 17 --size 500x500 --method exact --edges 2 --points-overlay -o "$work/17.png"
  montage seeds17 --columns 1 --inches 3.5 "=$work/17.png"

  # wave_pictures NAME METHOD CAPTION...: the arguments of a row of six pictures.
  wave_pictures() {
    local name=$1 method=$2 i=0 caption
    shift 2
    "$vorocl" render --points "$work/$name.csv" --size 8x8 --bounds 0,0,8,8 --method "$method" --enlarge 24 \
      --points-overlay --waves "$work/$name-$method-%d.png" >/dev/null
    for caption in "$@"; do
      row+=("$caption=$work/$name-$method-$i.png")
      i=$((i + 1))
    done
    while [ $((${#row[@]} % 6)) -ne 0 ]; do row+=(""); done
  }
  printf 'x,y\n2.5,2.5\n' >"$work/one.csv"
  printf 'x,y\n1.5,1.5\n6.5,2.5\n3.5,6.5\n' >"$work/three.csv"
  row=()
  wave_pictures one standard-flooding "StF: seed" "wave 1" "wave 2" "wave 3" "wave 4" "wave 5"
  wave_pictures one jfa "JFA: seed" "wave 1, step 4" "wave 2, step 2" "wave 3, step 1"
  wave_pictures three standard-flooding "StF: seeds" "wave 1" "wave 2" "wave 3" "wave 4"
  wave_pictures three jfa "JFA: seeds" "wave 1, step 4" "wave 2, step 2" "wave 3, step 1"
  montage flooding --columns 6 --inches 1.5 "${row[@]}"

  printf 'x,y\n4.5,4.5\n' >"$work/centre.csv"
  for neighbourhood in moore von-neumann; do
    "$vorocl" render --points "$work/centre.csv" --size 9x9 --bounds 0,0,9,9 --method 1+jfa --neighbourhood "$neighbourhood" \
      --enlarge 24 --points-overlay --waves "$work/$neighbourhood-%d.png" >/dev/null
    "$vorocl" render --random 15 --size 150x150 --method jfa --neighbourhood "$neighbourhood" --enlarge 4 \
      --points-overlay -o "$work/$neighbourhood.png"
  done
  montage neighbourhoods --columns 2 --inches 1.5 "Moore=$work/moore-1.png" "von Neumann=$work/von-neumann-1.png"
  montage von_neumann --columns 2 --inches 4 "JFA, Moore=$work/moore.png" "JFA, von Neumann=$work/von-neumann.png"

  "$vorocl" simulate --random 50 --size 1000x1000 --frames 100 --step-length 5 --method djfa --every 20 --edges 4 \
    --points-overlay -o "$work/frame-%d.png"
  frames=()
  for frame in 0 20 40 60 80 100; do frames+=("frame $frame=$work/frame-$frame.png"); done
  montage frames50 --columns 3 --inches 2.6 "${frames[@]}"
fi

if wants lengths; then
  "$vorocl" render --random 10000 --size 2000x2000 --method exact --labels "$work/labels.npy"
  tools/studies/figures.py lengths "$work/labels.npy" -o "$out/lengths.png" --dpi 80 >"$work/lengths.csv"
  mv "$work/lengths.csv" "$out/"
fi

if wants evaluation; then
  study evaluate -o "$work/evaluation.csv"
  mv "$work/evaluation.csv" "$out/"
fi
if wants large; then
  study evaluate --sizes 10000 --seeds 1% --frames 1 --timed-frames 5 -o "$work/evaluation-10000.csv"
  mv "$work/evaluation-10000.csv" "$out/"
fi
if wants similarities; then
  # The mean similarity of a simulation with these options.
  similarity() { "$vorocl" simulate "$@" --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["similarity"]["mean"])'; }
  {
    echo "n,seeds,reach,extra_waves,compare_with,tolerance,similarity"
    for seeds in 2000 20000 40000; do
      for way in "paper 0 jfa" "paper 2 jfa" "paper 2 jfa+2" "authors 2 jfa+2 0.2"; do
        read -r reach extra_waves other tolerance <<<"$way"
        echo "2000,$seeds,$reach,$extra_waves,$other,$tolerance,$(similarity --random "$seeds" --size 2000x2000 --frames 20 \
          --step-length 5 --method djfa --reach "$reach" --extra-waves "$extra_waves" --compare-with "$other" \
          ${tolerance:+--tolerance "$tolerance"})"
      done
    done
  } >"$work/extra_waves.csv"
  {
    echo "n,seeds,strict,tolerant"
    for case in "1000 10000" "2000 40000" "4000 1600" "4000 16000" "4000 160000"; do
      read -r n seeds <<<"$case"
      exact=(--random "$seeds" --size "${n}x$n" --frames 1 --step-length 1 --method exact --compare-with exact --compare-metric manhattan)
      echo "$n,$seeds,$(similarity "${exact[@]}"),$(similarity "${exact[@]}" --tolerance "${n}e-4")"
    done
  } >"$work/tolerance.csv"
  mv "$work"/{extra_waves,tolerance}.csv "$out/"
fi
if wants plans; then
  # A row: the waves, the milliseconds per frame and the wrong pixels of a simulation with these options.
  row_of() {
    "$vorocl" simulate "$@" --frames 20 --step-length 5 --compare-with exact --json | python3 -c '
import json, sys
run = json.load(sys.stdin)
print(run["waves"], run["milliseconds"] / run["frames"], run["errors"]["wrong_percent_mean"], sep=",")'
  }
  {
    echo "n,seeds,method,reach,extra_waves,round,waves,milliseconds,wrong_percent"
    for seeds in 400 4000 40000 200000; do
      for round in 1 2 3; do
        echo "2000,$seeds,jfa,,,$round,$(row_of --random "$seeds" --size 2000x2000 --method jfa)"
        for way in "paper 0" "authors 0" "authors 1" "authors 2"; do
          read -r reach extra_waves <<<"$way"
          echo "2000,$seeds,djfa,$reach,$extra_waves,$round,$(row_of --random "$seeds" --size 2000x2000 --method djfa \
            --reach "$reach" --extra-waves "$extra_waves")"
        done
      done
    done
  } >"$work/plans.csv"
  mv "$work/plans.csv" "$out/"
fi
if wants resolution; then
  /usr/bin/python3 docs/hurtful_sets.py "$work"
  {
    echo "seeds,round,method,milliseconds,wrong_pixels"
    for seeds in 256 4096 65536 262144 five-clusters ring; do
      for round in 1 2 3; do
        input=(--random "$seeds" --rng-seed "$round")
        [ ! -e "$work/$seeds.npy" ] || input=(--points "$work/$seeds.npy" --bounds 0,0,2048,2048)
        "$vorocl" bench "${input[@]}" --size 2048x2048 --methods jfa,low-resolution,exact --repeat 5 --json | python3 -c "
import json, sys
for row in json.load(sys.stdin)['results']:
    print('$seeds', $round, row['method'], row['min_ms'], row['wrong_pixels'], sep=',')"
      done
    done
  } >"$work/resolution.csv"
  mv "$work/resolution.csv" "$out/"
fi
if wants ablation; then
  study ablation -o "$work/ablation.csv"
  mv "$work/ablation.csv" "$out/"
fi
if wants tables; then
  tools/studies/figures.py evaluation "$out/evaluation.csv" -o "$out" --dpi 70
  tools/studies/evaluation_tables.py docs/evaluation.md "$out"
fi
