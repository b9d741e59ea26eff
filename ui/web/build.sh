#!/bin/sh
# Builds the page into build/web: index.html, and script and style sheet under names that hold their hashes, each with a .gz.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
cd "$here"
. ./tools.sh
need_modules run_time

out=$root/build/web new=$root/build/web.new
rm -rf "$new"
mkdir -p "$new/assets"
"$esbuild" src/page.tsx src/style.css --bundle --minify --format=iife --target=es2019,chrome70,safari13,firefox68 --charset=utf8 \
  --jsx=automatic --jsx-import-source=preact --legal-comments=none --log-level=warning \
  --entry-names='[name]-[hash]' --outdir="$new/assets"
script=$(cd "$new/assets" && ls page-*.js)
style=$(cd "$new/assets" && ls style-*.css)
sed -e "s|PAGE_SCRIPT|/assets/$script|" -e "s|PAGE_STYLE|/assets/$style|" -e '/^<!--.*-->$/d' src/index.html >"$new/index.html"
total=0
for file in "$new/index.html" "$new/assets/$script" "$new/assets/$style"; do
  gzip -9 -n -k "$file"
  bytes=$(wc -c <"$file.gz")
  total=$((total + bytes))
  printf '%7d bytes, %6d compressed  %s\n' "$(wc -c <"$file")" "$bytes" "${file#"$new"/}"
done
printf '%7s        %6d compressed  in all\n' '' "$total"
rm -rf "$out"
mv "$new" "$out"
