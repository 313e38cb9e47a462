#!/usr/bin/env bash
# The commands under valgrind's memcheck: no use of memory that is not there or not set, none lost for good.
# Usage: memcheck_test.sh PROGRAM SOURCE_DIR
set -euo pipefail
program=$1 source=$2
command -v valgrind >/dev/null || { echo "SKIPPED: valgrind is not installed" && exit 77; }
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# checked STATUS ARGUMENT...: the program ends with STATUS, and memcheck has nothing to say.
checked() {
  local expected=$1 status=0
  shift
  valgrind --quiet --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite --log-file="$work/said" \
    "$program" "$@" >"$work/out" 2>"$work/err" || status=$?
  if [[ $status != "$expected" || -s $work/said ]]; then
    echo "FAILED: surefoot $*: status $status, expected $expected" && cat "$work/said" "$work/err" && exit 1
  fi
}

checked 0 plan "$source/maps/flat.yaml" --effort 0 -o "$work/plan.json" --svg "$work/plan.svg" --html "$work/plan.html"
checked 0 check "$source/maps/flat.yaml" "$work/plan.json"
checked 1 check "$source/maps/gap.yaml" "$work/plan.json"
checked 2 check "$source/maps/flat.yaml" "$source/maps/flat.yaml"
checked 0 validate "$source/maps/chimney.yaml"
printf '%s\n' '{"contacts": [{"p": [0, 0], "n": [0, 1], "mu": 0.5}, {"p": [1, 0], "n": [0, 1], "mu": 0.5}],
 "com": [0.5, 0.4], "rho": 0.2, "kappa": 0.1, "nu": 0.1}' | tr -d '\n' >"$work/posture.json"
checked 0 query "$work/posture.json"
checked 0 region --posture "$work/posture.json" --restitution 0.3 --svg "$work/region.svg" --json "$work/region.json"
checked 0 simulate "$source/docs/examples/pushed_vee.json" --q-rate 0,0,0.01 --svg "$work/motion.svg"
echo "memcheck: 8 commands, nothing to say"
