#!/bin/sh
# Tests the page: types, the laws of the connection, ballots and words, and all screens in Chromium if there is one.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
cd "$here"
. ./tools.sh
need_modules development
node_modules/.bin/tsc --noEmit
mkdir -p "$root/build/web_test"
"$esbuild" src/modules.ts --bundle --format=esm --target=es2019 --log-level=warning --outfile="$root/build/web_test/modules.mjs"
node --test test/*.test.mjs
./build.sh
if [ -n "$(chromium_of)" ]; then
  CHROMIUM=$(chromium_of)
  export CHROMIUM
  if [ -n "${BEHAVIOURLINKS:-}" ]; then node test/real_room.mjs && node test/real_space.mjs && node test/real_follow.mjs; fi
  node test/screens.mjs "$@"
else echo 'The screens were not looked at: there is no chromium. Install the package `chromium` for that.'
fi
