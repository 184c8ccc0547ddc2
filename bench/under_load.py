#!/usr/bin/env python3
"""Two threads beside as many busy programs as there are processors: how do they compare with one?

  bench/under_load.py [VOXMELT] [--scenes cello,goblet,lava] [--steps 3000] [--rounds 7] [--foreign N]

While N other processes count, it runs the first steps of each scene on one thread and on all, in turn, by the clock
on the wall, less the time of loading. It prints the medians. Nothing is gated: it prints what it has measured.
"""
import argparse
import multiprocessing
import os
import statistics
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def count():
    number = 0
    while True:
        number += 1


def seconds(voxmelt, scene, steps, threads):
    begin = time.monotonic()
    subprocess.run([voxmelt, "digest", scene, "--steps", str(steps), "--threads", str(threads), "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    return time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("voxmelt", nargs="?", default=ROOT / "build/release/app/voxmelt")
    parser.add_argument("--scenes", default="cello,goblet,lava")
    parser.add_argument("--steps", type=int, default=3000)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--foreign", type=int, default=os.cpu_count())
    options = parser.parse_args()

    every = os.cpu_count()
    others = [multiprocessing.Process(target=count, daemon=True) for _ in range(options.foreign)]
    for other in others:
        other.start()
    try:
        print(f"{options.foreign} foreign threads; medians of {options.rounds} rounds of {options.steps} steps, seconds")
        for scene in options.scenes.split(","):
            rounds = [[seconds(options.voxmelt, scene, options.steps, threads) - seconds(options.voxmelt, scene, 0, threads)
                       for threads in (1, every)] for _ in range(options.rounds)]
            one, several = (statistics.median(column) for column in zip(*rounds))
            print(f"{scene:12} 1 thread {one:6.3f}   {every} threads {several:6.3f}   {several / one:.2f} of one", flush=True)
    finally:
        for other in others:
            other.kill()


if __name__ == "__main__":
    main()
