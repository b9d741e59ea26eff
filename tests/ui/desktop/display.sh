# A virtual display, the real window on it, and hands to work it with; read by window_test.sh and tour.sh.
# shellcheck shell=sh
# shellcheck disable=SC2034

place=$(mktemp -d "${TMPDIR:-/tmp}/bl window.XXXXXX") || exit 1
window_pid= display_pid=
failures=0
width=1440 height=900

leave() {
  [ -n "$window_pid" ] && kill "$window_pid" 2>/dev/null
  [ -n "$display_pid" ] && kill "$display_pid" 2>/dev/null
  wait 2>/dev/null
  rm -rf "$place"
}
trap leave EXIT
trap 'exit 1' INT TERM

fail() { echo "FAILED: $*" >&2; failures=$((failures + 1)); }

start_display() {
  Xvfb -displayfd 3 -screen 0 "${width}x${height}x24" +extension GLX -r -noreset -nolisten tcp 3>"$place/display" >"$place/xvfb.log" 2>&1 &
  display_pid=$!
  tries=0
  while [ ! -s "$place/display" ]; do
    sleep 0.1
    tries=$((tries + 1))
    [ "$tries" -lt 100 ] || { cat "$place/xvfb.log" >&2; echo 'there is no virtual display' >&2; exit 1; }
  done
  DISPLAY=:$(cat "$place/display")
  XDG_STATE_HOME=$place/state
  # Drawing needs no second core; the ticks do.
  LP_NUM_THREADS=1
  export DISPLAY XDG_STATE_HOME LP_NUM_THREADS
}

# start_window ARGUMENTS...: the window, once it has drawn its first frames.
start_window() {
  "$window_program" "$@" >"$place/window.log" 2>&1 &
  window_pid=$!
  tries=0
  until xdotool search --name BehaviourLinks >/dev/null 2>&1; do
    sleep 0.1
    tries=$((tries + 1))
    [ "$tries" -lt 300 ] || { cat "$place/window.log" >&2; echo 'the window does not open' >&2; exit 1; }
    kill -0 "$window_pid" 2>/dev/null || { cat "$place/window.log" >&2; echo 'the window has ended' >&2; exit 1; }
  done
  pause 2
}

# end_window CODE: it has to end by itself now, with that exit code.
end_window() {
  wait "$window_pid"
  code=$?
  window_pid=
  [ "$code" = "$1" ] || { cat "$place/window.log" >&2; fail "the window ended with $code, not $1"; }
}

# Software drawing on a busy machine is slow: every step of the hand waits for some frames. BL_HAND_PAUSE stretches it.
pause() { sleep "$(awk -v s="$1" -v f="${BL_HAND_PAUSE:-1}" 'BEGIN { print s * f }')"; }
beat() { pause 0.15; }

point() { xdotool mousemove "$1" "$2"; beat; }
press() { xdotool mousedown "${1:-1}"; beat; }
release() { xdotool mouseup "${1:-1}"; beat; }
click() { point "$1" "$2"; press "${3:-1}"; release "${3:-1}"; }

# drag X1 Y1 X2 Y2 [BUTTON]
drag() {
  point "$1" "$2"
  press "${5:-1}"
  step=1
  while [ "$step" -le 6 ]; do
    point "$(($1 + ($3 - $1) * step / 6))" "$(($2 + ($4 - $2) * step / 6))"
    step=$((step + 1))
  done
  release "${5:-1}"
}

wheel() {    # up or down, times
  button=4
  [ "$1" = down ] && button=5
  times=0
  while [ "$times" -lt "$2" ]; do
    xdotool mousedown "$button"
    xdotool mouseup "$button"
    beat
    times=$((times + 1))
  done
}

# key NAME [MODIFIERS...]: held for more than a frame.
key() {
  name=$1
  shift
  for modifier in "$@"; do xdotool keydown "$modifier"; done
  beat
  xdotool keydown "$name"
  beat
  xdotool keyup "$name"
  for modifier in "$@"; do xdotool keyup "$modifier"; done
  beat
}

text() { xdotool type --delay 150 "$1"; beat; }
title() { xdotool getwindowname "$(xdotool search --name BehaviourLinks | head -n 1)"; }

# until_true SECONDS COMMAND...: tried again and again; whether it came true.
until_true() {
  rest=$(($1 * 5))
  shift
  until "$@"; do
    rest=$((rest - 1))
    [ "$rest" -gt 0 ] || return 1
    pause 0.2
  done
}
