#!/usr/bin/env python3
"""An export takes little memory beside the run, whatever the size of the grid, which is nearly empty here. Its
checkpoint is small, too. OpenVDB's helper takes little also where every second cell is full.

  export_memory_test.py VOXMELT [--large]
"""
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

LARGE = "--large" in sys.argv
SIZE = (1024, 256, 1024) if LARGE else (512, 128, 256)
CELLS = SIZE[0] * SIZE[1] * SIZE[2]
SCENE = f'[grid]\nsize = {list(SIZE)}\n[[solid]]\nshape = "box"\nsize = [4, 4, 4]\nat = [256, 60, 128]\n'
MOST = (256 if LARGE else 32) << 10  # KiB above the run; the fields have 2304 or 144 MiB
MOST_WITH_HELPER = (256 if LARGE else 64) << 10  # OpenVDB itself has some 35 MiB
LARGEST_CHECKPOINT = 20_000_000


def peak(*arguments):
    process = subprocess.Popen([sys.argv[1], *arguments, "--quiet"], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0, arguments
    return usage.ru_maxrss


# Stands for the helper, and notes what it takes.
HELPER = """#!{python}
import os, sys
process = os.posix_spawn({program!r}, [{program!r}, *sys.argv[1:]], os.environ)
_, status, usage = os.wait4(process, 0)
open({note!r}, "w").write(str(usage.ru_maxrss))
sys.exit(os.waitstatus_to_exitcode(status))
"""


def helper_in(folder):
    """A file to which the helper's memory is noted, in KiB."""
    note, stand_in = folder / "helper_took", folder / "helper"
    program = Path(sys.argv[1]).resolve().parent / "voxmelt-vdb"
    stand_in.write_text(HELPER.format(python=sys.executable, program=str(program), note=str(note)))
    stand_in.chmod(0o755)
    os.environ["VOXMELT_VDB"] = str(stand_in)
    return note


def dense_scene(folder):
    """Every second cell along x is full, so no brick is like another."""
    head = f"{{'descr': '|b1', 'fortran_order': False, 'shape': {SIZE[::-1]}, }}"
    head += " " * (-(len(head) + 11) % 64) + "\n"
    with open(folder / "cells.npy", "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head.encode())
        for _ in range(SIZE[2]):
            file.write(bytes([1, 0]) * (SIZE[0] * SIZE[1] // 2))
    scene = folder / "dense.toml"
    scene.write_text(f'[grid]\nsize = {list(SIZE)}\n[[solid]]\nshape = "volume"\nfile = "cells.npy"\n')
    return scene


def checkpoint_of(scene, out):
    """Of a run that a signal ends behind its first checkpoint."""
    process = subprocess.Popen([sys.argv[1], "run", scene, "--out", out, "--steps", "4000000", "--frame-every", "0", "--size",
                                "64x48", "--checkpoint-every", "1", "--quiet"], stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 300
    while not list(out.parent.glob(f"{out.name}.partial-*/checkpoints/*.vxc")) and time.monotonic() < deadline:
        time.sleep(0.1)
    process.send_signal(signal.SIGTERM)
    assert process.wait(600) == 4, process.returncode
    return max((out / "checkpoints").iterdir())


with tempfile.TemporaryDirectory() as folder:
    scene = Path(folder) / "scene.toml"
    scene.write_text(SCENE)
    run = peak("digest", str(scene), "--steps", "1")
    problems = []
    vdb = ["vdb"] if "OpenVDB: found" in subprocess.run([sys.argv[1], "--version"], capture_output=True, text=True).stdout else []
    note = helper_in(Path(folder)) if vdb else None
    for form in ["npy", "vti", "npz", "nrrd", "ply", *vdb]:
        out = Path(folder) / form
        above = peak("export", str(scene), "--steps", "1", "--format", form, "--out", str(out)) - run
        most_above = MOST
        if form == "vdb":
            above, most_above = above + int(note.read_text()), MOST_WITH_HELPER
        written = 0
        for file in out.iterdir():
            written += file.stat().st_size
            file.unlink()
        print(f"{form}: {written >> 20} MiB written, {above >> 10} MiB above the run's {run >> 10} MiB")
        fields = CELLS * 9  # three masks and three numbers; an image has them packed
        least, most = {"vti": (fields // 2000, fields // 100), "ply": (1, fields // 100), "vdb": (1, 1 << 20)}.get(form, (fields, fields + (1 << 20)))
        if above > most_above or not least <= written <= most:
            problems.append(f"{form}: at most {most_above >> 10} MiB of memory, {least} to {most} bytes written")
    if vdb:
        peak("export", str(dense_scene(Path(folder))), "--steps", "0", "--format", "vdb", "--out", str(Path(folder) / "dense"))
        took = int(note.read_text())
        print(f"vdb of a grid that is half full: {(Path(folder) / 'dense/volume.vdb').stat().st_size >> 20} MiB written, {took >> 10} MiB for the helper")
        if took > MOST_WITH_HELPER:
            problems.append(f"a dense vdb: at most {MOST_WITH_HELPER >> 10} MiB")
    checkpoint = checkpoint_of(scene, Path(folder) / "out")
    size = checkpoint.stat().st_size
    print(f"checkpoint: {size} bytes")
    subprocess.run([sys.argv[1], "info", checkpoint], check=True, stdout=subprocess.DEVNULL)
    if size > LARGEST_CHECKPOINT:
        problems.append(f"a checkpoint has at most {LARGEST_CHECKPOINT} bytes")
print("\n".join(problems))
sys.exit(1 if problems else 0)
