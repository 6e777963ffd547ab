# SPDX-License-Identifier: BSD-3-Clause
# Completion of seaglint in bash, from the program's own help: commands, options, then values or file names.
_seaglint() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} help
  local commands=() i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == [a-z]* && ${#commands[@]} -lt 2 ]] || break
    [[ $i -eq 1 || ${commands[0]} == mesh ]] && commands+=("${COMP_WORDS[i]}")
  done
  help=$("$program" "${commands[@]}" --help 2>/dev/null) || return
  if [[ $before == --* ]]; then  # the values that an option lists: TEXT:{on,off}
    local values
    values=$(sed -n "s/^ *\(-., *\)\{0,1\}$before [^ ]*:{\([^}]*\)}.*/\2/p" <<<"$help" | head -1)
    if [[ -n $values ]]; then
      mapfile -t COMPREPLY < <(compgen -W "${values//,/ }" -- "$word")
      return
    fi
  fi
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE '^ *(-[a-z], *)?--[a-z][a-z-]*' <<<"$help" | grep -oE -- '--[a-z-]+')" -- "$word")
  elif grep -q '^Subcommands:' <<<"$help"; then
    mapfile -t COMPREPLY < <(compgen -W "$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z]*\) .*/\1/p' <<<"$help")" -- "$word")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -F _seaglint seaglint
