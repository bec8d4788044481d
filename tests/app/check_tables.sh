#!/usr/bin/env bash
# Holds the tables of the documents against the files that they are made from: check_tables.sh SOURCE_FOLDER
set -euo pipefail
source=$1
folder=$(mktemp -d)
trap 'rm -r --one-file-system "$folder"' EXIT
cp "$source"/docs/{evaluation,moving_seeds}.md "$folder"
python3 "$source/tools/studies/evaluation_tables.py" "$folder/evaluation.md" "$source/docs/evaluation"
python3 "$source/docs/motions.py" "$source/docs/motions.csv" "$folder/moving_seeds.md"
for page in evaluation moving_seeds; do diff "$source/docs/$page.md" "$folder/$page.md"; done
