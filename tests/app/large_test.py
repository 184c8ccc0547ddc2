#!/usr/bin/env python3
"""A lava scene of 1024 x 256 x 1024 cells: memory follows what is not empty, drawn or not, and the bits are the
reference's.

  large_test.py VOXMELT
"""
import resource
import subprocess
import sys
import tempfile

SCENE, STEPS, MOST = "scenes/large/lava_1024.toml", "6", 2_000_000  # KiB


def digest(implementation):
    result = subprocess.run([sys.argv[1], "digest", SCENE, "--steps", STEPS, "--quiet", "--implementation", implementation],
                            check=True, capture_output=True, text=True).stdout.strip()
    return result, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss


fast, peak = digest("auto")
print(f"auto: {fast}, peak {peak // 1024} MiB")
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], "render", SCENE, "--steps", STEPS, "--quiet", "--size", "160x120", "--out", f"{folder}/picture.png"],
                   check=True)
drawn = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss  # of the larger of the two
print(f"drawn: peak {drawn // 1024} MiB")
reference, _ = digest("reference")
problems = []
if peak > MOST:
    problems.append(f"peak memory {peak} KiB, at most {MOST}")
if drawn > MOST:
    problems.append(f"peak memory of a picture {drawn} KiB, at most {MOST}")
if fast != reference:
    problems.append(f"reference: {reference}")
if " liquid 0" in fast:
    problems.append("nothing flows: the test would prove nothing")
print("\n".join(problems) if problems else "as the reference, in little memory")
sys.exit(1 if problems else 0)
