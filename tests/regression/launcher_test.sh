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
ctest --help >"$work/ctest_help"

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
says_only() { [[ $(<"$work/err") == "surefoot: $1" ]]; }

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
  trap 'sleep 0.3; exit 1' INT TERM HUP # as ninja, which waits for its compilers
  sleep "${FAKE_SECONDS:-0}"
  if [[ -n ${FAKE_ERROR-} ]]; then echo "terrain.cpp:1: error: $FAKE_ERROR"; exit 1; fi
  mkdir -p "$dir/bin"
  printf '#!/bin/bash\nprintf "[%%s]" "$PWD" "$@"\nexit 3\n' >"$dir/bin/surefoot"
  chmod +x "$dir/bin/surefoot"
fi
END
fake ctest <<END
[[ \$* != --help ]] || exec cat "$work/ctest_help"
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
  libnlopt-cxx-dev libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libfmt-dev libgmp-dev catch2 libglpk-dev libbenchmark-dev; do
  echo "$package installed"
done >"$installed"
rm -rf "$tree/build"

FAKE_ERROR="no such thing" run plan x
expect "a failed build: status 4" test "$status" -eq 4
expect "a failed build shows the compiler's error" says "error: no such thing"
expect "a failed build shows it before it is called one" \
  eval '[[ $(<"$work/err") == *"no such thing"*"the build failed"* ]]'
expect "a failed build says where the log is" says "$tree/build/release/build.log"
expect "a failed build leaves no stamp" eval '! stamped'

run plan x
expect "builds after a failure" called "cmake --build"
expect "asks for no packages that are there" not_called apt-get
run plan x
expect "an unchanged tree is not built again" nothing_called
touch "$tree/terrain/terrain.cpp"
for arguments in --help "plan --help"; do
  # shellcheck disable=SC2086
  run $arguments
  expect "a changed source: $arguments goes to the built program" grep -qF -- "[--help]" "$work/out"
  expect "a changed source: $arguments builds nothing" nothing_called
done
run plna x
expect "a changed source: what is no command builds nothing" nothing_called
expect "a changed source: what is no command has status 2" test "$status" -eq 2
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

# Signals while it builds, to the launcher alone or, as Ctrl-C sends them, to the group that a terminal knows. (A
# background process of a script ignores INT unless told otherwise.)
running() { grep -lsz "^FAKE_SECONDS=$1\$" /proc/[0-9]*/environ; }
# Stopped is only who can be continued: a job of a shell, which a session of its own is not.
build_in_background() { # build_in_background SECONDS [job]: from nothing; its process in $builder
  rm -rf "$tree/build"
  : >"$calls"
  local own=(setsid)
  [[ ${2-} != job ]] || { own=() && set -m; }
  (cd "$work" && FAKE_SECONDS=$1 PATH="$fakes:$PATH" exec env --default-signal=INT "${own[@]}" "$tree/surefoot" plan x) \
    >"$work/out" 2>"$work/err" </dev/null &
  builder=$!
  set +m
  for ((i = 0; i < 200; ++i)); do called "cmake --build" && break || sleep 0.05; done
  sleep 0.1
  expect "something is running" test -n "$(running "$1")"
}
for case in "INT 130 -" "INT 130" "TERM 143" "HUP 129"; do
  read -r signal expected group <<<"$case"
  build_in_background 97.$$
  kill -s "$signal" -- "$group$builder"
  wait "$builder"
  status=$?
  expect "SIG$signal: nothing is left running" test -z "$(running 97.$$)"
  expect "SIG$signal: status $expected" test "$status" -eq "$expected"
  expect "SIG$signal: one line says so" eval \
    '[[ $(tail -n +2 "$work/err") == "surefoot: interrupted; the next call goes on building" ]]'
  expect "SIG$signal: the build leaves no stamp" eval '! stamped'
done
run plan x
expect "and the next call builds" called "cmake --build"

# Ctrl-Z (with ninja the compilers that run, which have groups of their own, end what they do).
stopped() {
  local processes
  mapfile -t processes < <(running "$1")
  # Counted rather than sought: whoever stops reading at the first would make cat fail.
  ((${#processes[@]} > 3)) && [[ $(cat "${processes[@]/%environ/stat}" | grep -cv ') T ') -eq 0 ]]
}
stop_in_background() { # stop_in_background SECONDS
  build_in_background "$1" job
  kill -s TSTP "$builder"
  for ((i = 0; i < 40; ++i)); do stopped "$1" && break || sleep 0.05; done
  expect "Ctrl-Z stops what builds" stopped "$1"
}
stop_in_background 1.$$
kill -s CONT "$builder"
wait "$builder"
status=$?
expect "and fg goes on with it" test "$status" -eq 3
stop_in_background 96.$$
kill -s TERM "$builder"
kill -s CONT "$builder"
wait "$builder" 2>/dev/null
status=$?
expect "ended while it is stopped: status 143" test "$status" -eq 143
expect "ended while it is stopped: nothing is left running" test -z "$(running 96.$$)"
build_in_background 95.$$
kill -s TSTP "$builder"
sleep 0.2
expect "where no shell could continue it, it is not stopped" eval '! stopped 95.$$'
kill -s TERM "$builder"
wait "$builder"

# Who kills the launcher alone does not let a second build into the first one's folder.
build_in_background 2.$$
kill -s KILL "$builder"
wait "$builder" 2>/dev/null
: >"$calls"
run plan x
expect "the next call waits for what the killed one began" says "waiting for another build"
expect "and nothing of that is left" test -z "$(running 2.$$)"

# What cannot be written, because another user built first or owns the tree. Who is root becomes another user.
if ((EUID != 0)) || command -v setpriv >/dev/null; then
  ((EUID != 0)) || as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
  chmod 755 "$work"
  chmod 666 "$calls"
  for foreign in build build/.lock build/release build/release/CMakeCache.txt; do
    chmod -R a+w "$tree"
    rm -rf "$tree/build"
    mkdir -p "$tree/build/release"
    touch "$tree"/build/{.lock,release/CMakeCache.txt}
    chmod -R a+w "$tree"
    chmod a-w "$tree/$foreign"
    run plan x
    expect "$foreign of another user: status 4" test "$status" -eq 4
    expect "$foreign of another user: one line" \
      says_only "error: cannot write to $tree/$foreign (does it belong to another user?)"
  done
  rm -rf "$tree/build"
  chmod a-w "$tree"
  for words in "plan x" test "bench verdict"; do
    # shellcheck disable=SC2086
    run $words
    expect "tree of another user, $words: status 4" test "$status" -eq 4
    expect "tree of another user, $words: one line" \
      says_only "error: cannot write to $tree/build (does it belong to another user?)"
  done
  chmod -R u+w "$tree"
  as_user=()
fi

# Misspelt items are refused before anything is built; which there are is taken from their registry.
mkdir -p "$tree/bench/error_time"
bench=${launcher%/*}/bench/error_time
cp "$bench"/*.cpp "$tree/bench/error_time/"
for words in nosuch "verdict nosuch" "verdict --quick line nosuch" "--quick nosuch"; do
  # shellcheck disable=SC2086
  run bench $words
  expect "bench $words: status 2" test "$status" -eq 2
  expect "bench $words: nothing is built" nothing_called
  expect "bench $words: one line" \
    says_only "error: unknown item 'nosuch'; there are $(sed -n 's/.*there are //p' "$work/err")"
done
items=$(sed -n 's/.*there are //p' "$work/err")
expect "there are items" test "$(wc -w <<<"$items")" -ge 5
for item in ${items//,/}; do
  expect "$item is the name of ${item}_item" grep -q "Item${item}_item{\"$item\"" <(tr -d ' \n' <"$bench/$item.cpp")
done
run bench --list
expect "benchmarks are listed before they are built" nothing_called
for item in ${items//,/}; do
  expect "$item is listed in words" grep -Eq "^$item +[A-Z][a-z' ]+.{10}" "$work/out"
done
expect "nothing else is listed" test "$(wc -l <"$work/out")" -eq "$(wc -w <<<"$items")"
run bench "${items%%,*}" --out nosuch
expect "what follows an option is no item" called "cmake --preset bench"
run plan x
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
for words in --nosuch "-R x --sanitize" "-j --nosuch" "-j --progress --nosuch=3" "--repeat until-fail:2 -Z" --tests-regex=x; do
  # shellcheck disable=SC2086
  run test $words
  expect "test $words: status 2" test "$status" -eq 2
  expect "test $words: neither builds nor tests" eval 'not_called "cmake --" && not_called "ctest --test-dir"'
  expect "test $words: one line" says_only \
    "error: unknown option '${words##* }'; there are --sanitize, which comes first, and those of ctest --help"
done
run test stability
expect "a word that ctest would pass over is refused" says_only \
  "error: unknown word 'stability'; -R 'stability' runs the tests whose names hold it"
words="-R -x -LE --no -j4 -DX=1 --no-tests=ignore --show-only=json-v1 -N --repeat until-pass:2 -VV --timeout 5 -I 1,2"
# shellcheck disable=SC2086
run test $words
expect "options of ctest and their values are passed on" called " $words"
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
