#!/usr/bin/env bash
# Holds the manual page against the command's own help, both ways, and has groff read it where that is installed:
# check_man.sh COMMAND PAGE
set -euo pipefail
command=$1 page=$2

options_in() { { grep -oE '(^|[^a-z-])--[a-z][a-z-]*' || true; } | grep -oE -- '--.*' | sort -u; }

# Nothing but what is a subcommand's or an option's own: descriptions mention others.
subcommands=$("$command" --help | sed -n '/^Subcommands:/,$ s/^  \([a-z]\+\) .*/\1/p')
options=$(for subcommand in "" $subcommands; do
  "$command" ${subcommand:+"$subcommand"} --help | grep -oE '^ +(-[a-z],)?--[a-z][a-z-]*(,--[a-z][a-z-]*)?'
done | options_in)
text=$(sed 's/\\-/-/g' "$page")

trouble=0
complain() { echo "$page: $*"; trouble=1; }
for subcommand in $subcommands; do
  # A heading of the section COMMANDS.
  sed -n '/^\.SH COMMANDS/,/^\.SH OPTIONS/p' "$page" | grep -qx "\.B $subcommand" || complain "the subcommand $subcommand is missing"
done
for option in $(comm -23 <(echo "$options") <(options_in <<<"$text")); do complain "the option $option is missing"; done
for option in $(comm -13 <(echo "$options") <(options_in <<<"$text")); do complain "no subcommand has the option $option"; done

if command -v groff >/dev/null; then
  warnings=$(groff -man -Tutf8 -ww "$page" 2>&1 >/dev/null)
  [ -z "$warnings" ] || complain "$warnings"
fi
exit $trouble
