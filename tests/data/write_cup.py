#!/usr/bin/env python3
"""Writes the cup of the tests: as OBJ by itself, and in the other formats by programs that are not ours.

  write_cup.py        in tests/data, with Debian's package assimp-utils

All coordinates are multiples of 1/16 and have at most five digits, so that no format rounds them. z points up in
STL, as it does in models for printing; in the others y does.
"""
import math
import subprocess
import tempfile
from pathlib import Path

AROUND = 24
# Radius and height along the outline: the outer wall from below, the rim, the inner wall, and the middle of its ground.
OUTLINE = [(2.5, 0), (2.25, 0.5), (3, 3), (3.5, 6), (3.75, 8), (3.25, 8), (3, 6), (2.5, 3), (2, 1)]


def sixteenth(value):
    return round(value * 16) / 16


def cup():
    vertices, faces = [(0, 0, 0), (0, 1, 0)], []
    for radius, height in OUTLINE:
        for k in range(AROUND):
            turn = 2 * math.pi * k / AROUND
            vertices.append((sixteenth(radius * math.cos(turn)), height, sixteenth(-radius * math.sin(turn))))
    last = len(OUTLINE) - 1
    at = lambda ring, k: 2 + ring * AROUND + k % AROUND
    for k in range(AROUND):
        faces.append((0, at(0, k + 1), at(0, k)))
        faces.append((1, at(last, k), at(last, k + 1)))
        for ring in range(last):
            a, b, c, d = at(ring, k), at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)
            faces += [(a, b, c), (a, c, d)]
    # The handle is a bent beam. Its ends lie within the wall of the cup.
    path = [(3, 5.5), (4.5, 6), (5.5, 4.5), (4.5, 2.5), (2.75, 2.25)]
    first = len(vertices)
    for i, (x, y) in enumerate(path):
        before, after = path[max(i - 1, 0)], path[min(i + 1, len(path) - 1)]
        dx, dy = after[0] - before[0], after[1] - before[1]
        nx, ny = -dy / math.hypot(dx, dy) * 0.5, dx / math.hypot(dx, dy) * 0.5
        for out, z in ((1, 0.5), (1, -0.5), (-1, -0.5), (-1, 0.5)):
            vertices.append((sixteenth(x + out * nx), sixteenth(y + out * ny), z))
    corner = lambda i, k: first + 4 * i + k % 4
    for i in range(len(path) - 1):
        for k in range(4):
            a, b, c, d = corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k)
            faces += [(a, c, b), (a, d, c)]
    end = len(path) - 1
    faces += [(corner(0, 0), corner(0, 1), corner(0, 2)), (corner(0, 0), corner(0, 2), corner(0, 3)),
              (corner(end, 0), corner(end, 2), corner(end, 1)), (corner(end, 0), corner(end, 3), corner(end, 2))]
    return vertices, faces


def text_of(vertices, faces):
    text = "o cup\n" + "".join(f"v {x:g} {y:g} {z:g}\n" for x, y, z in vertices)
    return text + "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)


def main():
    vertices, faces = cup()
    folder = Path(__file__).resolve().parent
    text = text_of(vertices, faces)
    (folder / "cup.obj").write_text(text)
    with tempfile.TemporaryDirectory() as other:
        standing = Path(other) / "cup.obj"
        standing.write_text(text_of([(x, -z, y) for x, y, z in vertices], faces))
        for form, name in (("stlb", "cup.stl"), ("stl", "cup_text.stl"), ("plyb", "cup.ply"), ("ply", "cup_text.ply"),
                           ("glb2", "cup.glb"), ("gltf2", "cup.gltf")):
            source = standing if name.endswith("stl") else folder / "cup.obj"
            subprocess.run(["assimp", "export", source, folder / name, f"-f{form}"], check=True, stdout=subprocess.DEVNULL)


main()
