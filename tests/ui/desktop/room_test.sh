# Two real windows in a room of a real server: one drags a volume all the time, both take the same ticks, the second as on an older
# processor. The server tells a hash every twenty ticks, and none while the room is at rest.
# Usage: sh room_test.sh BUILD CHECKOUT [SECONDS [PICTURE]]
set -u
build=$1 checkout=$2 seconds=${3:-20} picture=${4:-}
window_program=$build/ui/desktop/behaviourlinks-desktop
. "$checkout/tests/ui/desktop/display.sh"
server_pid= second_pid= second_display=
leave_room() {
  for pid in "$second_pid" "$second_display" "$server_pid"; do [ -n "$pid" ] && kill "$pid" 2>/dev/null; done
  leave
}
trap leave_room EXIT

"$build/ui/cli/behaviourlinks" serve "$checkout/scenes/start/quarter.json" --bind 127.0.0.1 --port 0 --journal "$place/room.blsession" \
  --invites "$place/invites.json" >"$place/server.out" 2>"$place/server.log" &
server_pid=$!
address() { sed -n 's|^room [A-Z]* at http://||p' "$place/server.out"; }
is_open() { [ -n "$(address)" ]; }
until_true 60 is_open || { cat "$place/server.log" >&2; fail 'the server does not open the room'; exit 1; }
key_of() { grep -o "\"$1\": *\"[0-9a-f]*\"" "$place/invites.json" | sed 's/.*"\([0-9a-f]*\)"$/\1/'; }

start_display
start_window "room://$(address)#k=$(key_of facilitator)" --room-report "$place/first.csv"
first_display=$DISPLAY
Xvfb -displayfd 3 -screen 0 "${width}x${height}x24" +extension GLX -r -noreset -nolisten tcp 3>"$place/display2" >"$place/xvfb2.log" 2>&1 &
second_display=$!
has_second() { [ -s "$place/display2" ]; }
until_true 20 has_second || { fail 'there is no second display'; exit 1; }
# Fused multiplications and the library's variants for them give other last bits, where a program leaves the choice to the processor.
GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2 DISPLAY=:$(cat "$place/display2") XDG_STATE_HOME=$place/state2 "$window_program" "room://$(address)#k=$(key_of designer)" \
  --room-report "$place/second.csv" --seconds "$((seconds + 25))" >"$place/window2.log" 2>&1 &
second_pid=$!
DISPLAY=$first_display
is_joined() { case $(title) in *'room '*) ;; *) return 1 ;; esac; }
until_true 30 is_joined || fail "the window has not joined: $(title)"
pause 3

# One long pull in the view, to and fro, so that no tick finds the room at rest.
key Escape
x=$((width * 58 / 100)) y=$((height * 40 / 100))
end=$(($(date +%s) + seconds))
point "$x" "$y"
press
while [ "$(date +%s)" -lt "$end" ]; do
  for step in 1 2 3 4 5 6 5 4 3 2 1 0; do point "$((x + 9 * step))" "$((y + 4 * step))"; done
done
release
[ -n "$picture" ] && import -window root "$picture" && DISPLAY=:$(cat "$place/display2") import -window root "${picture%.png}_2.png"
pause 2
key q ctrl
end_window 0
wait "$second_pid" || { cat "$place/window2.log" >&2; fail 'the second window has not ended well'; }
second_pid=
# At the slowest rate of a machine that draws two windows by software there is a hash in ten seconds.
least=$((seconds / 10 > 2 ? seconds / 10 : 2))
for report in first second; do
  line=$(tail -n 1 "$place/$report.csv") || fail "there is no report of the $report window"
  ticks=$(echo "$line" | cut -d, -f1) entries=$(echo "$line" | cut -d, -f3) agreed=$(echo "$line" | cut -d, -f4)
  differed=$(echo "$line" | cut -d, -f5) waiting=$(echo "$line" | cut -d, -f6)
  echo "$report window: tick ${ticks:-?}, ${entries:-?} entries, $((${agreed:-0} + ${differed:-0})) hashes compared," \
    "${agreed:-0} equal, ${differed:-?} different"
  [ "${agreed:-0}" -ge "$least" ] || fail "the $report window has compared fewer than $least hashes: $line"
  [ "${differed:-1}" = 0 ] || fail "the $report window had another result than the server: $line"
  [ "${waiting:-1}" = 0 ] || fail "the $report window still waits for answers: $line"
done
kill -INT "$server_pid"
wait "$server_pid"
server_pid=
entries=$(tail -n 1 "$place/first.csv" | cut -d, -f3)
[ "${entries:-0}" -ge 10 ] || fail "the drag has said only $entries entries"
[ "$failures" = 0 ] && echo 'both windows took the same ticks as the server'
exit "$((failures > 0))"
