# Times of the real window under a virtual display: frames, and from the mouse to the picture. Usage: sh latency.sh BUILD CHECKOUT
set -u
build=$1 checkout=$2
window_program=$build/ui/desktop/behaviourlinks-desktop
. "$checkout/tests/ui/desktop/display.sh"
# name NUMBERS: how many, median, 95th of a hundred and the longest.
summary() { sort -n | awk -v name="$1" '{ v[NR] = $1 } END { if (NR) printf "%-44s %5d %8.1f %8.1f %8.1f\n", name, NR, v[int((NR + 1) / 2)], v[int(NR * 0.95 + 0.5)], v[NR] }'; }
# measure NAME SCENE NODE: a box selection is pulled out, and then the node's box is dragged; - where boxes are too small for it.
measure() {
  what=$1 scene=$checkout/scenes/$2 node=$3
  if [ "$node" != - ]; then
    # shellcheck disable=SC2046
    set -- $("$build/tests/ui/desktop/desktop_places" "$scene" "$width" "$height" "node:$node")
    x=$1 y=$2
  fi
  start_window "$scene" --frame-times "$place/frames.csv"
  pause 6
  empty_x=$((width / 50)) empty_y=$((height * 53 / 100))
  # To the left: its ground is the stronger one.
  point $((empty_x + 100)) $((empty_y + 80)); press; point $((empty_x + 90)) $((empty_y + 70))
  "$build/tests/ui/desktop/desktop_latency" $((empty_x + 80)) $((empty_y + 60)) -60 -50 60 >"$place/band" || fail "$what: the selection's frame was not seen"
  key Escape
  release
  if [ "$node" != - ]; then
    point "$x" "$y"; press; point $((x + 8)) $((y + 8))
    "$build/tests/ui/desktop/desktop_latency" $((x + 8)) $((y + 8)) 60 0 60 >"$place/box" || fail "$what: the box was not seen"
    key Escape
    release
  fi
  [ -z "${BL_LATENCY_PICTURES:-}" ] || import -window root "$BL_LATENCY_PICTURES/$node.png"
  key q ctrl
  end_window 0
  tail -n +100 "$place/frames.csv" | cut -d, -f1 | summary "$what, a frame"
  summary "$what, mouse to selection frame" <"$place/band"
  [ "$node" = - ] || summary "$what, mouse to dragged box" <"$place/box"
}
start_display
printf '%-44s %5s %8s %8s %8s\n' 'milliseconds' 'count' 'median' '95 %' 'longest'
measure 'quarter, ticking' start/quarter.json site
measure '60 volumes, ticking' studies/sixty_volumes.json -
measure '1000 volumes, ticking' studies/thousand_volumes.json -
[ "$failures" = 0 ]
