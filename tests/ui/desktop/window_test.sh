# The real window, worked by mouse and keys: what is saved is what was done. Usage: sh window_test.sh BUILD CHECKOUT
set -u
build=$1 checkout=$2
window_program=$build/ui/desktop/behaviourlinks-desktop
. "$checkout/tests/ui/desktop/display.sh"

scene=$place/quarter.json
cp "$checkout/scenes/start/quarter.json" "$scene"
# In a file, library and theatre have no link between them, and the library has no demand of its own.
places=$("$build/tests/ui/desktop/desktop_places" "$scene" "$width" "$height" node:library handle:theatre choose=library field:smart_volume.demand) ||
  { echo 'the places are not known' >&2; exit 1; }
library=$(echo "$places" | sed -n 1p) theatre=$(echo "$places" | sed -n 2p) demand=$(echo "$places" | sed -n 3p)
has() { grep -q -- "$1" "$scene"; }
has_not() { ! grep -q -- "$1" "$scene"; }
# shellcheck disable=SC2086
coordinates() { set -- $1; x=$1 y=$2; }
# In the middle of a small box, below its head and between its handles.
on_library() { coordinates "$library"; y=$((y + 18)); }

start_display
start_window "$scene" --paused
case $(title) in 'quarter.json - BehaviourLinks') ;; *) fail "the title is $(title)" ;; esac

# A link by hand, from body to body, its kind chosen by typing.
coordinates "$theatre"; from_x=$x from_y=$y
on_library
drag "$from_x" "$from_y" "$x" "$y"
pause 0.5
text attract
key Return
pause 0.5

# A demand typed with its unit.
click "$x" "$y"
pause 0.5
coordinates "$demand"
click "$x" "$y"
key a ctrl
text '7300 m3'
key Return
pause 0.5

# The node's box is moved; then the scene is saved.
on_library
drag "$x" "$y" "$((x + 30))" "$((y + 60))"
pause 0.5
case $(title) in '* quarter.json - BehaviourLinks') ;; *) fail "the title has no mark of unsaved changes: $(title)" ;; esac
key s ctrl
until_true 10 has '"demand": 7300' || fail 'the demand was not saved'
has '"kind": "attract", "from": "theatre", "to": "library"' || fail 'the link from theatre to library was not saved'
has '"library": \[' || fail 'the box of the library was not saved'
cp "$scene" "$place/after.json"

# Letters of another size: were they not drawn, the menu bar would be of one colour.
letters() { import -window root -crop "$((width / 2))x20+0+4" "$place/bar.png" && convert "$place/bar.png" -colorspace Gray -format '%[fx:maxima-minima > 0.3]' info:; }
for scale in 125 100; do
  key k ctrl
  pause 0.5
  text "Scale $scale"
  key Return
  pause 1
  [ "$(letters)" = 1 ] || fail "at $scale % nothing can be read"
done

# Three steps back are the scene as it was; three steps on are what was saved.
# Faster than any frame: taps are not lost.
xdotool key ctrl+z key ctrl+z key ctrl+z
pause 0.5
key s ctrl
until_true 10 has_not '"demand": 7300' || fail 'the demand was not undone'
cmp -s "$scene" "$checkout/scenes/start/quarter.json" || { diff "$scene" "$checkout/scenes/start/quarter.json" | head -n 20; fail 'undoing everything does not give the same bytes'; }
key y ctrl; key y ctrl; key y ctrl
pause 0.5
key s ctrl
until_true 10 has '"demand": 7300' || fail 'the demand was not brought back'
cmp -s "$scene" "$place/after.json" || fail 'redo does not give what was saved'
key q ctrl
end_window 0

# It opens again as it was left, and a journal remains only of a window that did not end well.
start_window "$scene" --paused
[ -n "$(ls "$place/state/behaviourlinks/journals")" ] || fail 'an open window has no journal'
point "$((width / 5))" "$((height / 2))"
key a ctrl
key Delete
pause 0.5
kill -9 "$window_pid"
wait "$window_pid" 2>/dev/null
start_window --paused
key Escape
key q ctrl
end_window 0
[ -n "$(ls "$place/state/behaviourlinks/journals")" ] || fail 'the journal of the killed window is gone'

# A plan at rest is not drawn again and again: there is a pause between two frames, and an end to it when the mouse comes.
cp "$checkout/scenes/links/attract.json" "$place/attract.json"
start_window "$place/attract.json" --frame-times "$place/frames.csv"
key Escape
pause 15
point "$((width / 2))" "$((height / 2))"
key q ctrl
end_window 0
longest=$(awk -F, 'NR > 2 && $2 - last > most { most = $2 - last } { last = $2 } END { print int(most) }' "$place/frames.csv")
[ "$longest" -ge 4 ] || fail "a plan at rest is drawn all the time: no pause is longer than $longest s"
case $(tail -n 1 "$place/frames.csv" | cut -d, -f2) in 0*|1.*|2.*|3.*) fail 'nothing was drawn after the rest' ;; esac

# What cannot be opened leaves a window that says so.
echo '{"format": "behaviourlinks", "version": 1, "nodes": [{"id": "a", "typos": {}}]}' >"$place/bad.json"
start_window "$place/bad.json"
key Escape
key q ctrl
end_window 0

[ "$failures" = 0 ] && echo 'the window does what it should'
exit "$((failures > 0))"
