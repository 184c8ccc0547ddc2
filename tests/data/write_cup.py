#!/usr/bin/env python3
"""Writes the cup of the tests: as OBJ and MagicaVoxel by itself, and in the other formats by programs that are not ours.

  write_cup.py        in tests/data, with Debian's packages assimp-utils and python3-openvdb

All coordinates are multiples of 1/16 and have at most five digits, so that no format rounds them. z points up in
STL, as it does in models for printing; in the others y does.
"""
import math
import struct
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


def crossings(vertices, faces, x, z):
    """Where a vertical line passes the surface, from below: height, and whether it enters (1) or leaves (-1)."""
    found = []
    for face in faces:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (vertices[i] for i in face)
        u, v, w = ((bx - x) * (cz - z) - (bz - z) * (cx - x), (cx - x) * (az - z) - (cz - z) * (ax - x), (ax - x) * (bz - z) - (az - z) * (bx - x))
        if (u > 0 and v > 0 and w > 0) or (u < 0 and v < 0 and w < 0):
            found.append(((u * ay + v * by + w * cy) / (u + v + w), 1 if u + v + w > 0 else -1))
    return sorted(found)


def voxels_of(vertices, faces, side=156):
    """A voxel is filled if the surface winds around its middle. y points up. Without a scene the cup is 96 cells wide. A voxel
    for each cell would be stairs, and two of them are too; but 13 for 8 cells come near to what a mesh gives."""
    low, high = ([end(v[axis] for v in vertices) for axis in range(3)] for end in (min, max))
    to_unit = side / max(h - l for l, h in zip(low, high))
    nx, ny, nz = (math.ceil((h - l) * to_unit) for l, h in zip(low, high))
    voxels, middle = [], (low[2] + high[2]) / 2  # the voxels reach as far beyond the cup in front as behind
    for i in range(nx):
        for k in range(nz):
            # a little beside the middle, where no corner of the cup lies
            found = crossings(vertices, faces, low[0] + (i + 0.5003) / to_unit, middle + (k + 0.5007 - nz / 2) / to_unit)
            for j in range(ny):
                if sum(way for height, way in found if height < low[1] + (j + 0.5) / to_unit) != 0:
                    voxels.append((i, j, k))
    return (nx, ny, nz), voxels


def vox(size, voxels):
    """MagicaVoxel's file. z points up."""
    nx, ny, nz = size
    voxels = [bytes((x, nz - 1 - z, y, 1)) for x, y, z in voxels]
    chunk = lambda name, content, children=b"": name + struct.pack("<II", len(content), len(children)) + content + children
    body = chunk(b"SIZE", struct.pack("<3I", nx, nz, ny)) + chunk(b"XYZI", struct.pack("<I", len(voxels)) + b"".join(voxels))
    return b"VOX " + struct.pack("<I", 150) + chunk(b"MAIN", b"", body)


def vdb(voxels, file):
    """A fog volume of OpenVDB, by the Python of Debian's package."""
    program = ("import ast, sys, pyopenvdb as v\ngrid = v.FloatGrid()\ngrid.name, grid.gridClass = 'cup', v.GridClass.FOG_VOLUME\n"
               "values = grid.getAccessor()\nfor at in ast.literal_eval(sys.stdin.read()): values.setValueOn(at, 1.0)\n"
               "grid.prune()\nv.write(sys.argv[1], grids=[grid])\n")
    subprocess.run(["/usr/bin/python3", "-c", program, file], input=repr(voxels), text=True, check=True)


def main():
    vertices, faces = cup()
    folder = Path(__file__).resolve().parent
    text = text_of(vertices, faces)
    (folder / "cup.obj").write_text(text)
    size, voxels = voxels_of(vertices, faces)
    (folder / "cup.vox").write_bytes(vox(size, voxels))
    vdb(voxels, folder / "cup.vdb")
    with tempfile.TemporaryDirectory() as other:
        standing = Path(other) / "cup.obj"
        standing.write_text(text_of([(x, -z, y) for x, y, z in vertices], faces))
        for form, name in (("stlb", "cup.stl"), ("stl", "cup_text.stl"), ("plyb", "cup.ply"), ("ply", "cup_text.ply"),
                           ("glb2", "cup.glb"), ("gltf2", "cup.gltf")):
            source = standing if name.endswith("stl") else folder / "cup.obj"
            subprocess.run(["assimp", "export", source, folder / name, f"-f{form}"], check=True, stdout=subprocess.DEVNULL)


main()
