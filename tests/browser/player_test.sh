#!/usr/bin/env bash
# The page of a plan in a real browser, without a screen: player_test.sh SUREFOOT MAPS PLANS
# Pages of stored plans are opened with player_checks.js at their end. Exit status: 0 all passed, 1 not, 77 no Chromium.
set -euo pipefail
surefoot=$1 maps=$2 plans=$3
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)

browser=
for name in ${CHROMIUM:-} chromium chromium-browser google-chrome; do
  if command -v "$name" >/dev/null; then
    browser=$name
    break
  fi
done
if [[ -z $browser ]]; then
  echo "skipped: no Chromium here (Debian package chromium)"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
failed=0

# browse ADDRESS [OPTION...]: the document as it is after a minute of the page's own time; what it says on its console
# goes to $work/console.
browse() {
  local address=$1
  shift
  timeout 240 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run \
    --user-data-dir="$work/profile" --enable-logging=stderr --virtual-time-budget=60000 --dump-dom "$@" \
    "file://$address" 2>"$work/log" || echo "the browser ended with status $?"
  # Left out: advice about how often the checks read pixels.
  grep -F CONSOLE "$work/log" | grep -vF willReadFrequently >"$work/console" || true
}

# expect NAME PATTERN: the document in $work/dom has it.
expect() {
  if grep -qE -- "$2" "$work/dom" && [[ ! -s $work/console ]]; then
    echo "ok      $1"
  else
    failed=1
    echo "FAILED  $1"
    grep -oE '^<html[^>]*|<p id="error".*|<h2 id="step">[^<]*' "$work/dom" || tail -n 5 "$work/log"
    cat "$work/console"
  fi
}

# Without a screen frames come when they like, while the page's own time is hurried through: here they follow that time.
clock='<script>window.requestAnimationFrame = act => setTimeout(() => act(performance.now()), 16);</script>'

for scene in stairs_up gap chimney long_rubble; do
  page=$work/$scene.html
  "$surefoot" check "$maps/$scene.yaml" "$plans/$scene.json" --html "$page" >/dev/null 2>&1
  browse "$page#step=3" >"$work/dom"
  expect "$scene: opens at the step of its address" '<h2 id="step">Step 3 of '
  sed -i "s|^<head>|&$clock|" "$page"
  checked=$work/$scene.checked.html
  { cat "$page" && echo '<script>' && cat "$here/player_checks.js" && echo '</script>'; } >"$checked"
  browse "$checked" --window-size=1280,800 >"$work/dom"
  expect "$scene: motion, keys, hints, playing, table" '^<html[^>]* data-checks="passed [0-9]+"'
done
browse "$work/stairs_up.checked.html#dark&calm" --window-size=400,800 --force-prefers-reduced-motion \
  --blink-settings=preferredColorScheme=0 >"$work/dom"
expect "narrow, dark, reduced motion" '^<html[^>]* data-checks="passed [0-9]+"'
browse "$work/stairs_up.html#step=1&play&speed=16" >"$work/dom"
expect "an address can ask to play" '<h2 id="step">End after '
exit "$failed"
