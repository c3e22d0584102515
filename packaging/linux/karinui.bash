# Completion of karinui for bash. The program is asked for its commands and options, so that none is listed here.
_karinui() {
  local word=${COMP_WORDS[COMP_CWORD]} help commands words i
  local -a path=()
  _karinui_help() { help=$(LC_ALL=C karinui "${path[@]}" --help 2>/dev/null); }
  # The first words of the lines of a section: "Commands:" has commands, others options. Examples are no section.
  _karinui_listed() { awk -v among="$1" '/^[A-Z].*:$/ { here = $0 == "Commands:" } /^$/ { here = 0; next } /^  [a-z]/ && here && among == "commands" { print $1 }
    /^  -/ && among == "options" { n = split($1, names, ","); for (k = 1; k <= n; ++k) if (names[k] ~ /^--/) print names[k] }' <<<"$help"; }
  _karinui_help
  commands=$(_karinui_listed commands)
  for ((i = 1; i < COMP_CWORD && ${#commands} > 0; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] && continue
    grep -qxF -- "${COMP_WORDS[i]}" <<<"$commands" || return  # no such command: nothing fits behind it
    path+=("${COMP_WORDS[i]}")
    _karinui_help
    commands=$(_karinui_listed commands)
  done
  if [[ $word == -* ]]; then
    words=$(_karinui_listed options)
  elif [[ -n $commands ]]; then
    words=$commands
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -F _karinui karinui
