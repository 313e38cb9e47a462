# Completion for bash: commands, options and their words as `surefoot --help` tells them, canned scenes, files.
# Installed to share/bash-completion/completions/surefoot; or: source docs/surefoot.bash

_surefoot() {
  local program=$1 word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]-}
  local IFS=$'\n' help
  COMPREPLY=()
  # A key pressed by chance builds nothing: of the launcher the program is asked that it has built.
  program=$(readlink -f -- "$(type -P -- "$program")")
  [[ ! -e ${program%/*}/CMakePresets.json ]] || program=${program%/*}/build/release/bin/surefoot
  ((COMP_CWORD > 1)) || command=--help
  help=$("$program" "$command" --help 2>/dev/null)
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(awk '/^  -/ { n = split($1, names, ","); for (i = 1; i <= n; ++i) print names[i] }' \
      <<<"$help")" -- "$word")
    return
  fi
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$(awk '/^Subcommands:/ { inside = 1; next } /^$/ { inside = 0 }
      inside && /^  [^ ]/ { print $1 }' <<<"$help")" -- "$word")
    return
  fi
  # An option that takes a value says in its help which: a FILE, a NAME out of a list, or something else.
  local entry=
  if [[ $before == -* ]]; then
    entry=$(awk -v option="$before" '/^  -/ { n = split($1, names, ",")
      for (i = 1; i <= n; ++i) if (names[i] == option) { print; exit } }' <<<"$help")
    case $entry in
      *" SCENE "*) ;;
      *" FILE "*)
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        return
        ;;
      *" NAME "*)
        mapfile -t COMPREPLY < <(compgen -W "$(sed -E 's/^.* NAME +//; s/ *\(.*//; s/(,| or) +/\n/g' <<<"$entry")" -- "$word")
        return
        ;;
    esac
    # Upper case behind the option: some other value, of which nothing is known here.
    [[ $entry =~ ^\ \ -[^\ ]*\ [A-Z] && ! $entry =~ Excludes:|\ SCENE\  ]] && return
  fi
  [[ $help == *$'\nPositionals:'* && $command != bench ]] || return
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$word")
  if [[ $help == *$'\n  SCENE '* || $entry == *" SCENE "* ]]; then
    mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -W "$("$program" maps 2>/dev/null | awk '{ print $1 }')" -- "$word")
  fi
}
complete -F _surefoot surefoot ./surefoot
