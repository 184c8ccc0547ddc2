#!/usr/bin/env python3
"""Ten million triangles in a binary STL: under 60 seconds and 2 GB on one core, and the same voxels as the shape has
without a mesh.

  large_mesh_test.py VOXMELT
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SECONDS, MOST = 60, 2_000_000  # of one core, and KiB
PARTS = 913  # of an edge: 12 x 913 x 913 triangles
PYTHON = next((python for python in (sys.executable, "/usr/bin/python3") if shutil.which(python)
               and subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode == 0), None)

HEAD = "[grid]\nsize = [56, 48, 40]\n[[solid]]\n"
MESH = HEAD + 'shape = "mesh"\nfile = "box.stl"\nup = "z"\nscale = 1\nat = [28.25, 4, 20]\n'
BOX = HEAD + 'shape = "box"\nsize = [40, 36, 30]\nat = [28.25, 22, 20]\n'

# The six sides of a box of 40 x 30 x 36, z up. Vertices on an edge are the same numbers on both of its sides.
WRITER = """
import itertools, numpy as n
parts = int(%d)
rows = [n.linspace(0, side, parts + 1).astype("<f4") for side in (40, 30, 36)]
written = n.zeros(12 * parts * parts, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
places = itertools.count()
for axis in range(3):
    u, v = (axis + 1) %% 3, (axis + 2) %% 3
    for end in (0, -1):
        at = n.zeros((parts + 1, parts + 1, 3), "<f4")
        at[..., axis], at[..., u], at[..., v] = rows[axis][end], rows[u][:, None], rows[v][None, :]
        a, b, c, d = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
        for corners in ([a, b, c], [a, c, d]):
            k = next(places) * parts * parts
            corners = n.stack(corners if end else corners[::-1], 2)
            written["corners"][k:k + parts * parts] = corners.reshape(-1, 3, 3)
with open("box.stl", "wb") as file:
    file.write(bytes(80) + len(written).to_bytes(4, "little"))
    written.tofile(file)
""" % PARTS


def digest(folder, text):
    (folder / "scene.toml").write_text(text)
    child = subprocess.Popen([Path(sys.argv[1]).resolve(), "digest", "scene.toml", "--steps", "0", "--threads", "1"], cwd=folder,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = child.stdout.read()
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0, said
    return said, used.ru_utime + used.ru_stime, used.ru_maxrss


if PYTHON is None:
    print("skipped: no NumPy here: apt-get install python3-numpy")
    sys.exit(77)
with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    subprocess.run([PYTHON, "-c", WRITER], cwd=folder, check=True)
    triangles = ((folder / "box.stl").stat().st_size - 84) // 50
    wanted = digest(folder, BOX)[0]
    said, seconds, peak = digest(folder, MESH)
print(f"{triangles} triangles: {seconds:.1f} s of one core, {peak / 1e6:.2f} GB\n{said}", end="")
problems = []
if triangles < 10_000_000 or " solid 0 " in said:
    problems.append("the test would prove nothing")
if said != wanted:
    problems.append(f"without a mesh it is {wanted}")
if seconds > SECONDS or peak > MOST:
    problems.append(f"at most {SECONDS} s and {MOST} KiB")
print("\n".join(problems))
sys.exit(1 if problems else 0)
