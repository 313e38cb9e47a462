#!/usr/bin/env bash
# Completion offers, and the manual page tells of, every command and option that --help names, and no other.
# Usage: completion_test.sh PROGRAM COMPLETION MANUAL
set -uo pipefail

program=$(readlink -f -- "$1") manual=$(readlink -f -- "$3")
# shellcheck disable=SC1090
source "$2"
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd "$work" || exit 1
touch stairs.txt "a plan.json"
failures=0

is() { # is CLAIM FOUND EXPECTED: equal as sets of lines
  if diff <(sort -u <<<"$2") <(sort -u <<<"$3") >"$work/.difference"; then echo "ok: $1"; else
    echo "FAILED: $1 (< found, > expected)"
    cat "$work/.difference"
    failures=$((failures + 1))
  fi
}
offered() { # offered WORD...: what completion offers for the last word, one a line
  COMP_WORDS=("$program" "$@") COMP_CWORD=$#
  _surefoot "$program"
  ((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}"
}
options_of() { sed -nE 's/^  (-[^ ]+).*/\1/p' | tr , '\n'; } # of a help text

commands=$("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z]*\) .*/\1/p')
((${#commands} > 20)) || { echo "FAILED: no commands in --help" && exit 1; }
is "commands" "$(offered "")" "$commands"
is "options before a command" "$(offered -)" "$("$program" --help | options_of)"
is "a command begun" "$(offered pl)" plan

# The manual as plain text: hyphens and fonts are marked in it.
plain=$(sed -E 's/\\-/-/g; s/\\f[A-Z]//g' "$manual")
told=$(grep -oE -- '--[a-z][a-z-]*' <<<"$plain" | sort -u)
named=$("$program" --help | options_of)
is "the manual's commands" "$(sed -n 's/^\.SS //p' <<<"$plain")" "$commands"
for command in $commands; do
  options=$("$program" "$command" --help | options_of)
  is "options of $command" "$(offered "$command" -)" "$options"
  is "options of $command in the manual" \
    "$(sed -n "/^\.SS $command\$/,/^\.S[SH]/p" <<<"$plain" | grep --no-group-separator -A1 '^\.TP' | sed -nE 's/^(-[^ ]+).*/\1/p' | tr , '\n')" "$options"
  named+=$'\n'$options
done
is "options anywhere in the manual" "$told" "$(grep -- -- <<<"$named")"

is "formats" "$(offered plan --format "")" $'text\njson\nyaml'
for format in $(offered plan --format ""); do
  "$program" plan flat --effort 0 -q --format "$format" >"$work/.plan" || is "format $format" refused accepted
done
is "planners" "$(offered plan --planner L)" Layers
is "objectives" "$(offered plan --objective "")" $'steps\nsafety\ndistance'
is "canned scenes and files" "$(offered plan stairs)" $'stairs_up\nstairs_down\nstairs.txt'
is "canned scenes and files behind --scene" "$(offered simulate --scene stairs)" $'stairs_up\nstairs_down\nstairs.txt'
is "the plan of check" "$(offered check flat "a p")" "a plan.json"
is "files behind --svg" "$(offered plan --svg st)" stairs.txt
is "no files behind bench" "$(offered bench "")" ""
is "nothing behind maps" "$(offered maps "")" ""
is "nothing behind --seed" "$(offered plan --seed "")" ""
is "a file behind a flag" "$(offered plan -q stairs.)" stairs.txt

# The launcher builds what is missing or older than its sources; completion must not make it do so.
mkdir -p tree/build/release/bin
printf '#!/bin/sh\ntouch "%s"\n' "$work/.called" >tree/surefoot
chmod +x tree/surefoot
touch tree/CMakePresets.json CMakePresets.json
is "no command before anything is built" "$(program=$work/tree/surefoot offered "")" ""
ln -s "$program" tree/build/release/bin/surefoot
is "commands behind the launcher" "$(program=$work/tree/surefoot offered "")" "$commands"
is "scenes behind the launcher" "$(program=tree/surefoot offered plan stairs_u)" stairs_up
ln -s tree/surefoot linked
mkdir bin && ln -s ../tree/surefoot bin/surefoot
is "scenes behind a link to the launcher" "$(program=./linked offered plan stairs_u)" stairs_up
is "scenes behind a link in PATH" "$(PATH=$work/bin:$PATH program=surefoot offered plan stairs_u)" stairs_up
is "scenes behind the launcher in PATH" "$(PATH=$work/tree:$PATH program=surefoot offered plan stairs_u)" stairs_up
is "the launcher is not called" "$([[ -e $work/.called ]] && echo called)" ""
is "commands of a program in PATH, in a folder of another project" \
  "$(PATH=$(dirname "$program"):$PATH program=surefoot offered "")" "$commands"

if command -v groff >/dev/null; then
  is "the manual is well-formed" "$(groff -man -ww -Tutf8 "$manual" 2>&1 >/dev/null)" ""
else
  echo "skipped: groff is not there to format the manual"
fi
exit $((failures != 0))
