#!/usr/bin/env python3
"""Runs that are killed by -9 at random moments, and resumed until they are done, give what the run gives that
nobody killed: frames, sheet, digest, ledgers and report. Nothing is left but the output.

  kill_test.py PROGRAM N [SEED]
"""
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())

# Heat moves and lets rays be cast anew, liquid flows in at a vent and leaves: every term of the ledgers moves.
# Hands change it meanwhile.
SCENE = """title = "killed"
[grid]
size = [64, 48, 64]
[run]
steps = 160
frame_every = 9
[[solid]]
shape = "box"
size = [28, 28, 28]
at = [32, 16, 32]
temperature = 0.48
[[inert]]
shape = "floor"
thickness = 2
[material]
melting_point = 0.5
latent_heat = 0.02
[heat]
gamma = 0.15
visibility_every = 7
[[heat_source]]
kind = "point"
at = [70, 60, 70]
power = 800
[[vent]]
at = [12, 40, 12]
radius = 3
rate = 0.2
[[drain]]
at = [3, 3, 3]
radius = 3
rate = 0.5
[[change]]
step = 31
do = ["heat_source.0.at 60 55 4", "vent.0.rate 0.4"]
[[change]]
step = 77
do = ["pour 40 40 40 4 0.9", "carve 30 20 30 5", "heat_source.add_sky 0.002"]
[[change]]
step = 120
do = ["vent.0.off", "heat.gamma 0.1", "heat_source.1.remove"]
[flow]
law = "LAW"
[camera]
width = 320
height = 240
"""
VISCOUS = "[flow.viscous]\nkappa = 0.1\n"
# What a run costs, and who runs it: not what it gives.
COSTS = ("seconds", "memory")
TRIED = ("implementation", "implementation_reason")  # by a trial; a run that died early makes another one
WHO = ("threads", "visibility")


def outcome(folder, changed):
    """Every file of the output by its bytes; of the report, what the run gives."""
    files = {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*")
             if p.is_file() and p.name != "last.vxc"}  # it says who ran, and for how long
    report = json.loads(files.pop("report.json"))
    for key in COSTS + TRIED + (WHO if changed else ()):
        del report[key]
    report.get("visibility", {}).pop("rays_cast", None)  # a resumed run casts anew what was known
    return files, report


def run(arguments, cwd, seconds=None):
    """Returns the exit code, and the last line it said; killed after so many seconds."""
    process = subprocess.Popen([PROGRAM, *arguments], cwd=cwd, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    try:
        said = process.communicate(timeout=seconds)[1]
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
        said = process.communicate()[1]
    return process.returncode, said.decode().strip()


def main():
    count = int(sys.argv[2])
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else random.SystemRandom().randrange(10**6)
    chance = random.Random(seed)
    print(f"seed {seed}")
    known = subprocess.run([PROGRAM, "list", "implementations"], capture_output=True, text=True, check=True).stdout
    implementations = [line.split()[0] for line in known.splitlines() if "not on this" not in line and not line.startswith("gpu:")]
    kills = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        whole, length = {}, {}
        for law in ("paper", "viscous"):
            (folder / f"{law}.toml").write_text(SCENE.replace("LAW", law) + (VISCOUS if law == "viscous" else ""))
            begin = time.monotonic()
            code, said = run(["run", f"{law}.toml", "--out", "whole", "--quiet"], folder)
            length[law] = time.monotonic() - begin
            assert code == 0, said
            whole[law] = [outcome(folder / "whole", changed) for changed in (False, True)]
            subprocess.run(["rm", "-r", "whole"], cwd=folder, check=True)
        for number in range(count):
            law = chance.choice(["paper", "viscous"])
            every = chance.choice(["1", "2", "5", "17", "1s"])
            changes = number % 4 == 0
            begin = ["run", f"{law}.toml", "--out", "out/killed", "--quiet", "--checkpoint-every", every]
            arguments, parts = begin, 0
            while True:
                # the last parts run to their end, else chance could kill for ever
                limit = chance.uniform(0, 1.2 * length[law]) if parts < 6 else None
                code, said = run(arguments, folder, limit)
                parts += 1
                if code == 0:
                    break
                if code == 2 and "there is no checkpoint" in said:  # it died before the first
                    arguments = begin
                    continue
                assert code == -signal.SIGKILL, f"run {number}: exit code {code}: {said}"
                kills += 1
                arguments = ["run", "--resume", "out/killed"]
                if changes:
                    arguments += ["--implementation", chance.choice(implementations),
                                  "--threads", str(chance.choice([1, 2, 3]))]
            left = sorted(p.name for p in (folder / "out").iterdir())
            assert left == ["killed"], f"run {number}: left over: {left}"
            files, report = outcome(folder / "out/killed", changes)
            expected_files, expected_report = whole[law][changes]
            assert sorted(files) == sorted(expected_files), f"run {number}: {sorted(set(files) ^ set(expected_files))}"
            for name, content in files.items():
                assert content == expected_files[name], f"run {number}: {name} differs"
            assert report == expected_report, f"run {number}: " + ", ".join(
                f"{key}: {report.get(key)} for {expected_report.get(key)}"
                for key in expected_report if report.get(key) != expected_report[key])
            subprocess.run(["rm", "-r", "out"], cwd=folder, check=True)
            print(f"run {number}: {law}, a checkpoint every {every}, {parts} parts"
                  f"{', by others' if changes else ''}: equal", flush=True)
    print(f"{count} runs, {kills} kills")
    assert kills > 0, "nothing was killed"


if __name__ == "__main__":
    main()
