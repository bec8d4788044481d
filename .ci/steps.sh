# For the scripts beside it. step NAME COMMAND...: runs a command with its output in build/ci/NAME.log, says how long it
# took, and stops with the end of its output if it fails.
logs=$PWD/build/ci
mkdir -p "$logs"
export CTEST_PARALLEL_LEVEL
CTEST_PARALLEL_LEVEL=$(nproc)
export VOROCL_DEVICE="Portable Computing Language"

step() {
  local name=$1 log=$logs/$1.log begin=$SECONDS
  shift
  printf '%-20s' "$name"
  if "$@" >"$log" 2>&1 </dev/null; then
    echo "$((SECONDS - begin)) s"
  else
    printf 'FAILED after %d s; the end of %s:\n' "$((SECONDS - begin))" "$log"
    tail -n 80 "$log"
    grep -B 2 -A 12 'error: in "' "$log" | tail -n 60 || true # what Boost.Test found, also in the middle
    exit 1
  fi
}

# preset NAME OPTION...: configures, builds and tests a preset.
preset() {
  local name=$1
  shift
  step "$name-configure" cmake --preset "$name" "$@"
  step "$name-build" cmake --build --preset "$name"
  step "$name-tests" ctest --preset "$name"
}
