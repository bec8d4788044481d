# Completion of vorocl in bash. It reads the command's own --help, and so never falls behind it.

# The choices of an option that takes a NAME: what its help lists behind the last colon.
_vorocl_choices() {
  awk -v option="$1" '
    function take() {
      if (entry ~ "^ +([^ ]*,)?" option "[ :=]+NAME") { sub(/.*: /, "", entry); gsub(/,/, "", entry); sub(/:NAME/, ":", entry); print entry }
    }
    /^ +-/ { take(); entry = $0; next }
    /^($|[^ ])/ { take(); entry = ""; next } # the title of a section
    { entry = entry " " $0 }
    END { take() }'
}

_vorocl() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} subcommand= help
  [ "$COMP_CWORD" -gt 1 ] && subcommand=${COMP_WORDS[1]}
  help=$("${COMP_WORDS[0]}" ${subcommand:+"$subcommand"} --help 2>/dev/null)

  local candidates=
  if [[ $word == -* ]]; then
    candidates=$(grep -oE '^ +-[^ :={]+' <<<"$help" | tr ',' ' ')
  elif [ "$COMP_CWORD" -eq 1 ]; then
    candidates=$(sed -n '/^Subcommands:/,$ s/^  \([a-z]*\) .*/\1/p' <<<"$help")
  elif [[ $before == -* ]]; then
    candidates=$(_vorocl_choices "$before" <<<"$help")
  fi
  mapfile -t COMPREPLY < <(compgen -W "$candidates" -- "$word")
}

# What has no choices is a file.
complete -o default -F _vorocl vorocl
