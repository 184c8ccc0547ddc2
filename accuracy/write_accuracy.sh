#!/usr/bin/env bash
# Writes docs/results/accuracy.md from a full run of `voxmelt accuracy`, and leaves its page in out/accuracy.
#   accuracy/write_accuracy.sh [VOXMELT] [further options of voxmelt accuracy]
# It writes even if a gate is missed, because the page says so.
set -euo pipefail
cd "$(dirname "$0")/.."

voxmelt=${1:-build/release/app/voxmelt}
if [ $# -gt 0 ]; then shift; fi

code=0
"$voxmelt" accuracy --out out/accuracy "$@" || code=$?
if [ "$code" -gt 1 ]; then exit "$code"; fi
cp out/accuracy/accuracy.md docs/results/accuracy.md
echo "written: docs/results/accuracy.md, out/accuracy/accuracy.html"
