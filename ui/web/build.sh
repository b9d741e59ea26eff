#!/bin/sh
# Builds the page into build/web: index.html, and the script and the words of each language under names that hold their hashes, each
# with a .gz; and proposal.html, which exports of proposals fill. The style sheet and the beginning of the script stand in index.html, which saves round trips on slow networks.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
cd "$here"
. ./tools.sh
need_modules run_time

out=$root/build/web new=$root/build/web.new
rm -rf "$new"
mkdir -p "$new/assets"
target=es2019,chrome70,safari13,firefox68
bundled() { "$esbuild" "$@" --bundle --minify --target=$target --charset=utf8 --legal-comments=none --log-level=warning; }
preact='--jsx=automatic --jsx-import-source=preact'
# What comes when somebody asks for it: the picture in three dimensions, files, and the page of who leads, each with its words.
bundled src/space/picture.ts --format=esm --entry-names='space-[hash]' --outdir="$new/assets"
named() { (cd "$new/assets" && printf '"%s":"/assets/%s"' "$1" "$(ls "$2"-*.js)"); }
chunks=$(named space space)
parts='' part_words=''
for part in files lead; do
  bundled src/$part/show.tsx --format=esm $preact --supported:dynamic-import=true --define:CHUNKS="{$chunks}" --entry-names="$part-[hash]" --outdir="$new/assets"
  parts=$parts,$(named $part $part)
  of_part=''
  for language in de ko nl; do
    bundled src/$part/words/$language.ts --format=esm --entry-names="words-$part-$language-[hash]" --outdir="$new/assets"
    of_part=$of_part,$(named $language words-$part-$language)
  done
  part_words=$part_words,'"'$part'"':{${of_part#,}}
done
bundled src/page.tsx --format=iife --define:CHUNKS="{$chunks$parts,\"words\":{${part_words#,}}}" $preact --supported:dynamic-import=true \
  --entry-names='[name]-[hash]' --outdir="$new/assets"
script=$(cd "$new/assets" && ls page-*.js)
bundled src/words/de.ts src/words/ko.ts src/words/nl.ts --format=esm --entry-names='[name]-[hash]' --outdir="$new/assets"
words=$(cd "$new/assets" && for language in de ko nl; do printf '"%s":"/assets/%s",' $language "$(ls $language-*.js)"; done)
bundled src/early.ts --format=iife --supported:dynamic-import=true --define:WORDS="{${words%,}}" --outfile="$new/early.js"
bundled src/style.css --outfile="$new/style.css"
while IFS= read -r line; do
  case $line in
    '<!--'*'-->') ;;
    PAGE_EARLY) printf '<script>' && cat "$new/early.js" && printf '</script>\n' ;;
    PAGE_STYLE) printf '<style>' && cat "$new/style.css" && printf '</style>\n' ;;
    *PAGE_SCRIPT*) printf '%s/assets/%s%s\n' "${line%%PAGE_SCRIPT*}" "$script" "${line#*PAGE_SCRIPT}" ;;
    *) printf '%s\n' "$line" ;;
  esac
done <src/index.html >"$new/index.html"
rm "$new/early.js" "$new/style.css"
# The page of a proposal is one file, with its script and its looks in it; an export puts its data there.
bundled src/proposal/page.tsx --format=iife $preact --outfile="$new/proposal.js"
bundled src/proposal/style.css --outfile="$new/proposal.css"
while IFS= read -r line; do
  case $line in
    PAGE_STYLE) printf '<style>' && cat "$new/proposal.css" && printf '</style>\n' ;;
    PAGE_SCRIPT) printf '<script>' && cat "$new/proposal.js" && printf '</script>\n' ;;
    *) printf '%s\n' "$line" ;;
  esac
done <src/proposal/index.html >"$new/proposal.html"
rm "$new/proposal.js" "$new/proposal.css"
printf '%7d bytes, of a proposal without its data\n' "$(wc -c <"$new/proposal.html")"
total=0
for file in index.html $(cd "$new" && ls assets/*); do
  gzip -9 -n -k "$new/$file"
  bytes=$(wc -c <"$new/$file.gz")
  case $file in index.html | */page-*) total=$((total + bytes)) ;; esac
  case $file in */space-*) [ "$bytes" -le 135000 ] || { echo 'The script of the picture in three dimensions has grown too large.' >&2; exit 1; } ;; esac
  printf '%7d bytes, %6d compressed  %s\n' "$(wc -c <"$new/$file")" "$bytes" "$file"
done
printf '%7s        %6d compressed  in all, in English\n' '' "$total"
rm -rf "$out"
mv "$new" "$out"
