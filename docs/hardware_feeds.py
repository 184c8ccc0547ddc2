#!/usr/bin/env python3
"""What ways to feed irradiance cost on the showcase scenes of the paper law in mid-melt: bits per cycle, and bits of buffers.

  hardware_feeds.py PROGRAM           prints a table, at 8 lanes and 8 steps

They are counted from the report of one pass: what was sent, how many cells and tokens are lit, and the lags.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

LANES = STEPS = 8
SCENES = {"cello": 1048, "goblet": 1100, "lava": 1200, "bunny": 896}


def report_of(program, scene, step):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.json"
        subprocess.run([program, "verify", scene, "--from", str(step), "--steps", str(STEPS), "--every", str(STEPS),
                        "--set", "pieces.fall=false",  # else no pass has two steps
                        "--set", f"hw.lanes={LANES}", "--set", f"hw.cascade={STEPS}", "--quiet", "--report", str(file)],
                       check=True, stdout=subprocess.DEVNULL)
        return json.loads(file.read_text())


def row_of(scene, report):
    lit = report.get("irradiance", {"lit_cells": 0, "stored_bits": 0})
    x, y, z = report["grid"]
    tokens = (x + LANES - 1) // LANES * y * z
    mask = STEPS * (LANES + 16 * lit["lit_cells"] / tokens)
    lag = sum(stage["lag"] for stage in report["stages"] if stage["cascade"] == 0)
    carried = 16 * LANES * lag * (STEPS - 1)
    return [scene, f"{100 * lit['lit_cells'] / (x * y * z):.3f}", f"{report['traffic_bits_per_cycle']['irradiance']:.1f}",
            f"{mask:.1f}", 16 * LANES, f"{carried:,}", f"{report['buffer_bits']:,}"]


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    print("| scene | lit cells, % | sparse | mask | carried | its buffers | all other buffers |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    for scene, step in SCENES.items():
        print("| " + " | ".join(str(cell) for cell in row_of(scene, report_of(sys.argv[1], scene, step))) + " |",
              flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
