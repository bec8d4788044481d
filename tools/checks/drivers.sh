#!/usr/bin/env bash
# Passes the core's tests on several OpenCL drivers for CPUs, with the exact engine in both shapes: drivers.sh [BUILD]
# BUILD is the folder of a build with the tests; without it build/ is built. The drivers are PoCL, as the system has it
# (Debian 12: 3.1, Debian 13: 6.0), Intel's runtime, which it installs into a folder of its own, and on Debian 13 Mesa's
# rusticl on llvmpipe, whose compiler gives up on some kernels (Mesa 25: "Unsupported vector type with 32 elements"). What cannot be
# had is listed as skipped. The logs are in BUILD/drivers/.
set -euo pipefail
cd "$(dirname "$0")/../.."
tools/setup.sh drivers || echo "Not every driver can be installed here."

build=${1:-build}
if [ $# -eq 0 ]; then
  tools/setup.sh build test
  cmake --preset release -DVOROCL_BUILD_TESTS=ON >/dev/null
  cmake --build --preset release
fi
# Not those of C, which know no shapes.
tests=$(find "$build/tests/core" -maxdepth 1 -name 'test_*' ! -name 'test_c_api*' -type f -executable -printf '%f\n' | sort)
failed=0

run_test() { # PROGRAM SHAPE LOG: prints the program's name if it fails, or hangs
  timeout 3600 "$1" -- "$2" >"$3" 2>&1 || basename "$1"
}
export -f run_test
# For Intel's runtime: for AVX-512 it has compiled kernels of exact diagrams to an instruction that no CPU has.
export CL_CONFIG_CPU_TARGET_ARCH=core-avx2

run_tests() { # SHAPE LOGS
  for test in $tests; do echo "$build/tests/core/$test $1 $2/$test.$1.log"; done |
    xargs -P "$(nproc)" -L 1 bash -c 'run_test "$@"' run_test
}

check_driver() { # NAME LIBRARY FOLDER: a driver that needs the libraries in a folder
  local shape failures logs
  logs=$(realpath "$build")/drivers/$1
  rm -rf "$logs"
  mkdir -p "$logs"
  echo "$2" >"$logs/driver.icd"
  for shape in vector group; do
    failures=$(OCL_ICD_VENDORS=$logs LD_LIBRARY_PATH=$3 VOROCL_DEVICE=0:0 run_tests $shape "$logs")
    if [ -z "$failures" ]; then
      echo "$1, $shape shape: $(wc -w <<<"$tests") tests passed"
    else
      failed=1
      echo "$1, $shape shape: FAILED:" $failures
    fi
  done
}

pocl=$(cat /etc/OpenCL/vendors/pocl.icd 2>/dev/null || true)
if [ -n "$pocl" ]; then check_driver PoCL "$pocl" ""; else echo "PoCL is not installed: skipped"; fi
intel=${XDG_CACHE_HOME:-$HOME/.cache}/vorocl/intel-opencl/lib
if [ -e "$intel" ]; then check_driver Intel "$intel/libintelocl.so" "$intel"; else echo "Intel's runtime cannot be had: skipped"; fi
rusticl=$(cat /etc/OpenCL/vendors/rusticl.icd 2>/dev/null || true)
if [ -n "$rusticl" ]; then
  RUSTICL_ENABLE=llvmpipe check_driver rusticl "$rusticl" ""
else
  echo "rusticl is not installed: skipped"
fi
exit $failed
