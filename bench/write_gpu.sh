#!/usr/bin/env bash
# Writes a page of results, gpu.md, from one run of `voxmelt bench` on a device, in some minutes.
#   bench/write_gpu.sh [VOXMELT] [further options of voxmelt bench, such as --implementation gpu:1]
# WRITE_TO names another folder than docs.
set -euo pipefail
cd "$(dirname "$0")/.."

voxmelt=${1:-build/release/app/voxmelt}
if [ $# -gt 0 ]; then shift; fi
docs=${WRITE_TO:-docs}
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

"$voxmelt" bench --implementation gpu --out "$results/out" "$@"

table() {  # table NAME
  awk -v wanted="<!-- table: $1 -->" '/^<!-- table: / { inside = $0 == wanted; next } inside && /^\|/' \
    "$results/out/performance_tables.md"
}
mkdir -p "$docs/results"
cat > "$docs/results/gpu.md" <<END
<!-- Written by bench/write_gpu.sh. -->
# Steps on a device

$(table device)

A copy counts bytes read and written. Each workload was run once to see its bits and its books
beside the reference's. Then whole steps were timed from the same state, without visibility.

$(table devicesteps)

"Of the copy" is what the definition must read and write of active cells, beside what the device
copies in that time. The column "of the step" says what the launches cost at least. Kernels are
timed one by one, so each has a launch more than in a row. "Visibility" is what a step of visibility
takes beside that. "In a run" has it, and a share of one fetch of the state at the end.

What the host sends or fetches, if it does:

$(table transfers)

Pictures, made anew from a state on the device, with the setting \`normal\`. A processor makes the
same one anew, too, from a state of its own:

$(table devicepictures)
END
echo "written: $docs/results/gpu.md"
