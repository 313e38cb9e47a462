#!/usr/bin/env bash
# What the documents tell to type works, and prints what they say. In README.md and docs/*.md:
#   a fenced block with lines that begin with "$ "            the commands run, as one script, and print the other lines
#   other lines that begin with surefoot or ./surefoot         run, with status 0
#   other lines of blocks with commands                        are listed below as not run
#   the block after "<!-- begin: output of COMMAND"            is what COMMAND prints, apart from the time it took
#   ```yaml                                                    is a scene in order
#   ```python                                                  runs, where python3 is there
#   ```cpp of the README, ```cmake of library.md               are left to tests/install/outside_test.sh; others are refused
#   cmake commands that configure, those of the tests too      use Ninja: make is in no package list
#   figures                                                    are those that docs/make_figures.sh draws
#   the rows of papers.md                                      name functions and tests that are there
# Usage: docs_test.sh SOURCE_DIR PROGRAM
set -uo pipefail

source=$(readlink -f -- "$1") program=$(readlink -f -- "$2")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir "$work"/{tree,bin,blocks}
cp -r "$source"/{maps,docs} "$work/tree"
ln -s "$program" "$work/bin/surefoot"
ln -s "$program" "$work/tree/surefoot"
export PATH="$work/bin:$PATH"
cd "$work/tree" || exit 1
failures=0 ran=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# Building and installing (tests/regression/launcher_test.sh and tests/install/outside_test.sh do that).
not_run='^(git clone |\./surefoot test |cmake |build/release/bin/surefoot |build/fuzz/bin/)'

# Minutes of random pushes are cut to seconds.
shortened() { sed -E 's/--sample [0-9]+/--sample 20/' "$1"; }

# Each fenced block as a file DOCUMENT.LINE.LANGUAGE; an output block as DOCUMENT.LINE.output, its command first.
split() {
  awk -v out="$work/blocks/$(basename "$1" .md)" '
    /^<!-- begin: output of / { command = $0; sub(/.*output of /, "", command); sub(/ \(.*/, "", command) }
    /^```/ {
      if (inside) { inside = 0; close(file); next }
      inside = 1; language = substr($0, 4)
      if (language == "") language = command != "" ? "output" : "plain"
      file = sprintf("%s.%04d.%s", out, NR, language); printf "" > file
      if (command != "") print command > file
      command = ""; next
    }
    inside { print > file }' "$1"
}
for document in "$source"/README.md "$source"/docs/*.md; do split "$document"; done

# A block of commands: the script goes to .script, what it should print, if anything, to .expected.
commands_of() {
  awk -v not_run="$not_run" -v script="$work/script" -v expected="$work/expected" '
    function odd(s) { return gsub(/\047/, "", s) % 2 }  # a quotation is left open, or closed
    /^\$ / { prompt = 1 }
    { line[NR] = $0 }
    END {
      printf "" > script; printf "" > expected
      for (i = 1; i <= NR; ++i) {
        if (prompt && line[i] ~ /^\$ /) { print substr(line[i], 3) > script; open = odd(line[i]) }
        else if (prompt && open) { print line[i] > script; open = odd(line[i]) == 0 }
        else if (prompt) print line[i] > expected
        else if (line[i] ~ not_run || line[i] ~ /^$/) continue
        else if (line[i] ~ /^(\.\/)?surefoot /) print line[i] > script
        else { print "neither run nor listed as not run: " line[i]; status = 1 }
      }
      exit status
    }' "$1"
}
timeless() { sed -E 's/^(planner .*, seed [0-9]+), .* s$/\1/'; }

for block in "$work"/blocks/*; do
  place=$(basename "$block")
  case $place in
    *.output)
      bash -c "$(head -n 1 "$block")" 2>"$work/err" | timeless >"$work/printed"
      diff -u --label "$place" --label "printed" <(tail -n +2 "$block" | timeless) "$work/printed" || fail "$place"
      ran=$((ran + 1))
      ;;
    *.plain)
      grep -qE "^(\\$ |(\./)?surefoot )|$not_run" "$block" || continue
      commands_of "$block" || fail "$place"
      { echo "trap 'echo \"status \$? of: \$BASH_COMMAND\"' ERR" && shortened "$work/script"; } >"$work/run"
      bash -e "$work/run" >"$work/printed" 2>"$work/err" </dev/null ||
        { cat "$work/printed" "$work/err" && fail "$place"; }
      [[ ! -s $work/expected ]] || diff -u --label "$place" --label "printed" "$work/expected" "$work/printed" || fail "$place"
      ran=$((ran + $(grep -c surefoot "$work/script")))
      ;;
    *.yaml)
      surefoot validate "$block" >"$work/printed" 2>&1 || { cat "$work/printed" && fail "$place"; }
      ran=$((ran + 1))
      ;;
    *.python)
      if command -v python3 >/dev/null; then
        timeout 60 python3 "$block" || fail "$place"
        ran=$((ran + 1))
      else
        echo "skipped: python3 is not there to run $place"
      fi
      ;;
    README.*.cpp | library.*.cmake) ;; # built and run by tests/install/outside_test.sh
    *.cpp | *.cmake) fail "$place: nothing builds it" ;;
  esac
done
! (cd "$source" && grep -rnE 'cmake .*-[SB] ' --include=*.{md,sh,txt} README.md docs bench tests | grep -vE -- '-G Ninja|grep ') ||
  fail "these configure without -G Ninja"
# docs/papers.md: each row's function and test are where it says.
rows=0
while IFS='|' read -r _ statement function file test test_file _; do
  read -r file <<<"$file" && read -r test <<<"$test" && read -r test_file <<<"$test_file"
  function=${function//[\` ]/}
  grep -qE "^[^/]*\b$function\(" "$source/$file" || fail "papers.md:$statement: no $function in $file"
  grep -E -A1 'TEST_CASE\(' "$source/$test_file" | tr -d '\n' | grep -qF -- "$test" || fail "papers.md: no test \"$test\" in $test_file"
  rows=$((rows + 1))
done < <(grep '^| .*`' "$source/docs/papers.md")
((rows >= 20)) || fail "the rows of papers.md were not found"

# The figures and their tables are what the program draws and prints.
rm -f docs/figures/*.svg docs/figures/{,frictional/}areas.md
cp "$source/docs/figures/clattering_map.svg" docs/figures # a benchmark's
bash docs/make_figures.sh "$program" >"$work/figures.log" 2>&1 || fail "docs/make_figures.sh: $(tail -1 "$work/figures.log")"
surefoot plan stairs_up -q --svg docs/stairs_up.svg >/dev/null # the README's; tests/regression/update_golden.sh stores it
cmp docs/stairs_up.svg "$source/docs/stairs_up.svg" || fail "docs/stairs_up.svg is not what plan draws"
diff -rq docs/figures "$source/docs/figures" || fail "figures are not those of docs/make_figures.sh"

echo "$ran commands of the documents ran"
((ran >= 10)) || fail "the documents' commands were not found"
exit $((failures != 0))
