#!/usr/bin/env bash
# Fuzzes the readers and the command line with libFuzzer, under the address and undefined behaviour sanitizers, for so
# many seconds in all, each target for its part of them:
#   fuzz.sh SECONDS [TARGET]...     TARGET: csv, mask, npy, tiff, trajectory, command_line; without any, all
# Says how many inputs each has read. What it finds lies in build-fuzz/findings/, and the exit code is not 0 then; inputs
# that reach something new are kept in build-fuzz/corpus/ for the next time. The corpus and the dictionaries that it
# starts from are in tests/reliability/fuzz/.
set -euo pipefail
cd "$(dirname "$0")/../.."
[ $# -gt 0 ] || { echo "fuzz.sh SECONDS [TARGET]..." >&2; exit 2; }
seconds=$1
shift
[ $# -gt 0 ] || set -- csv mask npy tiff trajectory command_line
fuzz=$PWD/tests/reliability/fuzz build=$PWD/build-fuzz

[ -e "$build/build.ninja" ] || CC=clang CXX=clang++ cmake --preset fuzz >/dev/null
targets=fuzz_readers
[[ " $* " != *" command_line "* ]] || targets+=" fuzz_command_line"
cmake --build "$build" --target $targets >"$build/build.log" || { tail -n 40 "$build/build.log"; exit 1; }

work=$(TMPDIR=$([ -w /dev/shm ] && echo /dev/shm || echo /tmp) mktemp -d)  # in memory: each input is a file
trap 'rm -rf "$work"' EXIT
fuzz_one() { # TARGET
  local target=$1 log=$work/$1.log
  mkdir -p "$build/corpus/$target" "$build/findings"
  # Output is discarded, but for libFuzzer's.
  TMPDIR=$work "$(find "$build" -type f -name "fuzz_$target")" -max_total_time=$(((seconds + targets_in_all - 1) / targets_in_all)) \
    -timeout=20 -max_len=4096 \
    -malloc_limit_mb=512 -rss_limit_mb=2048 -print_final_stats=1 -close_fd_mask=3 \
    -dict="$fuzz/dictionaries/$target.dict" -artifact_prefix="$build/findings/$target-" \
    "$build/corpus/$target" "$fuzz/corpus/$target" >"$log" 2>&1 || { cat "$log"; echo "$target: a finding"; return 1; }
  echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs, no finding"
}
export -f fuzz_one
export work fuzz build seconds targets_in_all=$#
printf '%s\n' "$@" | xargs --max-procs "$(nproc)" --max-args 1 bash -euc 'fuzz_one "$1"' fuzz
