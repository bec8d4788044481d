#!/usr/bin/env bash
# vorocl-mpi tiles against vorocl tiles: the same bytes from one to four processes, also after some were killed, and one
# message where it cannot be: test_shared_tiles.sh FOLDER_OF_COMMANDS FAULTS. An empty FAULTS: no library of faults.cpp.
set -euo pipefail
commands=$1
faults=$2
kills=${VOROCL_LONG_TESTS:+50}
ranks=$(dirname "$(readlink -f "$0")")/run_ranks.sh
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"

fail() {
  echo "$*" >&2
  exit 1
}

# Seeds in the file blobs.csv: in two discs, of which one is dense.
awk 'BEGIN { srand(3); print "x,y"; for (i = 0; i < 60000; ++i) { a = 6.2831853 * rand(); r = sqrt(rand()) * (i % 3 ? 40 : 300);
  print 400 + 100 * (i % 3 == 0) + r * cos(a) "," 350 + r * sin(a) } }' >blobs.csv

same() { # COUNTS ...: these options make the same files on these numbers of ranks
  local counts=$1
  shift
  local files=(labels.npy distances.npy map.png cells.csv pairs.csv)
  "$commands/vorocl" tiles "$@" --labels labels.npy --distance distances.npy -o map.png --cells cells.csv \
    --adjacency pairs.csv >/dev/null
  "$commands/vorocl" tiles "$@" --labels labels.zarr >/dev/null
  mkdir alone
  mv "${files[@]}" labels.zarr alone
  for count in $counts; do
    "$ranks" "$count" "$commands/vorocl-mpi" tiles "$@" --labels labels.npy --distance distances.npy -o map.png \
      --cells cells.csv --adjacency pairs.csv >log || fail "$count ranks, $*: failed"
    "$ranks" "$count" "$commands/vorocl-mpi" tiles "$@" --labels labels.zarr >>log || fail "$count ranks, $*: failed"
    for file in "${files[@]}" labels.zarr; do
      diff -r "$file" "alone/$file" >/dev/null || fail "$count ranks, $*: $file differs"
    done
    rm -r "${files[@]}" labels.zarr
    [ -z "$(ls -A | grep -vxE 'alone|blobs.csv|log')" ] || fail "$count ranks, $*: left $(ls -A)"
  done
  rm -r alone
}
same "1 2 3 4" --points blobs.csv --size 1000x700 --bounds 0,0,1000,700 --tile 128
same 3 --random 50000 --size 1500x900 --periodic xy --tile 400 --metric manhattan
same 4 --random 3 --size 900x20 --tile 64 --only 100,3,801,19

# Whatever is killed, and when: another run goes on, with another number of processes.
options=(--points blobs.csv --size 4000x3000 --bounds 0,0,1000,700 --tile 250)
"$commands/vorocl" tiles "${options[@]}" --labels alone.npy --cells alone.csv >/dev/null 2>&1
for kill in $(seq "${kills:-2}"); do
  setsid "$ranks" $((kill % 3 + 2)) "$commands/vorocl-mpi" tiles "${options[@]}" --labels labels.npy --cells cells.csv \
    >log 2>&1 &
  leader=$!
  sleep "$(awk -v seed="$kill" 'BEGIN { srand(seed); print 0.4 + 2.2 * rand() }')"
  if [ $((kill % 2)) = 0 ]; then
    kill -KILL -- -$leader 2>/dev/null || true
    pkill -KILL -s "$leader" 2>/dev/null || true
  else # one process alone; mpiexec ends the others
    one=$(pgrep -s "$leader" vorocl-mpi | tail -n 1) && kill -KILL "$one" || true
  fi
  wait "$leader" 2>/dev/null || true
  while pgrep -s "$leader" vorocl-mpi >/dev/null; do sleep 0.05; done
  if [ ! -e labels.npy ] || [ ! -e cells.csv ] || [ -e labels.npy.journal ]; then
    "$ranks" $((kill % 2 + 1)) "$commands/vorocl-mpi" tiles "${options[@]}" --labels labels.npy --cells cells.csv \
      --resume >log 2>&1 || fail "after kill $kill: $(grep vorocl-mpi: log)"
  fi
  cmp labels.npy alone.npy || fail "after kill $kill: other labels"
  cmp cells.csv alone.csv || fail "after kill $kill: other cells"
  rm -f labels.npy cells.csv .vorocl-* # what SIGKILL leaves is hidden
  [ -z "$(ls -A | grep -vxE 'alone.*|blobs.csv|log')" ] || fail "after kill $kill: left $(ls -A)"
done

# A run that ends while its outputs get their names is completed, whether one has its name or all have.
ended() { # OUTPUTS ...
  local options=(--random 100 --size 100x100 --tile 64 --resume "$@")
  mkdir whole left
  (cd whole && "$commands/vorocl" tiles "${options[@]}" >/dev/null)
  cd left
  if LD_PRELOAD=$faults VOROCL_FAULT='rename 3 on' "$commands/vorocl" tiles "${options[@]}" >../log 2>&1; then
    fail "$*: was not ended"
  fi
  [ -e "$2" ] && [ ! -e "$4" ] && [ -e "$4.part" ] || fail "$*: not one has its name: $(ls)"
  cp "$2.journal" ../journal
  for count in 2 3; do
    cp ../journal "$2.journal"
    "$ranks" $count "$commands/vorocl-mpi" tiles "${options[@]}" >../log 2>&1 || fail "$count ranks, $*: $(cat ../log)"
    ! grep -q 'made none' ../log || fail "$count ranks, $*: a note on nothing to make"
    diff -r . ../whole || fail "$count ranks, $*: other files"
  done
  cd ..
  rm -r whole left journal
}
if [ -n "$faults" ]; then
  ended --labels a.npy --distance b.npy
  ended --labels a.zarr --distance b.zarr
  ended --labels a.npy -o b.png
  ended --labels a.npy --cells b.csv
fi

# A process that stops for a while keeps no other from its end, however much it has to tell of its cells.
cat >slow.sh <<'END'
#!/usr/bin/env bash
if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then (sleep 1; kill -STOP $$; sleep 4; kill -CONT $$) & fi
exec "$@"
END
chmod +x slow.sh
many=(--random 300000 --size 2048x2048 --tile 128 --cells cells.csv)
"$commands/vorocl" tiles "${many[@]}" >/dev/null && mv cells.csv alone.csv
timeout 100 "$ranks" 2 ./slow.sh "$commands/vorocl-mpi" tiles "${many[@]}" >log 2>&1 ||
  fail "a slow process: $(cat log)"
cmp cells.csv alone.csv || fail "a slow process: other cells"
rm cells.csv alone.csv

refused() { # MESSAGE COUNT ...: the options end the run with this message, once
  local message=$1 count=$2
  shift 2
  if "$ranks" "$count" "$commands/vorocl-mpi" tiles "$@" >log 2>&1; then fail "$*: was not refused"; fi
  [ "$(grep -c '^vorocl-mpi: error: ' log)" = 1 ] || fail "$*: not one message: $(cat log)"
  grep -qF "$message" log || fail "$*: no \"$message\" in: $(cat log)"
}
refused 'cannot read missing.csv' 3 --points missing.csv --size 100x100 --labels x.npy
refused 'take .zarr or .npy' 2 --random 10 --size 100x100 --labels x.tif
refused 'take .zarr or .npy' 2 --random 10 --size 100x100 --distance x.tif
refused 'nothing to write' 2 --random 10 --size 100x100
refused 'mask is for vorocl tiles' 2 --mask missing.png --labels x.npy
if "$ranks" 1 "$commands/vorocl-mpi" >log 2>&1; then fail "no subcommand: was not refused"; fi
grep -q '^vorocl-mpi: error: .*; see vorocl-mpi --help$' log || fail "no subcommand: $(cat log)"
refused "the plane's width is 0" 2 --random 10 --size 0x100 --labels x.npy
{ cat blobs.csv blobs.csv blobs.csv; echo 'inf,1'; } | sed '2,$ { /x,y/d }' >bad.csv
refused 'not finite' 3 --points bad.csv --size 100x100 --labels x.npy
echo mine >x.npy.journal
refused 'x.npy.journal is no journal of a run' 2 --random 10 --size 100x100 --labels x.npy --resume
rm x.npy.journal
[ ! -e x.npy ] && [ ! -e x.npy.part ] || fail "a refused run left something"

cat >other.sh <<'END'
#!/usr/bin/env bash
[ "$OMPI_COMM_WORLD_RANK" != 1 ] || set -- "$@" $OTHER
exec "$@"
END
chmod +x other.sh
for other in --bogus '--tile 64' --help; do
  if OTHER=$other timeout 60 "$ranks" 2 \
    ./other.sh "$commands/vorocl-mpi" tiles --random 9 --size 99x99 --labels x.npy >log 2>&1; then
    fail "a process with $other was not refused"
  fi
  [ "$(grep -c '^vorocl-mpi: error: ' log)" = 1 ] || fail "a process with $other: not one message: $(cat log)"
done

# Fewer seeds than ranks, and ranks without tiles, are no error.
"$ranks" 4 "$commands/vorocl-mpi" tiles --random 2 --size 100x100 --labels x.npy >log 2>&1
grep -q 'these ranks made none: ' log || fail "idle ranks are not named: $(cat log)"
