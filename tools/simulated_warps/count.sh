#!/usr/bin/env bash
# What a GPU's warps would execute for one diagram, kernel by kernel: count.sh BUILD METHOD SIDE SEEDS [EVERY]
# BUILD is the folder of a build of static libraries. One work-group in EVERY is counted (default 1): at 1024 x 1024 pixels 11
# takes minutes. `tools/setup.sh warps` installs what it needs; without that it exits with 77. docs/gpu.md has such counts.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(realpath "$1") every=${5:-1}
driver=/usr/lib/oclgrind/liboclgrind-rt-icd.so
llvm=$(ls -d /usr/lib/llvm-*/include/llvm 2>/dev/null | head -n 1)
[ -e $driver ] && [ -e /usr/include/oclgrind/Plugin.h ] && [ -n "$llvm" ] || { echo "Oclgrind's headers are not installed: skipped"; exit 77; }

folder=$build/simulated_warps
mkdir -p "$folder/icd"
echo $driver >"$folder/icd/oclgrind.icd"
compile() { # TARGET SOURCE OPTION...
  [ "$1" -nt "$2" ] || g++ -O2 -std=c++17 "${@:3}" "$2" -o "$1.part" -lOpenCL "${libraries[@]}" -lpthread -ldl
  [ ! -e "$1.part" ] || mv "$1.part" "$1"
}
libraries=(-loclgrind)
compile "$folder/plugin.so" "$here/plugin.cpp" -fPIC -shared -fno-rtti -DLLVM_DISABLE_ABI_BREAKING_CHECKS_ENFORCING=1 -I"$(dirname "$llvm")"
libraries=("$build/libvorocl.a")
[ "$folder/diagram" -nt "$build/libvorocl.a" ] || rm -f "$folder/diagram"
compile "$folder/diagram" "$here/diagram.cpp" -I"$here/../../include" -I"$build/include"
export OCL_ICD_VENDORS=$folder/icd VOROCL_DEVICE=oclgrind OCLGRIND_NUM_THREADS=1 OCLGRIND_PLUGINS=$folder/plugin.so WARPS_EVERY=$every
"$folder/diagram" "${@:2:3}" | sed '0,/^diagram$/d'
