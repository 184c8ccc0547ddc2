#!/usr/bin/env python3
"""Two threads beside as many busy programs as there are processors: how do their medians compare with one?

  bench/under_load.py [VOXMELT] [--scenes cello,goblet,lava] [--foreign N]

Runs `voxmelt bench` on the scenes while N other processes count, and prints for each scene the median of flow and
heat on all threads over that on one. A step is quiet or not at random, so the figure is of medians. Nothing is
gated: it prints what it has measured.
"""
import argparse
import json
import multiprocessing
import os
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def count():
    number = 0
    while True:
        number += 1


def medians(cases):
    """Seconds of flow and heat of each scene: {workload: {threads: sum}}, by the widest set."""
    widest = cases[-1]["implementation"]
    found = {}
    for case in cases:
        if case["implementation"] == widest:
            of = found.setdefault(case["workload"], {})
            of[case["threads"]] = of.get(case["threads"], 0) + case["median_milliseconds"]
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("voxmelt", nargs="?", default=ROOT / "build/release/app/voxmelt")
    parser.add_argument("--scenes", default="cello,goblet,lava")
    parser.add_argument("--foreign", type=int, default=os.cpu_count())
    options = parser.parse_args()

    others = [multiprocessing.Process(target=count, daemon=True) for _ in range(options.foreign)]
    for other in others:
        other.start()
    try:
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "report.json"
            subprocess.run([options.voxmelt, "bench", "--quiet", "--parts", "automaton", "--scenes", options.scenes,
                            "--report", report], check=True, stdout=subprocess.DEVNULL)
            cases = json.loads(report.read_text())["cases"]
    finally:
        for other in others:
            other.kill()

    print(f"{options.foreign} foreign threads; medians of flow and heat, ms a step")
    for workload, of in medians(cases).items():
        one, all_threads = of[1], max(of)
        print(f"{workload:28} 1 thread {one:7.3f}   {all_threads} threads {of[all_threads]:7.3f}   "
              f"{of[all_threads] / one:.2f} of one")


if __name__ == "__main__":
    main()
