#!/usr/bin/env bash
# Checks the symbols of the library. Exits with 77 where nm is not installed.
#   check_symbols.sh exported FILE.so ABI
#                                       a shared library exports its API and nothing else, and each symbol has the version
#                                       of its interface
#   check_symbols.sh bindings FILE.a    an unoptimised static library calls no function of OpenCL's C++ bindings whose code
#                                       depends on its user's settings (see src/runtime/opencl_error.hpp)
set -euo pipefail
command -v nm >/dev/null || { echo "nm is not installed: skipped"; exit 77; }

case $1 in
exported)
  all=$(nm -DC --defined-only --with-symbol-versions "$2" | sed 's/^[0-9a-f]* . //')
  abi=${3//./\\.}
  cxx="(vorocl::.*|(vtable|typeinfo|typeinfo name) for vorocl::(Error|BadPoint|SeedSource))@@VOROCL_CXX_$abi"
  c="vorocl_[a-z_]+3?@@VOROCL_C_$abi"
  nodes="VOROCL_(C|CXX)_$abi(@@VOROCL_(C|CXX)_$abi)?" # the versions themselves
  found=$(grep -Ev "^($cxx|$c|$nodes)$" <<<"$all" || true)
  # The library's own internals are in its namespace too.
  found+=$(grep -E '^vorocl::(Kernel|Flood|allocate|check|program_for|kernel_sources)\b' <<<"$all" || true)
  for wanted in 'vorocl::jump_flooding(' 'vorocl_run'; do
    grep -qF "$wanted" <<<"$all" || { echo "$wanted is not exported by $2"; exit 1; }
  done
  ;;
bindings)
  # Methods, and constructors that make an object rather than hold one.
  found=$(nm -C "$2" | grep -E ' [WVuBU] ' | sed 's/^.* [WVuBU] //' | sort -u |
    grep -E '(^| )cl::[A-Za-z]+::([a-z][A-Za-z]*(<[^(]*)?\(|[A-Z][A-Za-z]*\((cl::Context|cl::Program|cl::Device) const&, )' |
    grep -v '::operator' || true)
  ;;
esac
if [ -n "$found" ]; then
  echo "These symbols of $2 should not be there:"
  echo "$found"
  exit 1
fi
