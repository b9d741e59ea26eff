# The real window under random mouse and keys; it must live, and leave a scene that can be read.
# Usage: sh window_monkey.sh BUILD CHECKOUT [SECONDS] [SEED] [SCENE]
set -u
build=$1 checkout=$2 seconds=${3:-600} seed=${4:-1}
window_program=$build/ui/desktop/behaviourlinks-desktop
. "$checkout/tests/ui/desktop/display.sh"

scene=$place/played.json
cp "$checkout/${5:-scenes/studies/sixty_volumes.json}" "$scene"
# What the hands type as a file's name lands here.
cd "$place" || exit 1

# One burst of input, the same for the same seed: clicks, drags, wheel, words, and keys with and without modifiers.
burst() {
  awk -v seed="$1" -v width="$width" -v height="$height" '
    function pick(list, n, parts) { n = split(list, parts, " "); return parts[1 + int(rand() * n)] }
    function somewhere() { printf "mousemove %d %d\n", rand() * width, rand() * height; rest() }
    function rest() { printf "sleep %.3f\n", 0.01 + rand() * 0.05 }
    function modifier() { return pick("none none none ctrl shift alt ctrl+shift") }
    BEGIN {
      srand(seed)
      for (turn = 0; turn < 60; ++turn) {
        deed = rand(); held = modifier()
        split(held, keys, "+")
        if (held != "none") for (k in keys) printf "keydown %s\n", keys[k]
        if (deed < 0.35) {
          somewhere(); button = pick("1 1 1 1 2 3")
          printf "mousedown %d\n", button; rest()
          if (rand() < 0.5) for (step = 0; step < 5; ++step) somewhere()
          printf "mouseup %d\n", button
          if (rand() < 0.2) printf "mousedown 1\nmouseup 1\n"
        } else if (deed < 0.45) {
          somewhere(); wheel = pick("4 5")
          for (step = 0; step < 4; ++step) { printf "mousedown %d\nmouseup %d\n", wheel, wheel; rest() }
        } else if (deed < 0.55 && held == "none") {
          printf "type --delay 20 %s\n", pick("7300m3 library attract 12.5 0.4ha wall 1e9 link boundary")
          if (rand() < 0.5) printf "key Return\n"
        } else {
          name = pick("Tab space Escape Escape Delete Return Up Down Left Right Home F1 F2 F3 F6 a b c d e f g h i j k l m n o p r s t u v w x y z 0 1 2 3 4 5 period comma slash plus minus")
          if (!(held == "alt" && name == "F4")) printf "keydown %s\n", name
          rest()
          printf "keyup %s\n", name
        }
        if (held != "none") for (k in keys) printf "keyup %s\n", keys[k]
        rest()
      }
      print "mouseup 1 mouseup 2 mouseup 3"
    }'
}

start_display
start_window "$scene"
began=$(date +%s) bursts=0 windows=1
while [ $(($(date +%s) - began)) -lt "$seconds" ] && [ "$failures" = 0 ]; do
  burst $((seed * 1000 + bursts)) | xdotool - || fail "the hands were not understood in burst $bursts"
  bursts=$((bursts + 1))
  kill -0 "$window_pid" 2>/dev/null && continue
  echo "the window ended in burst $bursts (seed $seed)"
  end_window 0
  [ "$failures" != 0 ] && break
  start_window "$scene"
  windows=$((windows + 1))
done
if [ -n "$window_pid" ]; then
  [ -z "${BL_MONKEY_PICTURE:-}" ] || import -window root "$BL_MONKEY_PICTURE"
  # Asked from outside it keeps what was done and ends.
  kill -TERM "$window_pid"
  wait "$window_pid"
  code=$?
  window_pid=
  [ "$code" = 0 ] || [ "$code" = 143 ] || { cat "$place/window.log" >&2; fail "the window ended with $code"; }
fi
"$build/ui/cli/behaviourlinks" check "$scene" >"$place/check.log" 2>&1
[ $? -le 1 ] || { cat "$place/check.log" >&2; fail 'the scene cannot be read'; }
echo "seed $seed: $bursts bursts of 60 in $(($(date +%s) - began)) s, $windows windows, $failures failures"
[ "$failures" = 0 ]
