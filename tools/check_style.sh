#!/usr/bin/env bash
# Checks that clang-format and clang-tidy have nothing to say. Give it a build folder (default: build) whose
# compile_commands.json clang-tidy reads, and files to look at fewer than all.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
shift || true

mapfile -t files < <(git ls-files '*.cpp' '*.hpp' '*.c' '*.h')
clang-format --dry-run -Werror "${files[@]}"
[ -f "$build/compile_commands.json" ] || cmake -S . -B "$build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
mapfile -t sources < <(if [ $# -gt 0 ]; then printf '%s\n' "$@"; else git ls-files 'src/*.cpp' 'tools/*.cpp' 'tests/*test_*.cpp'; fi)
clang-tidy --quiet -p "$build" "${sources[@]}"
