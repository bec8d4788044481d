#!/usr/bin/env bash
# Builds the documentation into a folder; a warning fails: check_docs.sh FOLDER
# Exits with 77 where Doxygen is not installed.
set -euo pipefail
command -v doxygen >/dev/null || { echo "Doxygen is not installed: skipped"; exit 77; }
folder=$(realpath -m "$1")
cd "$(dirname "$0")/../.."
mkdir -p "$folder"
{ cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = \"$folder\""; } | doxygen -
