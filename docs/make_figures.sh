#!/usr/bin/env bash
# Draws the figures of docs/regions.md and docs/frictional.md and writes the tables of their numbers; the map of pushed
# rods alone is drawn by a benchmark (bench/README.md). Run from anywhere:
#   docs/make_figures.sh [PROGRAM]        default: build/release/bin/surefoot, else ./surefoot
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
program=${1:-$root/build/release/bin/surefoot}
[[ -x $program ]] || program=$root/surefoot
figures=$root/docs/figures
table=$figures/areas.md

{
  echo "| posture | R_SS(W) [m²] | R(W) [m²] | share | error [m²] | modes that occur |"
  echo "|---|---|---|---|---|---|"
} > "$table"

# NAME, then the arguments of `surefoot region`.
draw() {
  local name=$1
  shift
  "$program" region "$@" --svg "$figures/$name.svg" --json - |
    awk -v name="$name" '
      function value(line) { sub(/^"[a-z_]*": /, "", line); sub(/,$/, "", line); return line }
      /^"equilibrium_area"/ { a = value($0) }
      /^"robust_area"/ { b = value($0) }
      /^"area_error"/ { e = value($0) }
      /"mode":/ { m = $0; sub(/.*"mode":"/, "", m); sub(/".*/, "", m); modes = modes (modes == "" ? "" : " ") m }
      END { printf "| %s | %.7g | %.7g | %s | %.1g | %s |\n", name, a, b, (a > 0 ? sprintf("%.5f", b / a) : "-"), e, (modes == "" ? "none" : modes) }
    ' >> "$table"
}

for posture in "$figures"/postures/*.json; do draw "$(basename "$posture" .json)" --posture "$posture"; done
for scene in flat vee ridge; do draw "scene_$scene" "$root/maps/$scene.yaml"; done
draw scene_stairs_up "$root/maps/stairs_up.yaml"
cat "$table"

# [OR-H, Fig. 3]: areas in the window, with the greatest of their error estimates.
frictional=$figures/frictional/areas.md
{
  echo "| posture | R_EQ [m²] | kinematic-strong [m²] | clattering converges [m²] | both [m²] | error [m²] |"
  echo "|---|---|---|---|---|---|"
} > "$frictional"
for posture in "$figures"/frictional/*.json; do
  name=$(basename "$posture" .json)
  "$program" region --posture "$posture" --window=-2,-2,2,2 --svg "$figures/frictional_$name.svg" |
    awk -v name="$name" '
      /R_EQ     balanced/ { whole = $3 }
      /kinematic-strong/ { strong = $2 }
      /clattering converges/ { clatters = $4 }
      /both: frictionally/ { both = $4 }
      /an estimate/ { error = $4 }
      END { printf "| %s | %s | %s | %s | %s | %s |\n", name, whole, strong, clatters, both, error }
    ' >> "$frictional"
done
cat "$frictional"

"$program" simulate "$root/docs/examples/pushed_vee.json" --heights 2e-3,5e-3,0.003 --heights-rate 0.02,-0.01,0.05 \
  --svg "$figures/pushed_vee.svg" >/dev/null
