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


# A corner of three slabs, beside liquid that has just been poured. It is in the air, and there is no ground.
IN_THE_AIR = """
[grid]
size = [12, 10, 12]
[[solid]]
shape = "box"
size = [6, 2, 6]
at = [4, 3, 4]
temperature = 0.1
[[solid]]
shape = "box"
size = [2, 6, 6]
at = [2, 5, 4]
temperature = 0.1
[[solid]]
shape = "box"
size = [6, 6, 2]
at = [4, 5, 2]
temperature = 0.1
[[liquid]]
shape = "box"
size = [3, 3, 5]
at = [9.5, 5.5, 6.5]
temperature = 0.6
[material]
melting_point = 0.5
[heat]
gamma = 0.1
[look]
smooth = 2
smooth_solid = 1
"""
# A pool on a floor two deep, and a corner of walls that rises from it.
POOL = """
[grid]
size = [24, 10, 16]
[[inert]]
shape = "floor"
thickness = 2
[[inert]]
shape = "box"
size = [2, 8, 16]
at = [23, 6, 8]
[[inert]]
shape = "box"
size = [24, 8, 2]
at = [12, 6, 15]
[[liquid]]
shape = "box"
size = [8, 1, 8]
at = [8, 2.5, 8]
"""


def filtered(values, size, passes):
    """Section 6: each axis after the other; cells outside are like the nearest one inside, and filtered like any other."""
    x, y, z = (n + 2 * passes for n in size)
    def at(i, n):
        return min(max(i - passes, 0), n - 1)
    wide = [values[at(a, size[0]) + size[0] * (at(b, size[1]) + size[1] * at(c, size[2]))]
            for c in range(z) for b in range(y) for a in range(x)]
    for _ in range(passes):
        for stride, count in ((x * y, z), (x, y), (1, x)):
            wide = [wide[i] if not 0 < i // stride % count < count - 1 else (wide[i - stride] + 2 * wide[i] + wide[i + stride] + 2) >> 2
                    for i in range(len(wide))]
    return [wide[a + passes + x * (b + passes + y * (c + passes))] for c in range(size[2]) for b in range(size[1]) for a in range(size[0])]


def cells_of_the_picture(fields, size, liquid_passes, solid_passes):
    """The cells whose intensity is half or more, and those beside the edge of these."""
    amounts = [min(a, 4096) if s or l else 0 for a, s, l in zip(fields["amount"], fields["solid"], fields["liquid"])]
    of = [16 * a - ((a + 15) >> 4) for a in amounts]
    solid, liquid = ([v if kind else 0 for v, kind in zip(of, fields[name])] for name in ("solid", "liquid"))
    passes = max(liquid_passes, solid_passes, 1)
    s, l = filtered(solid, size, passes), filtered(liquid, size, passes)
    soft_way, hard_way = filtered(of, size, liquid_passes), filtered(of, size, solid_passes)
    inside = set()
    for i in range(len(of)):
        every, soft = (s[i] + l[i] + 3) >> 2, (l[i] + 3) >> 2
        over = min(max(5 * soft - 2 * every, 0), 2 * every)
        t = 64 * over // every if every else 0
        weight = (t * t * (384 - 2 * t)) >> 13
        if (hard_way[i] * (256 - weight) + soft_way[i] * weight + 128) >> 8 >= 32640:
            inside.add(i)
    beside = {i + step for i in inside for step in (-1, 0, 1) if 0 <= i + step < len(of)}
    return inside, beside


class Surface(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def export(self, scene, steps, form, *more):
        cells = ["--surface", "cells"] if form in FORMATS and not more else more
        result = voxmelt("export", scene, "--steps", steps, "--format", form, "--out", form, "--quiet", *cells, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.folder / form

    def surfaces(self, scene, steps, *more):
        for form in FORMATS:
            yield form, READERS[form]((self.export(scene, steps, form, *more) / f"surface.{form}").read_bytes())

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

    def test_the_surface_of_the_pictures(self):
        """It is around the cells of docs/picture/field.md, sections 2, 6 and 7, computed here from the state."""
        write(self.folder, IN_THE_AIR)
        fields = {name: npy(self.export("scene.toml", 0, "npy") / f"{name}.npy") for name in ("solid", "liquid", "amount", "heat")}
        inside, beside = cells_of_the_picture(fields, (12, 10, 12), liquid_passes=2, solid_passes=1)
        matter = {i for i in range(1440) if fields["solid"][i] or fields["liquid"][i]}
        half = {i for i in matter if fields["amount"][i] >= 2048}
        self.assertIn(3 + 12 * 4 + 120 * 3, inside - matter, "the corner is filled")
        self.assertTrue(half - inside, "edges are rounded")
        self.assertTrue(any(fields["liquid"][i] for i in inside) and any(fields["solid"][i] for i in inside))
        first = None
        for form, (points, triangles, made_of) in self.surfaces("scene.toml", 0, "--surface", "picture"):
            self.closed(triangles)
            shape = sorted(tuple(sorted(points[i] for i in t)) for t in triangles)
            first = first or shape
            self.assertEqual(shape, first, form)
            if form != "ply":
                continue
            for i in sorted(beside):
                middle = (i % 12 + 0.5, i // 12 % 10 + 0.5, i // 120 + 0.5)
                self.assertAlmostEqual(windings(points, triangles, middle), i in inside, places=3)
            self.assertLessEqual({m[0] for m in made_of}, {fields["heat"][i] for i in matter} - {0})
        usual = READERS["ply"]((self.export("scene.toml", 0, "ply", "--threads", "1") / "surface.ply").read_bytes())
        self.assertEqual(sorted(tuple(sorted(usual[0][i] for i in t)) for t in usual[1]), first, "it is the usual one")

    def test_thin_liquid_on_the_ground_and_in_corners(self):
        """A pool of full cells on the floor, one deep, ends at its height. Corners of obstacles are no matter."""
        write(self.folder, POOL)
        points, triangles, _ = READERS["ply"]((self.export("scene.toml", 0, "ply", "--surface", "picture") / "surface.ply").read_bytes())
        self.closed(triangles)
        for x, high in ((5.5, 2.8), (7.5, 2.95)):  # its rim is round
            for y, inside in ((1.9, 0), (2.1, 1), (high, 1), (3.05, 0)):
                self.assertAlmostEqual(windings(points, triangles, (x, y, 7.5)), inside, places=3, msg=(x, y))
        low, high = (min(p[1] for p in points), max(p[1] for p in points))
        self.assertAlmostEqual(low, 2, places=2)
        self.assertAlmostEqual(high, 3, delta=0.1)
        self.assertTrue(all(3 < p[axis] < 13 for p in points for axis in (0, 2)), "nothing but the pool")

    def test_what_is_inert_within_matter(self):
        deep = POOL.replace("size = [8, 1, 8]\nat = [8, 2.5, 8]", "size = [8, 6, 8]\nat = [8, 5, 8]")
        write(self.folder, deep + '[[inert]]\nshape = "box"\nsize = [1, 1, 1]\nat = [8.5, 5.5, 8.5]\n')
        points, triangles, _ = READERS["ply"]((self.export("scene.toml", 0, "ply", "--surface", "picture") / "surface.ply").read_bytes())
        self.closed(triangles)
        for x, inside in ((7.5, 1), (8.5, 0), (9.5, 1)):
            self.assertAlmostEqual(windings(points, triangles, (x, 5.5, 8.5)), inside, places=3, msg=x)

    def test_a_run_writes_both(self):
        write(self.folder, SMALL)
        for surface in ("cells", "picture"):
            result = voxmelt("run", "scene.toml", "--steps", 2, "--write", "ply", "--write-every", 1, "--surface", surface,
                             "--out", surface, "--quiet", cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            for step in range(3):
                alone = self.export("scene.toml", step, "ply", "--surface", surface) / "surface.ply"
                self.assertEqual((self.folder / surface / f"states/step_{step:05}/surface.ply").read_bytes(), alone.read_bytes())

    def test_other_formats_have_no_surface(self):
        write(self.folder, SMALL)
        for words in (["export", "scene.toml", "--format", "vti", "--out", "out"], ["run", "scene.toml", "--write", "npz,csv"], ["run", "scene.toml"]):
            result = voxmelt(*words, "--surface", "cells", cwd=self.folder)
            self.assertEqual((result.returncode, result.stderr),
                             (2, "--surface cells: error: only ply, glb, stl and obj write a surface\n"))
            self.assertFalse((self.folder / "out").exists())

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
