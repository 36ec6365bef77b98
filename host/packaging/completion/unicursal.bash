# shellcheck shell=bash
# Completes unicursal's command line in bash. The program itself knows what can stand where
# (host/cli/completing.hpp); bash finds the files.

# Files with these endings, or all files, and folders. $1: the beginning of a path.
_unicursal_files() {
  local beginning=$1 ending
  shift
  compopt -o filenames 2> /dev/null
  # bash-completion's own function also knows names with blanks, and the home folder.
  if declare -F _filedir > /dev/null; then
    # _filedir reads this variable.
    # shellcheck disable=SC2034
    local cur=$beginning
    if [[ $# -eq 0 ]]; then
      _filedir
    else
      local IFS='|'
      _filedir "@(${*#.})"
    fi
    return
  fi
  if [[ $# -eq 0 ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$beginning")
    return
  fi
  for ending in "$@"; do
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -X "!*$ending" -- "$beginning")
  done
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$beginning")
}

_unicursal() {
  COMPREPLY=()
  # bash takes --option=value for three words and a:b as well.
  local -a words=()
  local i word joined=''
  for ((i = 1; i <= COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if [[ ($word == [=:]* || $joined) && ${#words[@]} -gt 0 ]]; then
      words[${#words[@]} - 1]+=$word
    else
      words+=("$word")
    fi
    joined=''
    if [[ $word == [=:] ]]; then joined=yes; fi
  done
  local last=${words[${#words[@]} - 1]} current=${COMP_WORDS[COMP_CWORD]}
  if [[ $current == [=:] ]]; then current=''; fi
  local before=${last%"$current"}

  local -a lines=() kind=()
  mapfile -t lines < <("${COMP_WORDS[0]/#\~/$HOME}" complete "${words[@]}" 2> /dev/null)
  read -r -a kind <<< "${lines[0]:-words}"
  for ((i = 1; i < ${#lines[@]}; i++)); do
    word=${lines[i]%%$'\t'*}
    COMPREPLY+=("${word#"$before"}")
  done
  case ${kind[0]} in
    folders)
      compopt -o filenames 2> /dev/null
      mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$current")
      ;;
    files) _unicursal_files "$current" "${kind[@]:1}" ;;
    *)
      # A fault ends in a colon, after which its value is typed.
      if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *: ]]; then compopt -o nospace 2> /dev/null; fi
      ;;
  esac
}

complete -F _unicursal unicursal
