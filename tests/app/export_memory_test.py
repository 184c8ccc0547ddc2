#!/usr/bin/env python3
"""An export takes little memory beside the run, whatever the size of the grid, which is nearly empty here. Its
checkpoint is small, too.

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
LARGEST_CHECKPOINT = 20_000_000


def peak(*arguments):
    process = subprocess.Popen([sys.argv[1], *arguments, "--quiet"], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0, arguments
    return usage.ru_maxrss


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
    for form in ["npy", "vti", "npz", "ply", *vdb]:
        out = Path(folder) / form
        above = peak("export", str(scene), "--steps", "1", "--format", form, "--out", str(out)) - run
        written = 0
        for file in out.iterdir():
            written += file.stat().st_size
            file.unlink()
        print(f"{form}: {written >> 20} MiB written, {above >> 10} MiB above the run's {run >> 10} MiB")
        fields = CELLS * 9  # three masks and three numbers; an image has them packed
        least, most = {"vti": (fields // 2000, fields // 100), "ply": (1, fields // 100), "vdb": (1, 1 << 20)}.get(form, (fields, fields + (1 << 20)))
        if above > MOST or not least <= written <= most:
            problems.append(f"{form}: at most {MOST >> 10} MiB of memory, {least} to {most} bytes written")
    checkpoint = checkpoint_of(scene, Path(folder) / "out")
    size = checkpoint.stat().st_size
    print(f"checkpoint: {size} bytes")
    subprocess.run([sys.argv[1], "info", checkpoint], check=True, stdout=subprocess.DEVNULL)
    if size > LARGEST_CHECKPOINT:
        problems.append(f"a checkpoint has at most {LARGEST_CHECKPOINT} bytes")
print("\n".join(problems))
sys.exit(1 if problems else 0)
