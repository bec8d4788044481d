#!/usr/bin/env bash
# Runs a program under valgrind; errors and lost memory fail, but for the reports of the drivers that valgrind.supp lists.
# Exits with 77 where valgrind is not installed.
set -euo pipefail
command -v valgrind >/dev/null || { echo "valgrind is not installed: skipped"; exit 77; }
exec valgrind --quiet --error-exitcode=1 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
  --suppressions="$(dirname "$0")/valgrind.supp" "$@"
