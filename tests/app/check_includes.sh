#!/usr/bin/env bash
# Holds the folders of tools/ to the order of their includes: check_includes.sh TOOLS_FOLDER
# Each folder includes itself, the library's public headers (vorocl/) and what is named behind it.
set -euo pipefail
cd "$1"

trouble=0
# may_include FOLDER FOLDER...
may_include() {
  local folder=$1 allowed found
  allowed=$(printf '%s/|' "$@")
  found=$(grep -rnE '^#include "' "$folder" --include='*.?pp' | grep -vE "#include \"(vorocl/|${allowed%|})" || true)
  [ -z "$found" ] && return
  echo "$folder/ may not include:"
  echo "$found"
  trouble=1
}
may_include formats
may_include checks formats
may_include app/terminal formats
may_include app/bench formats app/terminal
may_include app/sources formats app/terminal
may_include app/outputs formats app/terminal app/sources
may_include app/options formats app/terminal app/sources app/outputs
may_include app/commands formats checks app/terminal app/bench app/sources app/outputs app/options

# What takes long to compile, or to load, is included in one place.
only_in() {
  local header=$1 places=$2 found
  found=$(grep -rlE "^#include [<\"]$header" . --include='*.?pp' | grep -vE "^\./($places)$" || true)
  [ -z "$found" ] && return
  echo "$header may be included in $places alone, not in:"
  echo "$found"
  trouble=1
}
only_in CLI/ app/options/command_line.cpp
only_in opencv2/imgcodecs formats/images/image_module.cpp
only_in 'lib(av|sw)' formats/images/film_module.cpp
exit $trouble
