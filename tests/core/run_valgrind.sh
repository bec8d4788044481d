#!/usr/bin/env bash
# Runs a program under valgrind; errors and lost memory fail, but for the reports of the drivers that valgrind.supp lists.
# Exits with 77 where valgrind is not installed.
set -euo pipefail
command -v valgrind >/dev/null || { echo "valgrind is not installed: skipped"; exit 77; }
# The frame of a kernel of exact cells has the private memory of all items of a group. Frames of more than 2 MB are other
# stacks to valgrind, unless it is told so: all that is written there would be an error.
exec valgrind --quiet --error-exitcode=1 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
  --max-stackframe=8388608 --suppressions="$(dirname "$0")/valgrind.supp" "$@"
