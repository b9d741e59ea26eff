# Follows links/plugin_template/README.md: copies the folder, builds it, uses it; then one of another ABI. Usage: sh plugin_test.sh CHECKOUT PROGRAM SANITIZERS COMPILER
set -u
checkout=$1 program=$2 sanitizers=$3 compiler=$4
place=$(mktemp -d "${TMPDIR:-/tmp}/bl plugin.XXXXXX") || exit 1    # a space in the path, on purpose
trap 'rm -rf "$place"' EXIT
failures=0
unset BEHAVIOURLINKS_PLUGINS

# expect WHAT CODE TEXT...: $output and $code of the last run.
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
run() {
  output=$("$program" "$@" 2>&1)
  code=$?
}
build() {
  output=$(cmake -S "$place/my_links" -B "$place/$1" "-DBEHAVIOURLINKS=$checkout" "-DBL_SANITIZE=$sanitizers" "-DCMAKE_CXX_COMPILER=$compiler" "-DBL_PLUGIN_ABI_INSTEAD=${2:-}" 2>&1 &&
    cmake --build "$place/$1" 2>&1)
  code=$?
}

cat >"$place/scene.json" <<'SCENE'
{"format": "behaviourlinks", "version": 1,
 "nodes": [{"id": "base"}, {"id": "kite", "position": [3, 4, 0]}],
 "links": [{"id": "l", "kind": "hold_height", "from": "base", "to": "kite", "parameters": {"height": 12}}]}
SCENE

cp -r "$checkout/links/plugin_template" "$place/my_links"
build good
expect 'the copied template builds' 0
run run "$place/scene.json" --ticks 3
expect 'without the plugin its links rest' 0 'unknown link kind `hold_height`'
run --plugins "$place/good" docs hold_height
expect 'its page follows from the declaration' 0 'Holds a node at a wanted height above another one'
run --plugins "$place/good" run "$place/scene.json" --json "$place/out.json" --save "$place/saved.json"
expect 'it moves the node and settles' 0 'settled after'
output=$(cat "$place/saved.json") code=0
expect 'to the height' 0 '"kite": {"node.position": [3, 4, 11.9'
output=$(BEHAVIOURLINKS_PLUGINS=":$place/good" "$program" docs --list 2>&1)
code=$?
expect 'the variable is looked into' 0 'hold_height'
run --plugins "$place/good" --plugins "$place/good" docs --list
expect 'the same twice' 0 'brings `hold_height`, which exists already'

build other 'declarations 0123456789ab, GNU 4.8, x86_64 Linux, C++20'
expect 'one of another ABI builds' 0
run --plugins "$place/other" docs --list
expect 'and is refused' 0 'built for another program (declarations 0123456789ab, GNU 4.8, x86_64 Linux, C++20), this one is' 'build it again'
case $output in *hold_height*) echo 'the refused plugin was loaded'; failures=$((failures + 1)) ;; esac
run --plugins "$place/nowhere" docs --list
expect 'a folder that is not there' 0 'there is no folder of plugins here'

# What people get wrong: each is told, none ends the program.
run --plugins "$place" docs hold_height
expect 'the folder above' 2 'there is no plugin (.so) in this folder' 'has one'
run --plugins "$place/my_links" docs hold_height
expect 'the folder of the sources' 2 'these are sources: build them by' 'plugin'
template=$checkout/links/plugin_template/hold_height.cpp kind=$place/my_links/hold_height.cpp
run_broken() {    # NAME: builds what stands in $kind and runs the scene with it
  build "$1"
  expect "$1 builds" 0
  run --plugins "$place/$1" run "$place/scene.json" --ticks 5
}
{ echo '#include <stdexcept>'; sed 's/const double missing = .*/throw std::runtime_error("oops");/; s/return Out{{0.*/ (void)in, (void)ends; return Out{};/' "$template"; } >"$kind"
run_broken throwing
expect 'a plugin that throws is named, and the scene goes on' 0 'links/l: `hold_height` of my_links.so threw: oops'
sed 's/const double missing = .*/throw 5;/; s/return Out{{0.*/ (void)in, (void)ends; return Out{};/' "$template" >"$kind"
run_broken throwing_numbers
expect 'whatever it throws' 0 'links/l: `hold_height` of my_links.so threw something'
sed 's/End::to, "node.position"/End::to, "node.positio"/' "$template" >"$kind"
run_broken misspelt_port
expect 'a misspelt port is named when the plugin is loaded' 0 '`node` has no port `positio`, did you mean `position`?' 'my_links.so'
sed 's/l.id("hold_height")/l.id("held_height")/' "$template" >"$kind"
run_broken other_id
expect 'an id that is not the name of the file' 0 'hold_height.cpp brings no type `hold_height`'

sed 's/BL_LINK(hold_height,/BL_LINK(hold_hight,/' "$checkout/links/plugin_template/hold_height.cpp" >"$place/my_links/hold_height.cpp"
build misspelt
expect 'a word that is not the name of the file' 1 'BL_LINK(hold_height, Type) or BL_TYPIFICATION(hold_height, Type): the word'

# A header that is new to the checkout changes the ABI text at the next build, without being configured again by hand.
mkdir -p "$place/checkout/core" "$place/fresh"
cp -r "$checkout/core/base" "$checkout/core/define" "$place/checkout/core/"
cp -r "$checkout/links" "$place/checkout/"
cp -r "$checkout/links/plugin_template" "$place/fresh/my_links"
abi() { grep -ao 'BEHAVIOURLINKS-PLUGIN-ABI:declarations [0-9a-f]*' "$place/grown/my_links.so"; }
output=$(cmake -S "$place/fresh/my_links" -B "$place/grown" "-DBEHAVIOURLINKS=$place/checkout" "-DCMAKE_CXX_COMPILER=$compiler" 2>&1 &&
  cmake --build "$place/grown" 2>&1)
code=$?
expect 'another checkout builds it as well' 0
before=$(abi)
echo '// A new declaration.' >"$place/checkout/core/define/newcomer.h"
output=$(cmake --build "$place/grown" 2>&1)
code=$?
expect 'and once more after a header was added' 0
[ -n "$before" ] && [ "$before" != "$(abi)" ] || { echo 'the new header is not in the ABI text'; failures=$((failures + 1)); }

[ $failures -eq 0 ]
