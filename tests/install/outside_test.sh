#!/usr/bin/env bash
# What a user of an installed surefoot meets: installs a built tree under a prefix of its own, builds docs/examples
# against it as an outside project, and runs them; every installed header compiles alone.
# Usage: outside_test.sh SOURCE_DIR BUILD_DIR CXX
set -euo pipefail

source=$1 build=$2 cxx=$3
work=$(mktemp -d)
# The user's own list of what is installed, by which docs/library.md uninstalls, is not written: a component, be it that
# of all that names none, has a list of its own.
component=Unspecified
list=$build/install_manifest_$component.txt # also made by who installs that component by hand: then it stays
[[ -e $list ]] && list=
trap 'rm -rf -- "$work" ${list:+"$list"}' EXIT
manifest() { stat -c '%y %i' "$build/install_manifest.txt" 2>/dev/null || echo none; }
manifest_before=$(manifest)
prefix=$work/prefix
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log" && echo "FAILED: $*" && exit 1; }; }

quietly cmake --install "$build" --prefix "$prefix" --component "$component"
[[ $(manifest) == "$manifest_before" ]] || fail "install_manifest.txt is not as it was"
grep -rIl -e "$source" -e "$build" "$prefix" && fail "these installed files name the source or build tree"

for file in bin/surefoot share/man/man1/surefoot.1 share/bash-completion/completions/surefoot share/surefoot/maps/flat.yaml; do
  [[ -s $prefix/$file ]] || fail "$file is not installed"
done

# The tree that was installed from must not be needed, nor what the libraries were built with but do not show.
quietly cmake -S "$source/docs/examples" -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror"
quietly cmake --build "$work/build" -j 2

# Each prints what the comment at its head says.
cd "$prefix/share/surefoot"
declare -A arguments=([2_draw_a_region]="$work/region.svg" [3_plan_and_verify]="maps/flat.yaml $work/plan.json")
for example in "$source"/docs/examples/*.cpp; do
  name=$(basename "$example" .cpp)
  sed -n '\,^// Prints:$,,\,^[^/], s,^//   ,,p' "$example" >"$work/expected"
  [[ -s $work/expected ]] || fail "$name does not say what it prints"
  # shellcheck disable=SC2086
  "$work/build/$name" ${arguments[$name]-} >"$work/printed" || fail "$name ends with status $?"
  diff -u --label "comment of $name" --label "printed by $name" "$work/expected" "$work/printed" || fail "$name"
done
grep -q '</svg>' "$work/region.svg" || fail "2_draw_a_region draws nothing"
"$prefix/bin/surefoot" check maps/flat.yaml "$work/plan.json" || fail "3_plan_and_verify writes a plan that does not hold"
nowhere=$work/nowhere/file
for words in "2_draw_a_region $nowhere" "3_plan_and_verify maps/flat.yaml $nowhere"; do
  # shellcheck disable=SC2086
  ! "$work/build/"$words >/dev/null 2>"$work/err" || fail "$words: status 0"
  [[ $(<"$work/err") == "cannot write $nowhere" ]] || fail "$words: says '$(<"$work/err")'"
done

# The example of the help works anywhere.
example=$("$prefix/bin/surefoot" simulate --help | sed -n 's/^Example: surefoot //p')
[[ $example == simulate\ * ]] || fail "simulate --help gives no example"
# shellcheck disable=SC2086
(cd "$work" && "$prefix/bin/surefoot" $example >printed 2>&1) || { cat "$work/printed" && fail "$example"; }

# The project that docs/library.md shows, with the README's program.
mkdir -p "$work/robot"
awk '/^```cmake$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$source/docs/library.md" >"$work/robot/CMakeLists.txt"
awk '/^```cpp$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$source/README.md" >"$work/robot/robot.cpp"
quietly cmake -G Ninja -S "$work/robot" -B "$work/robot/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror"
quietly cmake --build "$work/robot/build"
"$work/robot/build/robot" >"$work/printed"
sed -n 's,^  //   ,,p' "$work/robot/robot.cpp" >"$work/expected"
[[ -s $work/expected ]] || fail "the README does not say what its snippet prints"
diff -u --label "comments of the README" --label "printed by its snippet" "$work/expected" "$work/printed" || fail "README snippet"

# COMPONENTS: a user of the oracle alone needs none of the planner's libraries; an unknown one is refused.
configure() { # configure COMPONENT TARGET
  mkdir -p "$work/$1"
  printf '%s\n' 'cmake_minimum_required(VERSION 3.23)' 'project(user LANGUAGES CXX)' \
    "find_package(surefoot 0.1 REQUIRED COMPONENTS $1)" 'add_executable(user user.cpp)' \
    "target_link_libraries(user PRIVATE surefoot::$1)" >"$work/$1/CMakeLists.txt"
  cp "$source/docs/examples/1_ask_the_oracle.cpp" "$work/$1/user.cpp"
  cmake -G Ninja -S "$work/$1" -B "$work/$1/build" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$prefix" "${@:2}" >"$work/log" 2>&1
}
configure stability -DCMAKE_DISABLE_FIND_PACKAGE_ompl=ON -DCMAKE_DISABLE_FIND_PACKAGE_NLopt=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_yaml-cpp=ON -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON || { cat "$work/log" && fail "stability alone"; }
! configure planner -DCMAKE_DISABLE_FIND_PACKAGE_ompl=ON || fail "the planner does without OMPL"
! configure stabilty || fail "an unknown component is found"
grep -qF "no component stabilty; there are terrain, stability, gaits, planner" <(tr -s ' \n' ' ' <"$work/log") ||
  { cat "$work/log" && fail "an unknown component is not named"; }

# Every installed header compiles alone, and finds all it includes among those installed. A header that its source file
# includes first was compiled alone when that was built.
cd "$prefix/include/surefoot"
mapfile -t headers < <(find . -name '*.hpp' -printf '%P\n' | sort)
compile() { # compile HEADER...: includes them in one translation unit
  printf '#include <surefoot/%s>\n' "$@" | "$cxx" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I"$prefix/include" \
    -I"$prefix/include/surefoot" -isystem /usr/include/eigen3 -x c++ - || fail "these headers do not compile alone: $*"
}
compile "${headers[@]}"
for header in "${headers[@]}"; do
  [[ $(grep -sm 1 '^#include' "$source/${header%.hpp}.cpp") == "#include \"$header\"" ]] || compile "$header"
done

((failures == 0)) && echo "all well"
exit $((failures != 0))
