# Finds what the page is built and tested with; sourced by build.sh and test.sh, in the folder ui/web.
root=$(CDPATH='' cd -- ../.. && pwd -P)

# Debian's esbuild needs no node. The one of npm builds the same.
esbuild=$(command -v esbuild || true)
[ -n "$esbuild" ] || esbuild=$here/node_modules/.bin/esbuild

# need_modules run_time|development: installs what package-lock.json names, without running scripts of packages.
need_modules() {
  if [ "$1" = run_time ] && [ -f node_modules/preact/package.json ] && [ -f node_modules/three/package.json ] && [ -x "$esbuild" ]; then return; fi
  if [ "$1" = development ] && [ -d node_modules/playwright-core ] && [ -d node_modules/typescript ] && [ -d node_modules/@types/three ]; then return; fi
  command -v npm >/dev/null || { echo 'The page needs npm once: install the packages `nodejs` and `npm`.' >&2; exit 1; }
  if [ "$1" = run_time ] && command -v esbuild >/dev/null; then npm ci --ignore-scripts --omit=dev --no-audit --no-fund >&2
  else npm ci --ignore-scripts --no-audit --no-fund >&2
  fi
}

chromium_of() {
  [ -z "${CHROMIUM:-}" ] || { echo "$CHROMIUM"; return; }
  command -v chromium || command -v chromium-browser || command -v google-chrome || true
}
