#!/usr/bin/env bash
# What a first picture costs: a fresh clone of this tree, built and run by ./run.sh, without a cache of objects.
#   first_picture.sh            processor time and wall time to the picture, and disk
#   first_picture.sh --all      the same of everything without tests
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
git clone -q "$root" "$folder/voxmelt"
cd "$folder/voxmelt"

TIMEFORMAT='%U %S %R'
build() {
  if [ "${1:-}" = --all ]; then
    mkdir -p build
    cmake --preset release -DVOXMELT_TESTS=OFF > build/configure.log
    cmake --build --preset release > build/build.log
  else
    ./run.sh --quiet > build.log
    ls out/cello/contact_sheet.png > /dev/null
  fi
}
{ time build "$@" 2> "$folder/errors"; } 2> "$folder/seconds" || { cat "$folder/errors" "$folder/seconds"; exit 1; }
awk '{printf "processor time %.0f s, wall time %.0f s, ", $1 + $2, $3}' < <(tail -1 "$folder/seconds")
du -sh build | awk '{print "build folder " $1 "B"}'
