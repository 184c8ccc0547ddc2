#!/usr/bin/env bash
# Writes docs/performance.md and docs/gallery/roofline.svg from one run of `voxmelt bench`.
#   bench/write_performance.sh [VOXMELT] [further options of voxmelt bench]
# Text comes from bench/performance_template.md; its {{name}} lines become the table of that name, or, for
# what is measured by hand, the file bench/performance_<name>.md. WRITE_TO: another folder than docs.
set -euo pipefail
cd "$(dirname "$0")/.."

voxmelt=${1:-build/release/app/voxmelt}
if [ $# -gt 0 ]; then shift; fi
docs=${WRITE_TO:-docs}
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

"$voxmelt" bench --out "$results/out" "$@"

{
  echo '<!-- Written by bench/write_performance.sh from bench/performance_template.md; edit those. -->'
  awk -v tables="$results/out/performance_tables.md" '
    BEGIN {
      while ((getline line < tables) > 0) {
        if (match(line, /^<!-- table: [a-z]+ -->$/)) name = substr(line, 13, length(line) - 16)
        else text[name] = text[name] line "\n"
      }
      for (name in text) sub(/\n+$/, "", text[name])
    }
    /^\{\{[a-z]+\}\}$/ {
      name = substr($0, 3, length($0) - 4)
      if (name in text) { print text[name]; next }
      file = "bench/performance_" name ".md"
      lines = 0
      while ((getline line < file) > 0) { print line; ++lines }
      if (lines == 0) print "*(not measured yet)*"
      next
    }
    { print }' bench/performance_template.md
} > "$results/performance.md"

mkdir -p "$docs/gallery"
cp "$results/out/roofline.svg" "$docs/gallery/roofline.svg"
cp "$results/performance.md" "$docs/performance.md"
echo "written: $docs/performance.md, $docs/gallery/roofline.svg"
