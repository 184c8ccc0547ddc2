#!/usr/bin/env python3
"""A device has the approved digest of every committed scene (digests.json).

  device_digest_test.py VOXMELT STEPS           every scene, after so many steps, by the device gpu:0
  device_digest_test.py VOXMELT STEPS SCENE...  these alone

Standard error says which scene is run, and how long the last one took. Without a device the exit code is 77.
"""
import json
import subprocess
import sys
import time
from pathlib import Path

APPROVED = Path(__file__).with_name("digests.json")
SKIPPED = 77


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def main():
    voxmelt, steps, *scenes = sys.argv[1:]
    if "gpu:0" not in output(voxmelt, "list", "implementations"):
        print("there is no device here")
        return SKIPPED
    approved = json.loads(APPROVED.read_text())
    scenes = scenes or sorted(approved)
    wrong = []
    for number, scene in enumerate(scenes, 1):
        begin = time.monotonic()
        print(f"{number} of {len(scenes)}: {scene} ...", end=" ", file=sys.stderr, flush=True)
        said = output(voxmelt, "digest", scene, "--quiet", "--implementation", "gpu:0", "--steps", steps).splitlines()
        if approved[scene][steps] != said[-1]:
            wrong.append(f"{scene}: approved {approved[scene][steps]}\n  the device {said[-1]}")
        print(f"{time.monotonic() - begin:.1f} s", file=sys.stderr)
    print("\n".join(wrong) if wrong else f"{len(scenes)} scenes have their digest after {steps} steps")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
