#!/usr/bin/env bash
# Plans the canned scenes anew, shows how the plans differ from the stored ones, and then, if told to, stores them; with
# stairs_up also what the README shows of it.
# Usage: tests/regression/update_golden.sh [-n | --store] [NAME...]      NAME is a scene of maps/, default all
#   -n only shows, --store stores without asking; with neither it asks, where there is somebody to ask.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
golden=$root/tests/regression/golden
store=ask
case ${1-} in
  -n) store=no && shift ;;
  --store) store=yes && shift ;;
  -*) echo "usage: $0 [-n | --store] [NAME...]" >&2 && exit 2 ;;
esac
names=("$@")
if ((!$#)); then
  for map in "$root"/maps/*.yaml; do
    head -n 1 -- "$map" | grep -q '^# Impossible' || names+=("$(basename -- "$map" .yaml)")
  done
fi

fresh=$(mktemp -d)
trap 'rm -rf -- "$fresh"' EXIT
mkdir -p "$golden"

# "9 steps, least safety factor 1.11" of a plan file.
summary() {
  sed -nE 's/^ *"safety_factor": ([^,]*),.*/\1/p; s/^ *"steps": ([^,]*),.*/\1/p' "$1" |
    { read -r factor && read -r steps && echo "$steps steps, least safety factor $factor"; } || echo "no plan"
}

changed=()
for name in "${names[@]}"; do
  "$root/surefoot" plan "$root/maps/$name.yaml" --format json --no-refine --time-limit 300 --effort 0.2 >"$fresh/plan"
  sed -E 's/^( *"time_s": )[^,]*/\10.0/' "$fresh/plan" >"$fresh/$name.json"
  old=$golden/$name.json
  [[ -f $old ]] || old=/dev/null
  if diff -u --label "stored $name" --label "fresh $name" "$old" "$fresh/$name.json"; then
    echo "$name: unchanged"
  else
    echo "$name: $(summary "$old") -> $(summary "$fresh/$name.json")"
    changed+=("$name")
  fi
done


# What the README shows of stairs_up, apart from the time it took, and its picture.
readme=
if [[ " ${names[*]} " == *" stairs_up "* ]]; then
  cd -- "$root"
  ./surefoot plan maps/stairs_up.yaml -q --svg "$fresh/stairs_up.svg" >"$fresh/text"
  awk -v text="$fresh/text" '
    /^<!-- end -->/ { inside = 0 }
    !inside
    /^<!-- begin: output of / {
      inside = 1
      print "```"
      while ((getline line < text) > 0) print line
      print "```"
    }' README.md >"$fresh/README.md"
  timeless() { sed -E 's/^(planner .*, seed [0-9]+), .* s$/\1/' "$1"; }
  if ! diff -u --label "README.md" --label "fresh README.md" <(timeless README.md) <(timeless "$fresh/README.md") ||
    ! cmp -s "$fresh/stairs_up.svg" docs/stairs_up.svg; then
    readme=yes
    changed+=("README.md and docs/stairs_up.svg")
  fi
fi

if ((!${#changed[@]})); then exit 0; fi
printf 'changed: %s\n' "${changed[@]}"
if [[ $store == ask && -t 0 ]]; then
  read -rp "Store these? [y/N] " answer
  [[ $answer != [yY]* ]] || store=yes
elif [[ $store == ask ]]; then
  echo "nothing is stored; --store does"
fi
[[ $store == yes ]] || exit 0
for name in "${changed[@]}"; do
  [[ ! -f $fresh/$name.json ]] || cp -- "$fresh/$name.json" "$golden/$name.json"
done
if [[ $readme ]]; then
  cat -- "$fresh/README.md" >README.md
  cat -- "$fresh/stairs_up.svg" >docs/stairs_up.svg
fi
echo "stored"
