# Plays a tour of the window by mouse and keys, and leaves pictures of it. Usage: sh tour.sh BUILD CHECKOUT PICTURES
set -u
build=$1 checkout=$2 pictures=$3
window_program=$build/ui/desktop/behaviourlinks-desktop
. "$checkout/tests/ui/desktop/display.sh"
mkdir -p "$pictures"
picture() { import -window root "$pictures/$1.png"; }
# shellcheck disable=SC2086
coordinates() { set -- $1; x=$1 y=$2; }
place_of() { "$build/tests/ui/desktop/desktop_places" "$checkout/scenes/$1" "$width" "$height" "$2"; }
# command TEXT: by the palette.
command_by_name() { key k ctrl; pause 0.4; text "$1"; key Return; pause 0.6; }
on_canvas() { point $((width / 5)) $((height * 55 / 100)); }
on_view() { point $((width * 55 / 100)) $((height / 3)); }
leave_window() { command_by_name 'Back to the saved'; key Escape; key q ctrl; pause 1; kill "$window_pid" 2>/dev/null; wait "$window_pid" 2>/dev/null; window_pid=; }

start_display
start_window
pause 8
picture 01-start-page
key q ctrl
pause 1

start_window "$checkout/scenes/start/quarter.json"
pause 6
picture 02-quarter
coordinates "$(place_of start/quarter.json node:library)"
click "$x" "$((y + 18))"
pause 1
picture 03-inspector
on_canvas; wheel up 4; pause 1
picture 04-canvas-middle
wheel up 6; pause 1
picture 05-canvas-near
key Home; pause 1
coordinates "$(place_of start/quarter.json handle:theatre)"
from_x=$x from_y=$y
coordinates "$(place_of start/quarter.json node:library)"
drag "$from_x" "$from_y" "$x" "$((y + 18))"
pause 0.8
picture 06-which-link
key Escape
on_canvas; key Tab; pause 0.6; text smart; pause 0.4
picture 07-add-node
key Escape
key k ctrl; pause 0.6
picture 08-commands
key Escape
on_canvas; key Home; pause 1
coordinates "$(place_of start/quarter.json node:library)"
click "$x" "$((y + 18))"
key g ctrl; key Return; pause 0.5
key i; pause 1
picture 16-entered
key u; pause 1
click "$x" "$((y + 18))" 3; pause 0.8
picture 17-menu
key Escape
key h shift; pause 0.8
picture 18-hidden
key z ctrl; key z ctrl; pause 0.5
on_view; drag $((width * 55 / 100)) $((height / 3)) $((width * 62 / 100)) $((height * 2 / 5)) 3; pause 1
picture 09-view-turned
key 1; pause 1.5
picture 10-view-plan
key 4; pause 1.5
command_by_name 'Beamer'
pause 1
picture 11-beamer
key Escape; pause 1
command_by_name 'Dark colours'
picture 12-light
command_by_name 'Dark colours'
leave_window

# A scene like the largest one, of so many nodes.
scene_of() {
  python3 - "$checkout/scenes/studies/thousand_volumes.json" "$1" <<'CUT' >"$place/nodes_$1.json"
import json, sys
scene = json.load(open(sys.argv[1]))
scene["nodes"] = scene["nodes"][:int(sys.argv[2])]
json.dump(scene, sys.stdout)
CUT
}
# The canvas at three zooms, dark and light.
for nodes in 10 60 500; do
  scene_of "$nodes"
  start_window "$place/nodes_$nodes.json"
  pause 6
  for colours in dark light; do
    key Home; pause 1
    for zoom in far middle near; do
      picture "canvas-$nodes-$zoom-$colours"
      on_canvas; wheel up 6; pause 1
    done
    command_by_name 'Dark colours'
  done
  leave_window
done
start_window "$checkout/scenes/studies/sixty_volumes.json"
pause 6
picture 13-sixty
leave_window
start_window "$checkout/scenes/studies/thousand_volumes.json"
pause 12
picture 14-thousand
leave_window
echo "pictures are in $pictures"
