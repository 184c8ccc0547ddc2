#!/usr/bin/env bash
# Writes docs/results/performance.md, docs/results/performance_picture.md, docs/results/performance_tables.md and
# docs/gallery/roofline.svg from one run of `voxmelt bench`, in about twenty minutes.
#   bench/write_performance.sh [VOXMELT] [further options of voxmelt bench]
# The text of a page comes from its template in this folder. A line {{name}} becomes the table of that
# name. What other programs measure comes from the file bench/performance_<name>.md, which
# bench/feature_cost.py, bench/compare_vtk.py and bench/view_frames.py write. WRITE_TO names another folder than docs.
set -euo pipefail
cd "$(dirname "$0")/.."

voxmelt=${1:-build/release/app/voxmelt}
if [ $# -gt 0 ]; then shift; fi
docs=${WRITE_TO:-docs}
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

"$voxmelt" bench --out "$results/out" --parts automaton,picture,grids,film "$@"

fill() {  # fill TEMPLATE: the template with its tables
  echo "<!-- Written by bench/write_performance.sh. Do not edit this page, but its template: -->"
  echo "<!-- $1 -->"
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
      if (lines == 0) { print "no table named " name > "/dev/stderr"; exit 1 }
      next
    }
    { print }' "$1"
}
pages="performance performance_picture performance_tables"
for page in $pages; do fill "bench/${page}_template.md" > "$results/$page.md"; done

mkdir -p "$docs/gallery" "$docs/results"
cp "$results/out/roofline.svg" "$docs/gallery/roofline.svg"
for page in $pages; do cp "$results/$page.md" "$docs/results/"; done
echo "written: $pages in $docs/results/, $docs/gallery/roofline.svg"
