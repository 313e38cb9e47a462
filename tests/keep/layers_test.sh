#!/usr/bin/env bash
# The rooms include each other in one direction only, and foreign libraries stay in the rooms that they belong to:
#   terrain and stability know nothing of each other, gaits uses both, planner uses gaits;
#   OMPL and NLopt are seen in planner/ alone, yaml-cpp in sources of terrain/; no header shows a user their types;
#   what is installed and tested does not reach into tests/ or bench/.
# Usage: layers_test.sh SOURCE_DIR
set -uo pipefail

# Includes of a tree that are against the rules, as "file: include".
faults() {
  (
    cd "$1" || exit 1
    grep -HE '^ *# *include' {terrain,stability,gaits,planner}/*.[ch]pp | awk -F ':' '
      BEGIN {
        may["terrain"] = "terrain"; may["stability"] = "stability"
        may["gaits"] = "gaits terrain stability"; may["planner"] = "planner gaits terrain stability"
      }
      function wrong() { print $1 ":" $2 }
      {
        room = $1; sub(/\/.*/, "", room); header = $1 ~ /hpp$/
        what = $2; sub(/^[^"<]*["<]/, "", what); sub(/[">].*/, "", what)
        quoted = $2 ~ /"/; other = what; sub(/\/.*/, "", other)
        if (quoted && (" " may[room] " ") !~ (" " other " ")) wrong()
        else if (!quoted && (other == "surefoot" || other in may)) wrong()
        else if (what ~ /^ompl\//     && room != "planner") wrong()
        else if (what ~ /^nlopt/      && (header || $1 !~ /^planner\/(refine.*|main)\.cpp$/)) wrong()
        else if (what ~ /^yaml-cpp\// && (header || room != "terrain")) wrong()
        else if (what ~ /^CLI/        && $1 !~ /^planner\/(main\.cpp|bench_options\.hpp|usage_faults\.hpp)$/) wrong()
      }'
  )
}

found=$(faults "$1")
[[ -z $found ]] || { echo "FAILED: includes that the layers forbid" && echo "$found" && exit 1; }

# What is looked for is found: each of these, planted in an otherwise lawful tree, is named.
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir "$work"/{terrain,stability,gaits,planner}
for room in terrain stability gaits planner; do
  printf '#include "%s/own.hpp"\n#include <vector>\n' "$room" | tee "$work/$room/own.cpp" >"$work/$room/own.hpp"
done
printf '#include "gaits/own.hpp"\n#include <ompl/base/Planner.h>\n' >>"$work/planner/own.hpp"
printf '#include "terrain/own.hpp"\n#include "stability/own.hpp"\n' >>"$work/gaits/own.hpp"
printf '#include <nlopt.hpp>\n' >"$work/planner/refine.cpp"
[[ -z $(faults "$work") ]] || { echo "FAILED: a lawful tree is refused" && exit 1; }
while read -r file include; do
  cp "$work/$file" "$work/.kept"
  echo "#include $include" >>"$work/$file"
  [[ $(faults "$work") == "$file:#include $include" ]] || { echo "FAILED: $include in $file is not noticed" && exit 1; }
  cp "$work/.kept" "$work/$file"
done <<'END'
terrain/own.hpp "stability/contact.hpp"
stability/own.cpp "terrain/terrain.hpp"
stability/own.hpp "gaits/robot.hpp"
gaits/own.cpp "planner/search.hpp"
gaits/own.hpp <ompl/base/State.h>
planner/own.hpp <nlopt.hpp>
planner/own.cpp <nlopt.hpp>
gaits/own.cpp <yaml-cpp/yaml.h>
terrain/own.hpp <yaml-cpp/yaml.h>
planner/own.cpp "tests/support/run_program.hpp"
planner/own.cpp <terrain/terrain.hpp>
planner/own.cpp "own.hpp"
END
echo "all well"
