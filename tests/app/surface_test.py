#!/usr/bin/env python3
"""The surface of a state as PLY, GLB, STL and OBJ: closed, the same in all of them, and around the right cells.

The readers here know the formats and nothing of voxmelt. Assimp and the scene reader read the files, too.

  surface_test.py PROGRAM
"""
import json
import math
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
from collections import Counter
from pathlib import Path

from program import SMALL, voxmelt, write

FORMATS = ("ply", "glb", "stl", "obj")
ASSIMP = shutil.which("assimp")
ONE_CELL = SMALL.replace("size = [4, 4, 4]\nat = [6, 4, 6]", "size = [1, 1, 1]\nat = [6.5, 4.5, 6.5]")
MOLTEN = 60


def npy(file):
    data = file.read_bytes()
    header = 10 + struct.unpack("<H", data[8:10])[0]
    return data[header:] if b"|u1" in data[:header] else struct.unpack(f"<{(len(data) - header) // 2}H", data[header:])


def read_ply(data):
    head, body = data.split(b"end_header\n", 1)
    vertices, faces = (int(re.search(rf"element {kind} (\d+)".encode(), head)[1]) for kind in ("vertex", "face"))
    points = [struct.unpack_from("<fffHBB", body, 16 * i) for i in range(vertices)]
    triangles = [struct.unpack_from("<BIII", body, 16 * vertices + 13 * i) for i in range(faces)]
    assert len(body) == 16 * vertices + 13 * faces and all(t[0] == 3 for t in triangles)
    return [p[:3] for p in points], [t[1:] for t in triangles], [p[3:] for p in points]


def read_glb(data):
    magic, version, size, head_size, kind = struct.unpack_from("<4sII I4s", data)
    assert (magic, version, size, kind) == (b"glTF", 2, len(data), b"JSON")
    head = json.loads(data[20:20 + head_size])
    body_size, kind = struct.unpack_from("<I4s", data, 20 + head_size)
    body = data[28 + head_size:]
    assert kind == b"BIN\0" and body_size == len(body) == head["buffers"][0]["byteLength"] and head_size % 4 == 0

    def numbers(accessor):
        accessor = head["accessors"][accessor]
        view = head["bufferViews"][accessor["bufferView"]]
        count = accessor["count"] * {"VEC3": 3, "SCALAR": 1}[accessor["type"]]
        assert view["byteLength"] == 4 * count
        return struct.unpack_from(f"<{count}{'f' if accessor['componentType'] == 5126 else 'I'}", body, view["byteOffset"])

    mesh = head["meshes"][0]["primitives"][0]
    places, indices = numbers(mesh["attributes"]["POSITION"]), numbers(mesh["indices"])
    points = list(zip(*[iter(places)] * 3))
    bounds = head["accessors"][mesh["attributes"]["POSITION"]]
    for i in range(3):
        assert (bounds["min"][i], bounds["max"][i]) == (min(p[i] for p in points), max(p[i] for p in points))
    made_of = zip(*(map(int, numbers(mesh["attributes"][name])) for name in ("_HEAT", "_MATERIAL", "_LIQUID")))
    return points, list(zip(*[iter(indices)] * 3)), list(made_of)


def read_stl(data):
    count, = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count and not data.startswith(b"solid")
    points, numbers, triangles = [], {}, []
    for i in range(count):
        normal, corners = struct.unpack_from("<3f", data, 84 + 50 * i), struct.unpack_from("<9f", data, 96 + 50 * i)
        corners = [corners[k:k + 3] for k in (0, 3, 6)]
        area = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
        assert all(abs(n * math.hypot(*area) - a) < 1e-6 for n, a in zip(normal, area))
        for corner in corners:
            if corner not in numbers:
                numbers[corner] = len(points)
                points.append(corner)
        triangles.append(tuple(numbers[corner] for corner in corners))
    return points, triangles, None


def read_obj(data):
    lines = [line.split() for line in data.decode("ascii").splitlines()]
    single = lambda word: struct.unpack("<f", struct.pack("<f", float(word)))[0]  # noqa: E731
    return ([tuple(map(single, line[1:])) for line in lines if line[0] == "v"],
            [tuple(int(word) - 1 for word in line[1:]) for line in lines if line[0] == "f"], None)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def windings(points, triangles, at):
    """How often the surface winds around a point: the sum of its solid angles over 4 pi."""
    angle = 0
    for triangle in triangles:
        a, b, c = (minus(points[i], at) for i in triangle)
        la, lb, lc = (math.hypot(*v) for v in (a, b, c))
        angle += 2 * math.atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la)
    return angle / (4 * math.pi)


def volume(points, triangles):
    return sum(dot(points[a], cross(points[b], points[c])) for a, b, c in triangles) / 6


READERS = {"ply": read_ply, "glb": read_glb, "stl": read_stl, "obj": read_obj}


class Surface(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def export(self, scene, steps, form):
        result = voxmelt("export", scene, "--steps", steps, "--format", form, "--out", form, "--quiet", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.folder / form

    def surfaces(self, scene, steps):
        for form in FORMATS:
            yield form, READERS[form]((self.export(scene, steps, form) / f"surface.{form}").read_bytes())

    def closed(self, triangles):
        edges = Counter((t[i], t[(i + 1) % 3]) for t in triangles for i in range(3))
        self.assertEqual(set(edges.values()), {1}, "an edge is used twice in one direction")
        self.assertEqual({(b, a) for a, b in edges}, set(edges), "an edge has one side")

    # Half a cell around a middle: of the 24 tetrahedra there, of a sixth of a cell each, what lies nearer.
    def test_one_cell_computed_by_hand(self):
        write(self.folder, ONE_CELL)
        self.assertEqual(sum(npy(self.export("scene.toml", 0, "npy") / "solid.npy")), 1)
        for form, (points, triangles, made_of) in self.surfaces("scene.toml", 0):
            self.assertEqual((len(points), len(triangles)), (14, 24), form)
            self.closed(triangles)
            self.assertAlmostEqual(volume(points, triangles), 4 * ((4096 - 2047.5) / 4096) ** 3, places=5)
            for axis, middle in enumerate((6.5, 4.5, 6.5)):
                self.assertAlmostEqual(sum(p[axis] for p in points) / 14, middle, places=5)
            if made_of:
                self.assertEqual(set(made_of), {(round(0.49 * 65535), 0, 0)})

    def test_molten_matter_is_the_same_in_all_formats(self):
        write(self.folder, SMALL)
        fields = {name: npy(self.export("scene.toml", MOLTEN, "npy") / f"{name}.npy") for name in ("solid", "liquid", "amount", "heat")}
        matter = [s | l for s, l in zip(fields["solid"], fields["liquid"])]
        self.assertGreater(sum(fields["liquid"]), 20)
        inside = {(i % 12, i // 12 % 10, i // 120) for i, a in enumerate(fields["amount"]) if matter[i] and a >= 2048}
        first = None
        for form, (points, triangles, made_of) in self.surfaces("scene.toml", MOLTEN):
            self.closed(triangles)
            shape = sorted(tuple(sorted(points[i] for i in t)) for t in triangles)
            first = first or shape
            self.assertEqual(shape, first, form)
            if form != "ply":
                continue
            near = {(x + dx, y, z) for x, y, z in inside for dx in (-1, 0, 1)}
            for x, y, z in sorted(near):
                self.assertAlmostEqual(windings(points, triangles, (x + 0.5, y + 0.5, z + 0.5)), (x, y, z) in inside, places=3)
            heats = {(fields["heat"][x + 12 * y + 120 * z], 0, fields["liquid"][x + 12 * y + 120 * z]) for x, y, z in inside}
            self.assertLessEqual(set(made_of), heats)
            self.assertEqual({m[2] for m in made_of}, {fields["liquid"][x + 12 * y + 120 * z] for x, y, z in inside})

    def test_materials_are_told(self):
        write(self.folder, SMALL.replace("temperature = 0.49", 'temperature = 0.49\nmaterial = "nut"') +
              '[[materials]]\nname = "nut"\nmelting_point = 1\n')
        for form, (_, _, made_of) in self.surfaces("scene.toml", 0):
            if made_of:
                self.assertEqual({m[1] for m in made_of}, {1}, form)

    def test_no_matter_is_no_error(self):
        write(self.folder, SMALL.replace("size = [4, 4, 4]\nat = [6, 4, 6]", "size = [4, 4, 4]\nat = [60, 4, 6]"))
        for form in FORMATS:
            self.assertTrue((self.export("scene.toml", 0, form) / f"surface.{form}").is_file())

    def test_scenes_take_them(self):
        write(self.folder, SMALL)
        cells = sum(npy(self.export("scene.toml", 0, "npy") / "solid.npy"))
        for form in FORMATS:
            self.export("scene.toml", 0, form)
            write(self.folder, '[grid]\nsize = [12, 10, 12]\n[[solid]]\nshape = "mesh"\nscale = 1\nat = [6, 2, 6]\n'
                               f'file = "{form}/surface.{form}"\n', "again.toml")
            result = voxmelt("digest", "again.toml", "--steps", 0, cwd=self.folder)
            self.assertEqual((result.returncode, result.stderr), (0, ""), form)
            self.assertEqual(int(result.stdout.split()[7]), cells, form)

    @unittest.skipUnless(ASSIMP, "no assimp here: apt-get install assimp-utils")
    def test_assimp_reads_them(self):
        write(self.folder, SMALL)
        for form in FORMATS:
            file = self.export("scene.toml", MOLTEN, form) / f"surface.{form}"
            points, triangles, _ = READERS[form](file.read_bytes())
            said = subprocess.run([ASSIMP, "info", file], capture_output=True, text=True, check=True).stdout
            self.assertIn(str(len(triangles)), re.search(r"Faces:\s*(\d+)", said)[0], said)
            low = re.search(r"Minimum point\s*\(([^)]*)\)", said)[1].split()
            for axis in range(3):
                self.assertAlmostEqual(float(low[axis]), min(p[axis] for p in points), places=4)


if __name__ == "__main__":
    unittest.main(argv=["surface_test"], verbosity=1)
