#!/usr/bin/env bash
# Writes docs/results/front.md from a full run of `voxmelt accuracy --front`, and leaves its page in out/front.
#   accuracy/write_front.sh [VOXMELT] [further options of voxmelt accuracy]
set -euo pipefail
cd "$(dirname "$0")/.."

voxmelt=${1:-build/release/app/voxmelt}
if [ $# -gt 0 ]; then shift; fi

"$voxmelt" accuracy --front --out out/front "$@"
cp out/front/front.md docs/results/front.md
echo "written: docs/results/front.md, out/front/front.html"
