"""Runs the program in a folder of its own, for the tests of its commands."""
import subprocess
import sys
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())

SMALL = """title = "small"
[grid]
size = [12, 10, 12]
[run]
steps = 6
frame_every = 3
[[solid]]
shape = "box"
size = [4, 4, 4]
at = [6, 4, 6]
temperature = 0.49
[[inert]]
shape = "floor"
thickness = 2
[material]
melting_point = 0.5
[heat]
gamma = 0.15
visibility_every = 8
[[heat_source]]
kind = "point"
at = [14, 12, 14]
power = 30
[flow]
law = "paper"
[camera]
width = 64
height = 48
"""


def voxmelt(*arguments, cwd=None, env=None, timeout=120):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, env=env, capture_output=True, text=True,
                          timeout=timeout)


def write(folder, text, name="scene.toml"):
    path = Path(folder) / name
    path.write_text(text)
    return path
