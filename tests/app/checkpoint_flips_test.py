#!/usr/bin/env python3
"""A checkpoint with one bit flipped is refused by its name: `voxmelt info`, and `voxmelt run --resume`.

  checkpoint_flips_test.py VOXMELT COUNT [SEED]
"""
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from program import PROGRAM, SMALL, write

SECONDS = 2  # of processor time: other programs do not count
COUNT, SEED = int(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 29


def interrupted_run(folder):
    """Returns its output, with its newest checkpoint alone."""
    scene = write(folder, SMALL)
    process = subprocess.Popen([PROGRAM, "run", scene, "--out", folder / "kept", "--steps", "4000000", "--frame-every", "0",
                                "--checkpoint-every", "5", "--quiet"], stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 60
    while len(list(folder.glob("kept.partial-*/checkpoints/*.vxc"))) < 2 and time.monotonic() < deadline:
        time.sleep(0.05)
    process.send_signal(signal.SIGTERM)
    assert process.wait(60) == 4, process.returncode
    older, newest = sorted((folder / "kept/checkpoints").iterdir())
    older.unlink()
    return folder / "kept", newest


def files_in(folder):
    return sorted((p, p.stat().st_size) for p in folder.rglob("*"))


def problem_with(arguments, file, folder):
    before, begin = files_in(folder), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begin
    if result.returncode != 2 or seconds > SECONDS or result.stdout or files_in(folder) != before:
        return f"code {result.returncode} after {seconds:.2f} s, {result.stdout + result.stderr!r}"
    if len(result.stderr.splitlines()) != 1 or f"{file}: error: " not in result.stderr:
        return f"not one line that names it: {result.stderr!r}"
    return None


with tempfile.TemporaryDirectory() as folder:
    folder = Path(folder)
    out, file = interrupted_run(folder)
    whole = file.read_bytes()
    chance, problems, commands = random.Random(SEED), [], {"info": 0, "run": 0}
    # Every command would load it if it were whole.
    subprocess.run([PROGRAM, "info", file], check=True, stdout=subprocess.DEVNULL)
    for number, bit in enumerate(chance.sample(range(8 * len(whole)), COUNT)):
        data = bytearray(whole)
        data[bit // 8] ^= 1 << bit % 8
        file.write_bytes(data)
        arguments = ["info", file] if number % 2 else ["run", "--resume", out]
        commands[arguments[0]] += 1
        if problem := problem_with(arguments, file, folder):
            problems.append(f"bit {bit}, {arguments[0]}: {problem}")
    file.write_bytes(whole)
    assert problem_with(["info", file], file, folder), "the file as it was is refused, too"
print(f"seed {SEED}: {COUNT} of {8 * len(whole)} bits flipped, {commands['info']} asked by info, {commands['run']} resumed; "
      f"{len(problems)} not refused as they should be")
print("\n".join(problems[:20]))
sys.exit(1 if problems else 0)
