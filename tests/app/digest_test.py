#!/usr/bin/env python3
"""The reference, the fastest implementation and the oracle agree on every committed scene, and on the digests written down in digests.json.

  digest_test.py VOXMELT ORACLE STEPS...            check
  digest_test.py VOXMELT ORACLE STEPS... --approve  write digests.json, only where both agree
  digest_test.py VOXMELT ORACLE STEPS... --scene NAME [--approve]    this scene alone

Standard error says which scene is run, and how long the last one took.
"""
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

APPROVED = Path(__file__).with_name("digests.json")


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def told(steps, *command):
    """What one run says of each of these numbers of steps."""
    words = ["--steps", str(max(steps)), "--every", str(math.gcd(*steps))]
    said = output(*command, *words).splitlines()
    return {n: line for n in steps for line in said if line.startswith(f"step {n} ")}


def main():
    arguments = [a for a in sys.argv[1:] if a != "--approve"]
    all_scenes = scenes = sorted(p.stem for p in Path("scenes").glob("*.toml"))
    if "--scene" in arguments:
        at = arguments.index("--scene")
        scenes = [scene for scene in scenes if scene == arguments[at + 1]]
        del arguments[at:at + 2]
    voxmelt, oracle, steps = arguments[0], arguments[1], [int(a) for a in arguments[2:]]
    approved = json.loads(APPROVED.read_text()) if APPROVED.exists() else {}
    problems, compared, found = [], 0, {}
    for number, scene in enumerate(scenes, 1):
        begin = time.monotonic()
        print(f"{number} of {len(scenes)}: {scene} ...", end=" ", file=sys.stderr, flush=True)
        with tempfile.TemporaryDirectory() as folder:
            start = f"{folder}/start"
            output(voxmelt, "export", scene, "--steps", "0", "--out", start, "--quiet")
            references, fastest = (told(steps, voxmelt, "digest", scene, "--quiet", "--implementation", i)
                                  for i in ("reference", "auto"))
            judges = told(steps, oracle, start)
            for n in steps:
                mine, fast, judge = references[n], fastest[n], judges[n]
                if fast != mine:
                    problems.append(f"{scene}, {n} steps:\n  reference {mine}\n  auto      {fast}")
                compared += 1
                if mine != judge:
                    problems.append(f"{scene}, {n} steps:\n  voxmelt {mine}\n  oracle  {judge}")
                if not mine == fast == judge:  # never approved
                    continue
                found.setdefault(scene, {})[str(n)] = mine
                known = approved.get(scene, {}).get(str(n))
                if known != mine and "--approve" not in sys.argv:
                    problems.append(f"{scene}, {n} steps: both agree on\n  {mine}\n  but approved is\n  {known}")
        print(f"{time.monotonic() - begin:.1f} s", file=sys.stderr, flush=True)
    if compared < (1 if "--scene" in sys.argv else 2) * len(steps):
        problems.append(f"only {compared} comparisons: scenes/ has no such scene")
    if "--approve" in sys.argv:
        for scene, lines in found.items():
            approved.setdefault(scene, {}).update(lines)
        approved = {scene: approved[scene] for scene in all_scenes if scene in approved}
        APPROVED.write_text(json.dumps(approved, indent=1, sort_keys=True) + "\n")
    print("\n".join(problems) if problems else f"{compared} digests agree")
    sys.exit(1 if problems else 0)


main()
