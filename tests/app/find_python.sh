#!/usr/bin/env bash
# Prints the name of a Python that has these modules, the first one of PATH or Debian's: find_python.sh MODULE...
set -euo pipefail
modules=$(IFS=,; echo "$*")
for python in python3 /usr/bin/python3; do
  if "$python" -c "import $modules" 2>/dev/null; then
    echo "$python"
    exit
  fi
done
exit 1
