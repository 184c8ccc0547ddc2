#!/usr/bin/env python3
"""An export takes little memory beside the run, whatever the size of the grid, which is nearly empty here.

  export_memory_test.py VOXMELT
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SCENE = '[grid]\nsize = [512, 128, 256]\n[[solid]]\nshape = "box"\nsize = [4, 4, 4]\nat = [256, 60, 128]\n'
MOST = 32 << 10  # KiB above the run; the fields have 144 MiB


def peak(*arguments):
    process = subprocess.Popen([sys.argv[1], *arguments, "--quiet"], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0, arguments
    return usage.ru_maxrss


with tempfile.TemporaryDirectory() as folder:
    scene = Path(folder) / "scene.toml"
    scene.write_text(SCENE)
    run = peak("digest", str(scene), "--steps", "1")
    problems = []
    for form in ("npy", "vti"):
        out = Path(folder) / form
        above = peak("export", str(scene), "--steps", "1", "--format", form, "--out", str(out)) - run
        written = sum(file.stat().st_size for file in out.iterdir())
        print(f"{form}: {written >> 20} MiB written, {above >> 10} MiB above the run")
        if above > MOST or written < 512 * 128 * 256 * 9:
            problems.append(f"{form}: at most {MOST >> 10} MiB of memory, all of the fields written")
print("\n".join(problems))
sys.exit(1 if problems else 0)
