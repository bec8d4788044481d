#!/usr/bin/env bash
# Runs a program, which must end well and print this text and nothing else: prints.sh TEXT PROGRAM
set -euo pipefail
text=$("$2" 2>&1) || { echo "$2 failed: $text"; exit 1; }
[ "$text" = "$1" ] || { printf '%s printed\n%s\nand not\n%s\n' "$2" "$text" "$1"; exit 1; }
