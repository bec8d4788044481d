#!/usr/bin/env bash
# The completion of the command: test_completion.sh VOROCL
set -euo pipefail
command=$1
# shellcheck disable=SC1091
source "$(dirname "$0")/../../tools/vorocl.bash"

# Completes the last of the words, and compares: expect "WANTED ..." WORD...
expect() {
  COMP_WORDS=("$command" "${@:2}")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _vorocl
  [ "${COMPREPLY[*]}" = "$1" ] && return
  echo "\"${*:2}\" is completed by \"${COMPREPLY[*]}\", and \"$1\" was wanted"
  exit 1
}

expect "render" ren
expect "render relax" re
expect "cells compare" c
expect "devices" d
expect "--check" devices --c
expect "--resume" tiles --res
expect "jfa jfa+1 jfa+2" render --method j
expect "euclidean manhattan great-circle" render --metric ""
expect "viridis viridis_r" render --metric manhattan --palette v
expect "distance" render --color d
expect "column:" render --color c
expect "viridis turbo greys viridis_r turbo_r greys_r okabe-ito" simulate --palette ""
expect "--color --color-bar" simulate --scale 0,1 --color
expect "--method --metric" render --me
expect "--labels" cells --lab
expect "exact" cells --method e
expect "--relaxed-points" relax --rel
expect "--no-snap" cells --no
expect "" render --points cities
