#!/usr/bin/env python3
"""How fast are the stages in SystemVerilog, compiled by Verilator? In processor time of one core.

  tests/rtl/speed/run.py --docs docs/results/rtl_speed.md      measures, and writes the page

It wants the program: cmake --build --preset release --target voxmelt voxmelt-hardware. Each time is the least of five, on
a machine that does nothing else. What it takes to read vectors, or to come to the first step, is measured alone and taken
off.
"""
import argparse
import math
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/app/voxmelt"
SCENE, FIRST, LANES = "cello", 1048, 4
PASSES = 2  # that the folder of `voxmelt rtl` streams
TIMES = 5


def processor_seconds(words, folder=None):
    """The processor time of a command and all that it starts, and its text."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if result.returncode != 0:
        sys.exit(f"{words}: {result.stdout[-500:]}{result.stderr[-500:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, result.stdout


def least(words, folder=None):
    return min((processor_seconds(words, folder) for _ in range(TIMES)), key=lambda found: found[0])


def pipeline_alone():
    """The grid's cells, seconds to compile, and cell-steps per second."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "pipeline"
        processor_seconds([PROGRAM, "rtl", SCENE, "--from", str(FIRST), "--set", f"hw.lanes={LANES}", "--out", folder])
        grid = re.search(r"a grid of (\d+) x (\d+) x (\d+) cells", (folder / "pipeline.sv").read_text()).groups()
        cells = math.prod(map(int, grid))
        compiles, _ = processor_seconds(["make", "built/testbench"], folder)
        reads, _ = least(["./built/testbench", "+load"], folder)
        streams, text = least(["./built/testbench", "+stalls=0"], folder)
    if "no difference" not in text:
        sys.exit(text)
    return cells, compiles, PASSES * cells / (streams - reads)


def lock_step(cells):
    """Cell-steps per second of software, models and circuits together, with a second run whose cycles are compared."""
    words = [PROGRAM, "verify", SCENE, "--from", str(FIRST), "--set", f"hw.lanes={LANES}", "--rtl", "all", "--steps"]
    one, _ = least([*words, "1"])
    three, text = least([*words, "3"])
    if "both sides of every channel did the same" not in text:
        sys.exit(text)
    return 2 * cells / (three - one)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--docs", type=Path, help="the page to write")
    options = parser.parse_args()
    cells, compiles, alone = pipeline_alone()
    together = lock_step(cells)
    page = f"""<!-- Written by tests/rtl/speed/run.py -->
# Speed of the circuits in a simulator

Verilator compiles the pipeline of `{SCENE}`, the paper's law with heat, for {LANES} lanes and one time
step. Speeds are cell-steps in a second of processor time of one core.

| what runs | cell-steps/s |
|---|--:|
| the pipeline that `voxmelt rtl` writes, with its test bench | {alone:,.0f} |
| software, models and all stages as circuits, and the run that compares cycles | {together:,.0f} |

Verilator and the compiler take {compiles:.0f} s of processor time for the first one.

Run it yourself: `python3 tests/rtl/speed/run.py --docs docs/results/rtl_speed.md`. It wants `verilator`.
"""
    print(page)
    if options.docs:
        options.docs.write_text(page)


if __name__ == "__main__":
    main()
