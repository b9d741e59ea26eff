# Tries `bl` with stand-ins for apt, sudo and the rest, in a copy of its own. Usage: sh launcher_test.sh CHECKOUT
set -u
unset BL_NO_SETUP BL_JOBS    # those of whoever runs the tests must not reach the launchers under test
checkout=$1
place=$(mktemp -d "${TMPDIR:-/tmp}/bl launcher.XXXXXX") || exit 1    # a space in the path, on purpose
trap 'rm -rf "$place"' EXIT
trap 'exit 1' INT TERM
mkdir "$place/tree" "$place/bin"
cp "$checkout/bl" "$place/tree/bl"
failures=0

# tool NAME: the real program, where the stand-ins alone are on the path. stand_in NAME: a script from stdin.
tool() { ln -sf "$(command -v "$1")" "$place/bin/$1"; }
stand_in() {
  rm -f "$place/bin/$1"
  { echo '#!/bin/sh'; cat; } >"$place/bin/$1"
  chmod +x "$place/bin/$1"
}
for name in sh env dirname readlink sed grep awk cut tr tail head date df mkdir rm cat nproc sleep; do tool "$name"; done

# bl ARGUMENTS: runs the copy with the stand-ins alone; leaves $output and $code.
bl() {
  output=$(cd "$place" && PATH="$place/bin" BL_NO_SETUP='' "$place/tree/bl" "$@" 2>&1 </dev/null)
  code=$?
}

# expect WHAT CODE TEXT...: the last run ended with CODE and printed each TEXT.
expect() {
  what=$1 wanted=$2
  shift 2
  verdict=ok
  [ "$code" -eq "$wanted" ] || verdict="exit $code, not $wanted"
  for text in "$@"; do
    case $output in *"$text"*) ;; *) verdict="no \"$text\"" ;; esac
  done
  echo "$what: $verdict"
  [ "$verdict" = ok ] && return
  failures=$((failures + 1))
  printf '%s\n' "$output" | sed 's/^/    | /'
}

expect_not() {
  case $output in *"$1"*) echo "$what: printed \"$1\""; failures=$((failures + 1)) ;; esac
}

# --- Plugins that are none ------------------------------------------------------------------------------------------

bl plugin
expect 'plugin without a folder' 1 'say the folder of the plugin'
bl plugin --help
expect 'plugin --help' 0 'usage: ./bl plugin FOLDER'
bl plugin "$place/bin"
expect 'plugin in a wrong folder' 1 'it has no CMakeLists.txt'
bl plugin "$place/nowhere"
expect 'plugin in no folder' 1 'there is no folder'
bl --plugins run scene.json
expect 'the folder of plugins forgotten' 1 'there is no folder run; write ./bl --plugins FOLDER TASK'
bl "--plugins=$place/bin" help
expect 'the folder behind an equals sign' 0 'usage: ./bl TASK'

# --- Without any package work ---------------------------------------------------------------------------------------

bl help
expect 'help' 0 'usage: ./bl TASK' 'test' 'fuzz' 'setup'
bl
expect 'no argument' 0 'usage: ./bl TASK'
bl nonsense
expect 'unknown task' 2 'there is no task' 'nonsense' 'usage: ./bl TASK'
output=$(PATH="$place/bin" "$place/tree/bl" nonsense 2>&1 <&-)
code=$?
expect 'closed stdin' 2 'there is no task'
ln -s "$place/tree/bl" "$place/link"
output=$("$place/link" help 2>&1)
code=$?
expect 'through a link' 0 'usage: ./bl TASK'

# --- Packages -------------------------------------------------------------------------------------------------------

# All asked-for packages are there, but for those named in the file `missing`.
stand_in dpkg-query <<'SCRIPT'
for package; do
  case $package in -*|'$'*) continue ;; esac
  grep -qx -- "$package" "$FAKES/missing" || echo "install ok installed $package"
done
SCRIPT
FAKES=$place
export FAKES
printf '%s\n' ccache libcsv-dev >"$place/missing"

bl setup
expect 'no apt-get' 1 'no Debian system with apt-get' 'ccache' 'libcsv-dev' 'BL_NO_SETUP=1'
expect_not 'libcgal-dev'

# This apt-get does what the file `apt` says, and notes how it was called.
stand_in apt-get <<'SCRIPT'
echo "apt-get $* [$DEBIAN_FRONTEND]" >>"$FAKES/calls"
. "$FAKES/apt"
SCRIPT
stand_in id <<'SCRIPT'
cat "$FAKES/uid"
SCRIPT
: >"$place/calls"
echo 1000 >"$place/uid"
bl setup
expect 'neither root nor sudo' 1 'needs root, and there is no sudo' 'apt-get install ccache libcsv-dev'

stand_in sudo <<'SCRIPT'
exit 1
SCRIPT
bl setup
expect 'sudo with a password and no terminal' 1 'sudo wants a password'
[ -s "$place/calls" ] && { echo 'apt-get was called without the right to'; failures=$((failures + 1)); }

stand_in true </dev/null
stand_in sudo <<'SCRIPT'
[ "$1" = -n ] && shift
exec "$@"
SCRIPT
cat >"$place/apt" <<'SCRIPT'
echo '0 upgraded, 5 newly installed, 0 to remove and 0 not upgraded.'
echo 'After this operation, 12.3 MB of additional disk space will be used.'
SCRIPT
bl setup
expect 'sudo without a password' 0 'to install: ccache libcsv-dev' 'installed 2 packages' '5 with what they need' '12.3 MB'
grep -q 'install.*--no-install-recommends ccache libcsv-dev.*noninteractive' "$place/calls" ||
  { echo "apt-get was called otherwise: $(cat "$place/calls")"; failures=$((failures + 1)); }

echo 0 >"$place/uid"
# apt_fails WHAT MESSAGE SENTENCE: installing prints MESSAGE and fails; bl says SENTENCE.
apt_fails() {
  printf 'echo "%s"\nexit 100\n' "$2" >"$place/apt"
  bl setup
  expect "$1" 1 "$2" "$3" 'setup.log'
}
apt_fails 'no network' "E: Failed to fetch http://deb.example/x.deb  Temporary failure resolving 'deb.example'" 'check the network'
apt_fails 'apt locked' 'E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 7 (apt)' 'apt is locked'
apt_fails 'disk full' 'E: You do not have enough free space in /var/cache/apt/archives/.' 'the disk is full'
apt_fails 'other system' 'E: Unable to locate package libcsv-dev' 'does not offer all of these packages'
apt_fails 'other failure' 'E: Sub-process /usr/bin/dpkg returned an error code (1)' 'installing failed'

# Package lists that are absent or too old: fetched once, then the installation is tried again.
cat >"$place/apt" <<'SCRIPT'
case $* in
  *update*) : >"$FAKES/updated" ;;
  *) [ -e "$FAKES/updated" ] || { echo 'E: Unable to locate package ccache'; exit 100; } ;;
esac
SCRIPT
bl setup
expect 'package lists absent' 0 'installed 2 packages'

: >"$place/missing"
: >"$place/calls"
bl setup
expect 'nothing missing' 0
[ -z "$output$(cat "$place/calls")" ] || { echo "nothing missing, yet: $output"; failures=$((failures + 1)); }

# --- Build ----------------------------------------------------------------------------------------------------------

# This cmake makes a build folder, this ninja a program that prints its arguments and folder and ends with 7.
stand_in cmake <<'SCRIPT'
mkdir -p "$2/build/release/ui/cli"
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$2" >"$2/build/release/CMakeCache.txt"
: >"$2/build/release/build.ninja"
[ ! -e "$FAKES/cmake-fails" ] || { echo 'CMake Error at CMakeLists.txt:3: no such luck'; exit 1; }
SCRIPT
stand_in ninja <<'SCRIPT'
[ ! -e "$FAKES/ninja-fails" ] || { echo 'FAILED: a.o'; echo 'a.cpp:1:1: error: expected a miracle'; exit 1; }
printf '#!/bin/sh\nprintf "<%%s>" "$@"; echo; pwd; exit 7\n' >"$2/ui/cli/behaviourlinks"
chmod +x "$2/ui/cli/behaviourlinks"
SCRIPT
stand_in g++ <<'SCRIPT'
cat "$FAKES/gcc"
SCRIPT
tool chmod
echo 11 >"$place/gcc"
bl run
expect 'compiler too old' 1 'g++ 12 or newer is needed; found 11'
echo 12 >"$place/gcc"
stand_in df <<'SCRIPT'
printf 'Filesystem 1024-blocks Used Available Capacity Mounted\n/dev/x 9 9 1048576 1%% /\n'
SCRIPT
bl run
expect 'little disk' 1 'less than 3 GB are free'
tool df
: >"$place/cmake-fails"
bl run
expect 'configuring fails' 1 'no such luck' 'configuring failed' 'release-configure.log'
rm "$place/cmake-fails" "$place/tree/build/release/build.ninja"
: >"$place/ninja-fails"
bl run
expect 'building fails' 1 'expected a miracle' 'building failed' 'release-build.log'
rm "$place/ninja-fails"
bl run 'a scene.json' --ticks 5
expect 'arguments, folder and exit code are those of the program' 7 '<run><a scene.json><--ticks><5>' "$place"
mv "$place/tree" "$place/elsewhere"
output=$(PATH="$place/bin" "$place/elsewhere/bl" check 2>&1 </dev/null)
code=$?
expect 'a moved checkout is configured again' 7 'configuring release' '<check>'

# --- The suite ------------------------------------------------------------------------------------------------------

mv "$place/elsewhere" "$place/tree"
mkdir -p "$place/tree/tests/house" "$place/tree/scenes"
cp "$checkout/tests/house/suite.sh" "$place/tree/tests/house/suite.sh"
for name in basename find; do tool "$name"; done
stand_in cmake <<'SCRIPT'
mkdir -p "$2/build/$4"
printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\nBL_TESTS:BOOL=ON\n' "$2" >"$2/build/$4/CMakeCache.txt"
: >"$2/build/$4/build.ninja"
SCRIPT
# One fuzzer; the file `breaks` names the steps that fail: build-PRESET, test-PRESET, empty-PRESET, find.
stand_in ninja <<'SCRIPT'
[ "$3" != -t ] || { echo 'tests/fuzz/scene_fuzzer: CXX_EXECUTABLE_LINKER__scene'; exit; }
! grep -qx "build-${2##*/}" "$FAKES/breaks" || exit 1
mkdir -p "$2/tests/fuzz"
printf '#!/bin/sh\n! grep -qx find "%s/breaks"\n' "$FAKES" >"$2/tests/fuzz/scene_fuzzer"
chmod +x "$2/tests/fuzz/scene_fuzzer"
SCRIPT
# Seven tests, one of them skipped.
stand_in ctest <<'SCRIPT'
echo "ctest $*" >>"$FAKES/calls"
preset=${2##*/} bad=0
! grep -qx "empty-$preset" "$FAKES/breaks" || exit 8
! grep -qx "test-$preset" "$FAKES/breaks" || bad=2
printf '<testsuite name="x"\n\ttests="7"\n\tfailures="%s"\n\tdisabled="0"\n\tskipped="1"\n<testcase tests="9"/>\n' $bad >"$2/junit.xml"
# Two of the seven are shards of a program with eighty tests: one shard fails by two tests, or ends without its sum.
if [ "$preset" = fuzz ] && [ -e "$FAKES/shards" ]; then
  mkdir -p "$2/Testing/Temporary"
  printf '<testcase name="base_tests/shard_%s"/>\n' 0 1 >>"$2/junit.xml"
  printf 'Command: "/x/base_tests"\n[  PASSED  ] %s\n' '40 tests.' '38 tests.' >"$2/Testing/Temporary/LastTest.log"
  printf '[  FAILED  ] %s\n' '2 tests, listed below:' 'Suite.One' 'Suite.Two' >>"$2/Testing/Temporary/LastTest.log"
  [ ! -e "$FAKES/crash" ] ||
    printf 'Command: "/x/base_tests"\n%s\n' '[  PASSED  ] 40 tests.' '[ RUN      ] Suite.One' >"$2/Testing/Temporary/LastTest.log"
fi
[ $bad -eq 0 ] || exit 8
SCRIPT

# suite_gives LINE CODE BROKEN-STEPS...: runs all with these steps broken; LINE must be the last line.
suite_gives() {
  line=$1 ending=$2
  shift 2
  printf '%s\n' "$@" >"$place/breaks"
  bl test $deep
  expect "the suite with broken steps: $*" "$ending" "$line"
  [ "$(printf '%s\n' "$output" | tail -n 1)" = "$line" ] || { echo "the last line is not: $line"; failures=$((failures + 1)); }
}
deep=--deep
suite_gives '18 passed, 0 failed' 0
suite_gives '16 passed, 2 failed' 1 test-release
suite_gives '16 passed, 2 failed' 1 test-fuzz
suite_gives '12 passed, 2 failed' 1 build-fuzz    # its tests and its fuzzers
suite_gives '12 passed, 1 failed' 1 build-tsan
suite_gives '12 passed, 1 failed' 1 build-release
suite_gives '12 passed, 1 failed' 1 empty-tsan
suite_gives '18 passed, 1 failed' 1 find
suite_gives '4 passed, 5 failed' 1 test-fuzz empty-release build-tsan find
: >"$place/breaks"
touch "$place/shards"
suite_gives '93 passed, 3 failed' 1 test-fuzz    # ctest tells two failures: the shard, and a test that is none
touch "$place/crash"
suite_gives '55 passed, 2 failed' 1 test-fuzz
rm "$place/shards" "$place/crash"
deep=''
suite_gives '6 passed, 0 failed' 0
: >"$place/calls"
bl test -R 'two words'
expect 'a selection of tests' 0 '6 passed, 0 failed'
grep -q 'release.*-R two words' "$place/calls" || { echo 'ctest did not get the arguments'; failures=$((failures + 1)); }
bl fuzz soon
expect 'fuzzing for no number of seconds' 1 'whole number of seconds'

echo "$failures failures"
[ "$failures" -eq 0 ]
