#!/usr/bin/env bash
# The launcher's own behaviour, with cmake, ctest, dpkg-query, apt-get and sudo replaced by recorders in a copy of
# the tree's outline: what it installs, when it builds, what it passes on. Usage: launcher_test.sh PATH/TO/surefoot
set -uo pipefail

launcher=$(readlink -f -- "$1")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
tree="$work/a tree" fakes=$work/fakes
calls=$work/calls installed=$work/installed
failures=0

expect() { # expect CLAIM COMMAND...
  local claim=$1
  shift
  if "$@"; then echo "ok: $claim"; else
    echo "FAILED: $claim ($*)"
    sed 's/^/  stdout: /' "$work/out"
    sed 's/^/  stderr: /' "$work/err"
    sed 's/^/  calls: /' "$calls"
    failures=$((failures + 1))
  fi
}
fake() { # fake NAME: a recorder whose further body is read from standard input
  { printf '#!/bin/bash\necho "%s $*" >>"%s"\n' "$1" "$calls" && cat; } >"$fakes/$1"
  chmod +x "$fakes/$1"
}
run() { # run ARGS...: the launcher from another folder; status in $status
  : >"$calls"
  (cd "$work" && PATH="$fakes:$PATH" "${as_user[@]}" "$tree/surefoot" "$@") >"$work/out" 2>"$work/err" </dev/null
  status=$?
}
called() { grep -qF -- "$1" "$calls"; }
not_called() { ! called "$1"; }
says() { grep -qF -- "$1" "$work/err"; }
prints() { [[ $(<"$work/out") == "$1" ]]; }
stamped() { [[ -f "$tree/build/release/.built" ]]; }
nothing_called() { [[ ! -s $calls ]]; }

as_user=()
mkdir -p "$fakes" "$tree"/{terrain,stability,gaits,planner,tests}
touch "$tree"/{CMakeLists.txt,CMakePresets.json,terrain/terrain.cpp} "$calls" "$work/out" "$work/err"
cp "$launcher" "$tree/surefoot"
fake cmake <<'END'
dir=build/${2##*/}
if [[ $1 == --preset ]]; then
  mkdir -p "$dir"
  printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\n' "$PWD" >"$dir/CMakeCache.txt"
  [[ $* != *TESTS=ON* ]] || echo SUREFOOT_TESTS:BOOL=ON >>"$dir/CMakeCache.txt"
else
  sleep "${FAKE_SECONDS:-0}"
  if [[ -n ${FAKE_ERROR-} ]]; then echo "terrain.cpp:1: error: $FAKE_ERROR"; exit 1; fi
  mkdir -p "$dir/bin"
  printf '#!/bin/bash\nprintf "[%%s]" "$PWD" "$@"\nexit 3\n' >"$dir/bin/surefoot"
  chmod +x "$dir/bin/surefoot"
fi
END
fake ctest <<'END'
echo "100% tests passed"
END
fake dpkg-query <<END
cat "$installed"
exit 1
END
fake apt-get <<END
[[ \$1\$2 == *fail* || -n \${FAKE_APT_ERROR-} && \$* == *install* ]] && exit 100
for word; do [[ \$word == -* || \$word == install ]] || echo "\$word installed" >>"$installed"; done
END
fake sudo <<'END'
[[ -n ${FAKE_SUDO-} ]] || exit 1
[[ $1 == -n ]] && exit 0
exec "$@"
END

# Help before there is anything.
: >"$installed"
for arguments in --help "test --help" "plan -h"; do
  # shellcheck disable=SC2086
  run $arguments
  expect "$arguments installs and builds nothing" nothing_called
  expect "$arguments: status 0" test "$status" -eq 0
  expect "$arguments tells how to go on" grep -q "surefoot test --sanitize" "$work/out"
done

(cd "$work" && PATH="$fakes:$PATH" exec sh "$tree/surefoot" --help) >"$work/out" 2>"$work/err" </dev/null
expect "sh runs it too" grep -q "surefoot test --sanitize" "$work/out"

# Words that are no command are refused before anything is built; those of the program are taken from its source.
cp "${launcher%/*}/planner/main.cpp" "$tree/planner/"
for words in "plna x" "" "-version" "--svg a.svg"; do
  # shellcheck disable=SC2086
  run $words
  expect "'$words' is no command: status 2" test "$status" -eq 2
  expect "'$words' builds nothing" nothing_called
  expect "'$words': the commands are named" says "plan, check, validate, query, region, simulate, bench, maps, test"
done
expect "a missing command is called so" says "error: a command is missing: "
run 'pl
an'
expect "an unknown word is told on one line" test "$(wc -l <"$work/err")" -eq 1

# A first call on a bare machine.
echo "cmake installed" >"$installed"
if ((EUID == 0)); then
  run plan "maps/a b.yaml" --seed 7
  expect "names what is missing" says "missing Debian packages: g++ ninja-build"
  expect "root refreshes the package lists" called "Acquire::Retries=3 update"
  expect "root installs what is missing, and only that" called "install -y --no-install-recommends g++ ninja-build"
  expect "plan does not ask for what only the tests need" not_called catch2
  expect "plan does not build the tests" called "SUREFOOT_TESTS=OFF"
  expect "status of the program is passed on" test "$status" -eq 3
  expect "runs in the caller's folder with the arguments unchanged, and nothing else on stdout" \
    prints "[$work][plan][maps/a b.yaml][--seed][7]"

  # Another user: through sudo if that needs no password, otherwise the command to type.
  if command -v setpriv >/dev/null; then
    as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
    chown -R 65534 "$work"
    chmod 755 "$work"
    rm -rf "$tree/build"
    echo "cmake installed" >"$installed"
    run plan x
    expect "without root: status 4" test "$status" -eq 4
    expect "without root: the exact command" \
      says "apt-get update && apt-get install -y --no-install-recommends g++ ninja-build"
    expect "without root: nothing installed" not_called apt-get
    expect "without root: nothing built" not_called "cmake --"
    FAKE_SUDO=1 run plan x
    expect "sudo installs" called "sudo env DEBIAN_FRONTEND=noninteractive apt-get"
    expect "sudo: then it runs" prints "[$work][plan][x]"
    as_user=()
    chown -R 0 "$work"
  fi

  rm -rf "$tree/build"
  : >"$installed"
  FAKE_APT_ERROR=1 run plan x
  expect "a failed installation: status 4" test "$status" -eq 4
  expect "a failed installation: nothing built" not_called "cmake --"
fi

# With everything installed.
for package in g++ cmake ninja-build libeigen3-dev libompl-dev libboost-dev libnlopt-dev \
  libnlopt-cxx-dev libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libfmt-dev libgmp-dev catch2 libglpk-dev; do
  echo "$package installed"
done >"$installed"
rm -rf "$tree/build"

FAKE_ERROR="no such thing" run plan x
expect "a failed build: status 4" test "$status" -eq 4
expect "a failed build shows the compiler's error" says "error: no such thing"
expect "a failed build says where the log is" says "$tree/build/release/build.log"
expect "a failed build leaves no stamp" eval '! stamped'

run plan x
expect "builds after a failure" called "cmake --build"
expect "asks for no packages that are there" not_called apt-get
run plan x
expect "an unchanged tree is not built again" nothing_called
touch "$tree/terrain/terrain.cpp"
run plan x
expect "a changed source is built" called "cmake --build"
run plan x
expect "and only once" nothing_called
rm "$tree/terrain/terrain.cpp"
run plan x
expect "a removed source is noticed" called "cmake --build"
touch "$tree/tests/new_test.cpp"
run plan x
expect "tests do not concern the program" nothing_called
ln -sfn "$tree/surefoot" "$work/link"
(cd / && PATH="$fakes:$PATH" "$work/link" query -) >"$work/out" 2>"$work/err" </dev/null
expect "runs through a symbolic link" prints "[/][query][-]"

cp -a "$tree" "$work/moved"
: >"$calls"
PATH="$fakes:$PATH" "$work/moved/surefoot" plan >"$work/out" 2>"$work/err" </dev/null
expect "a copied tree is built anew" called "cmake --preset release"

# Two first calls at once.
rm -rf "$tree/build"
: >"$calls"
for caller in 1 2; do
  (cd "$work" && FAKE_SECONDS=1 PATH="$fakes:$PATH" "$tree/surefoot" plan $caller) >"$work/out$caller" 2>/dev/null &
done
wait
expect "two first calls build once" test "$(grep -c -- "cmake --build" "$calls")" -eq 1
expect "and both run" test "$(<"$work/out1")$(<"$work/out2")" = "[$work][plan][1][$work][plan][2]"

# Ctrl-C while it builds. (A background process of a script ignores it unless told otherwise.)
rm -rf "$tree/build"
(cd "$work" && FAKE_SECONDS=2 PATH="$fakes:$PATH" exec env --default-signal=INT setsid "$tree/surefoot" plan x) \
  >"$work/out" 2>"$work/err" </dev/null &
interrupted=$!
for ((i = 0; i < 100; ++i)); do says "building in" && break || sleep 0.05; done
sleep 0.3
kill -INT -- "-$interrupted"
wait "$interrupted"
status=$?
expect "an interrupted build: status 130" test "$status" -eq 130
expect "an interrupted build is not called a failure" eval '! says "build failed"'
expect "an interrupted build leaves no stamp" eval '! stamped'
run plan x
expect "and the next call builds" called "cmake --build"
run bench --help
expect "help on the benchmarks does not build them" not_called "cmake --preset bench"
expect "help on the benchmarks is the program's" prints "[$work][bench][--help]"

# Tests.
sed -i /catch2/d "$installed"
if ((EUID == 0)); then
  run test
  expect "test installs what the tests need" called "install -y --no-install-recommends catch2"
fi
echo "catch2 installed" >>"$installed"
run test -R "some name"
expect "test builds the tests" called "SUREFOOT_TESTS=ON"
expect "test passes arguments on" called "-R some name"
expect "stdout of test is ctest's" prints "100% tests passed"
run plan x
expect "test builds the program too" nothing_called
run test --sanitize
expect "sanitizers have a build of their own" called "cmake --preset debug"
touch "$tree/CMakeLists.txt"
: >"$calls"
(cd "$work" && FAKE_SECONDS=2 PATH="$fakes:$PATH" exec "$tree/surefoot" test) >/dev/null 2>&1 </dev/null &
for ((i = 0; i < 200; ++i)); do [[ $(grep -c -- "cmake --build" "$calls") -eq 2 ]] && break || sleep 0.05; done
(cd "$work" && PATH="$fakes:$PATH" exec "$tree/surefoot" plan x) >"$work/out" 2>"$work/err" </dev/null
expect "while the tests are built the program, which comes first, runs" prints "[$work][plan][x]"
expect "and waits for nothing" eval '! says "waiting for another build"'
wait
touch "$tree/CMakeLists.txt"
run plan x
expect "the tests stay configured" called "SUREFOOT_TESTS=ON"

((failures == 0)) || { echo "$failures failed" && exit 1; }
