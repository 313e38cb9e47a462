#!/usr/bin/env bash
# Plans the canned scenes anew, shows how the plans differ from the stored ones, and stores them; with stairs_up also
# what the README shows of it.
# Usage: tests/regression/update_golden.sh [-n] [NAME...]     -n only shows; NAME is a scene of maps/, default all
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
golden=$root/tests/regression/golden
store=true
if [[ ${1-} == -n ]]; then
  store=false
  shift
fi
names=("$@")
if ((!$#)); then
  for map in "$root"/maps/*.yaml; do
    head -n 1 -- "$map" | grep -q '^# Impossible' || names+=("$(basename -- "$map" .yaml)")
  done
fi

fresh=$(mktemp -d)
trap 'rm -rf -- "$fresh"' EXIT
mkdir -p "$golden"
for name in "${names[@]}"; do
  "$root/surefoot" plan "$root/maps/$name.yaml" --format json --no-refine --time-limit 300 --effort 0.2 >"$fresh/plan"
  sed -E 's/^( *"time_s": )[^,]*/\10.0/' "$fresh/plan" >"$fresh/$name.json"
  old=$golden/$name.json
  [[ -f $old ]] || old=/dev/null
  if diff -u --label "stored $name" --label "fresh $name" "$old" "$fresh/$name.json"; then
    echo "$name: unchanged"
  elif $store; then
    cp -- "$fresh/$name.json" "$golden/$name.json"
    echo "$name: stored"
  fi
done

if $store && [[ " ${names[*]} " == *" stairs_up "* ]]; then
  cd -- "$root"
  ./surefoot plan maps/stairs_up.yaml --svg docs/stairs_up.svg >"$fresh/text"
  awk -v text="$fresh/text" '
    /^<!-- end -->/ { inside = 0 }
    !inside
    /^<!-- begin: output of / {
      inside = 1
      print "```"
      while ((getline line < text) > 0) print line
      print "```"
    }' README.md >"$fresh/README.md"
  cat -- "$fresh/README.md" >README.md
fi
