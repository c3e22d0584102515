# Completion of karinui for bash. The program is asked for its commands and options, so that none is listed here.
_karinui() {
  local word=${COMP_WORDS[COMP_CWORD]} command= sub= i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] && continue
    if [[ -z $command ]]; then command=${COMP_WORDS[i]}; elif [[ -z $sub && ${COMP_WORDS[i]} =~ ^[a-z]+$ ]]; then sub=${COMP_WORDS[i]}; fi
  done
  local words
  words=$(karinui $command --help 2>/dev/null | awk '/^  [a-z]/ { print $1 } { while (match($0, /--[a-z][a-z-]*/)) { print substr($0, RSTART, RLENGTH); $0 = substr($0, RSTART + RLENGTH) } }')
  [[ -n $sub ]] && words+=" $(karinui $command $sub --help 2>/dev/null | grep -o -- '--[a-z][a-z-]*')"
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word"; [[ -n $command ]] && compgen -f -- "$word")
}
complete -o filenames -F _karinui karinui
