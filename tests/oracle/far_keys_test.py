#!/usr/bin/env python3
"""The program and the oracle agree on sources with keys far apart, strong and late: on both sides of the steps
from which (b - a)(s - a.step) exceeds 64 bits; and on a sun that turns back.

  far_keys_test.py VOXMELT ORACLE SCENE STEPS...
"""
import subprocess
import sys
import tempfile


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def main():
    voxmelt, oracle, scene, *counts = sys.argv[1:]
    found = set()
    with tempfile.TemporaryDirectory() as folder:
        start = f"{folder}/start"
        output(voxmelt, "export", scene, "--steps", "0", "--out", start, "--quiet")
        for steps in counts:
            mine = output(voxmelt, "digest", scene, "--steps", steps, "--quiet")
            judge = output(oracle, start, "--steps", steps)
            if mine != judge:
                sys.exit(f"{steps} steps:\n  voxmelt {mine}\n  oracle  {judge}")
            found.add(mine.split()[3])
    if len(found) < len(counts):
        sys.exit("some of these states are the same: the source shows too little in them")
    print(f"{len(found)} different states agree")


main()
