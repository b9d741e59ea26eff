#!/bin/sh
# The tour of the page with the real server where there is no way to anywhere: a network of its own with nothing but a loopback.
# It needs the right to make a network namespace: root, or `unshare -r`.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
[ -n "${BEHAVIOURLINKS:-}" ] || { echo 'BEHAVIOURLINKS has to name the program.' >&2; exit 2; }
export here
exec unshare -n sh -euc '
  ip link set lo up
  test "$(ip -o link | wc -l)" -eq 1
  node "$here/real_room.mjs"
'
