#!/usr/bin/env python3
"""OpenVDB in and out: pyopenvdb and vdb_print read what is written, and pyopenvdb writes what is read.

  vdb_test.py VOXMELT

What is no such file, or makes OpenVDB crash, gets exit code 2 and one line that names its place.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import bad_files
from program import PROGRAM, SMALL, voxmelt, write

PYTHON = next((python for python in (sys.executable, "/usr/bin/python3") if shutil.which(python)
               and subprocess.run([python, "-c", "import numpy, pyopenvdb"], capture_output=True).returncode == 0), None)
PRINT = shutil.which("vdb_print")
HELPER = Path(os.environ.get("VOXMELT_VDB", Path(PROGRAM).parent / "voxmelt-vdb"))
DATA = Path(__file__).resolve().parents[1] / "data"
HOW = "apt-get install libopenvdb-dev"

# Solid, liquid, inert, and heat that has molten something; no side is a multiple of 8.
MELT = """[grid]
size = [21, 18, 13]
[[solid]]
shape = "box"
size = [17, 9, 11]
at = [9.5, 6.5, 6.5]
temperature = 0.4
[[solid]]
shape = "sphere"
radius = 2.5
at = [10, 15, 6]
temperature = 0.45
[[inert]]
shape = "floor"
thickness = 2
[material]
melting_point = 0.5
latent_heat = 0.125
[heat]
gamma = 0.1
[[heat_source]]
at = [21, 24, 13]
power = 30
"""
HEAD = "[grid]\nsize = [12, 10, 14]\n"
BOXES = [((1, 2, 3), (5, 8, 11)), ((5, 2, 3), (11, 4, 6)), ((8, 4, 4), (9, 9, 5))]  # low, high

WRITER = """
import sys, numpy as n, pyopenvdb as v
boxes = %r
cells = n.zeros((12, 10, 14), n.float32)
for low, high in boxes:
    cells[tuple(slice(l, h) for l, h in zip(low, high))] = 1
def grid_of(kind, values, name="body", **more):
    grid = kind(**more)
    grid.name = name
    grid.copyFromArray(values)
    return grid
def save(file, *grids):
    v.write(file, grids=list(grids))
fog = lambda values=cells, name="body": grid_of(v.FloatGrid, values, name)
""" % BOXES


def volume(file, more=""):
    return f'{HEAD}[[solid]]\nshape = "volume"\nfile = "{file}"\n{more}'


def of_shapes(boxes=BOXES):
    return HEAD + "".join(
        f'[[solid]]\nshape = "box"\nsize = {[h - l for l, h in zip(low, high)]}\nat = {[(l + h) / 2 for l, h in zip(low, high)]}\n'
        for low, high in boxes)


class Vdb(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def good(self, *arguments, **options):
        result = voxmelt(*arguments, cwd=self.folder, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def bad(self, said, *arguments, **options):
        result = voxmelt(*arguments, cwd=self.folder, **options)
        self.assertEqual((result.returncode, result.stdout, len(result.stderr.splitlines())), (2, "", 1), result.stderr)
        self.assertIn(said, result.stderr)

    def digest(self, text):
        return self.good("digest", write(self.folder, text), "--steps", 0).split()[3]

    def python(self, text):
        done = subprocess.run([PYTHON, "-c", text], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout


class Missing(Vdb):
    """Without the program beside it, on PATH, or where VOXMELT_VDB says."""

    def setUp(self):
        super().setUp()
        (self.folder / "app").mkdir()
        self.alone = self.folder / "app/voxmelt"
        shutil.copy(PROGRAM, self.alone)
        (self.folder / "x.vdb").write_bytes(b"\x20BDV\0\0\0\0")

    def run_alone(self, *arguments, **environment):
        plain = {name: value for name, value in os.environ.items() if name != "VOXMELT_VDB"}
        return subprocess.run([self.alone, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              env=plain | {"PATH": "/nowhere"} | environment)

    def test_it_says_what_brings_it(self):
        write(self.folder, SMALL, "small.toml")
        scene = write(self.folder, volume("x.vdb")).name
        for arguments, before in ((["export", "small.toml", "--format", "vdb", "--out", "o"], "--format vdb: error: "),
                                  (["run", "small.toml", "--write", "csv,vdb", "--out", "o"], "--write vdb: error: "),
                                  (["digest", scene], "scene.toml:5:8: error: x.vdb: ")):
            told = self.run_alone(*arguments)
            self.assertEqual((told.returncode, told.stdout, len(told.stderr.splitlines())), (2, "", 1), told.stderr)
            self.assertIn(before, told.stderr)
            self.assertIn(f"voxmelt-vdb, which is not here: {HOW}, then configure, build and install", told.stderr)
            self.assertFalse((self.folder / "o").exists())
        (self.folder / "CMakeCache.txt").touch()
        self.assertIn(f"{HOW}, then cmake {self.folder} && cmake --build {self.folder} --target voxmelt-vdb\n",
                      self.run_alone("digest", scene).stderr)
        self.assertIn("OpenVDB: not found (no VDB: apt-get install libopenvdb-dev)", self.run_alone("--version").stdout)
        # All the others work.
        self.assertEqual(self.run_alone("export", "small.toml", "--format", "nrrd", "--out", "n").returncode, 0)

    def test_a_helper_that_fails_is_told(self):
        scene = write(self.folder, volume("x.vdb")).name
        ok = 'printf "ok 2 2 2 1 1 1\\nbody\\n\\n"; '
        for script, said in (("kill -SEGV $$", "OpenVDB crashes on it (signal 11)"),
                             ("kill -ABRT $$", "OpenVDB crashes on it (signal 6)"),
                             ("kill -XCPU $$", "OpenVDB takes too long for it"),
                             ("exit 5", "OpenVDB ended with 5"),
                             ("exit 0", "it ended too early"),
                             ("echo error no such luck", "x.vdb: no such luck"),
                             ("echo something", "x.vdb: something"),
                             ("yes | tr -d '\\n'", "its answer has no end"),
                             ('printf "ok 2 2\\nbody\\n\\n"', "of another version"),
                             ('printf "ok 2 2 5000 1 1 1\\nbody\\n\\n"', "a side of 5000 voxels"),
                             ('printf "ok 2 2 2 1 0 1\\nbody\\n\\n"', "a voxel has a side of 0"),
                             (ok + 'printf "\\001\\001"', "it ended too early"),
                             (ok + 'printf "\\001\\001\\001\\001\\001\\001\\001\\001"; kill -SEGV $$', "(signal 11)")):
            helper = self.folder / "helper"
            helper.write_text(f"#!/bin/sh\n{script}\n")
            helper.chmod(0o755)
            told = self.run_alone("digest", scene, VOXMELT_VDB=str(helper), PATH=os.environ["PATH"])
            self.assertEqual((told.returncode, told.stdout, len(told.stderr.splitlines())), (2, "", 1), (script, told.stderr))
            self.assertRegex(told.stderr, r"\Ascene\.toml:5:8: error: x\.vdb: ")
            self.assertIn(said, told.stderr)
        told = self.run_alone("digest", scene, VOXMELT_VDB=str(self.folder / "nothing"))
        self.assertIn("cannot start", told.stderr)

    def test_a_failed_export_leaves_nothing(self):
        write(self.folder, SMALL, "small.toml")
        for script, said, code in (('touch "$2"; cat > /dev/null; echo full no room', "no room", 3),
                                   ('touch "$2"; echo error no luck', "volume.vdb: error: no luck", 2),
                                   ('touch "$2"; kill -SEGV $$', "OpenVDB crashes on it (signal 11)", 2)):
            helper = self.folder / "helper"
            helper.write_text(f"#!/bin/sh\n{script}\n")
            helper.chmod(0o755)
            told = self.run_alone("export", "small.toml", "--format", "vdb", "--out", "o", VOXMELT_VDB=str(helper), PATH=os.environ["PATH"])
            self.assertEqual((told.returncode, told.stdout), (code, ""), told.stderr)
            self.assertIn(said, told.stderr)
            self.assertFalse((self.folder / "o").exists())


@unittest.skipUnless(HELPER.exists(), f"built without OpenVDB: {HOW}")
class Out(Vdb):
    def setUp(self):
        super().setUp()
        write(self.folder, MELT)
        self.good("export", "scene.toml", "--steps", 40, "--format", "vdb", "--out", "v")

    @unittest.skipUnless(PYTHON, "no pyopenvdb here: apt-get install python3-openvdb python3-numpy")
    def test_pyopenvdb_reads_the_state(self):
        self.good("export", "scene.toml", "--steps", 40, "--out", "n")
        said = self.python("""
import json, numpy as n, pyopenvdb as v
grids, meta = v.readAll("v/volume.vdb")
print(meta["step"], [grid.name for grid in sorted(grids, key=lambda grid: grid.name)])
of = {name: n.load(f"n/{name}.npy") for name in ("solid", "liquid", "inert", "amount", "heat")}
shape = of["solid"].shape
matter = (of["solid"] | of["liquid"]) != 0
melting, latent = round(0.5 * 65535), round(0.125 * 65535)
heat = of["heat"].astype(int)
temperature = n.where(heat <= melting, heat, n.maximum(melting, heat - latent))
wanted = {"density": (of["amount"] * matter, 4096, matter), "solid": (of["solid"], 1, of["solid"] != 0), "liquid": (of["liquid"], 1, of["liquid"] != 0),
          "inert": (of["inert"], 1, of["inert"] != 0), "temperature": (temperature, 65535, matter | (of["inert"] != 0))}
for grid in grids:
    values, unit, cells = wanted[grid.name]
    array = n.zeros(shape[::-1], n.float32)
    grid.copyToArray(array)
    active = v.BoolGrid()
    mask = n.zeros(shape[::-1], bool)
    for item in grid.citerOnValues():
        mask[tuple(slice(l, h + 1) for l, h in zip(item.min, item.max))] = True
    print(grid.name, n.array_equal(array.T, (values.astype(n.float32) / n.float32(unit))), n.array_equal(mask.T, cells), len(n.unique(values)) > 1,
          grid.background, grid.transform.indexToWorld((0, 0, 0)), grid.transform.voxelSize(), grid.gridClass)
print(of["liquid"].any(), len(n.unique(of["amount"][matter])) > 2, (temperature != heat).any(), temperature.max())
""").splitlines()
        self.assertEqual(said[0], "40 ['density', 'inert', 'liquid', 'solid', 'temperature']")
        self.assertEqual(len(said), 7)
        for line in said[1:6]:
            self.assertRegex(line, r"^\w+ True True True 0\.0 \(0\.5, 0\.5, 0\.5\) \(1\.0, 1\.0, 1\.0\) (unknown|fog volume)$")
            self.assertEqual(line.startswith("density"), line.endswith("fog volume"))
        self.assertRegex(said[6], r"^True True True \d+$")

    @unittest.skipUnless(PRINT, "no vdb_print here: apt-get install libopenvdb-tools")
    def test_vdb_print_counts_the_cells(self):
        said = subprocess.run([PRINT, "-l", "v/volume.vdb"], cwd=self.folder, capture_output=True, text=True, check=True).stdout
        counts = {part.split()[0]: int(re.search(r"active voxels:\s+([\d,]+)", part)[1].replace(",", "")) for part in said.split("Name: ")[1:]}
        line = self.good("digest", "scene.toml", "--steps", 40).split()
        solid, liquid = int(line[7]), int(line[9])
        self.assertGreater(min(solid, liquid), 0)
        self.assertEqual(counts, {"density": solid + liquid, "solid": solid, "liquid": liquid, "inert": 21 * 2 * 13, "temperature": solid + liquid + 21 * 2 * 13})

    def test_it_comes_back(self):
        """Of whole cells the solid of a file is what it was; the density has no obstacles, and its place is where the matter begins."""
        write(self.folder, of_shapes(), "shapes.toml")
        self.good("export", "shapes.toml", "--format", "vdb", "--out", "s")
        for grid in ("solid", "density"):
            self.assertEqual(self.digest(volume("s/volume.vdb", f'part = "{grid}"\nat = [1, 2, 3]\n')), self.digest(of_shapes()))

    def test_a_large_grid_comes_back(self):
        """OpenVDB has blocks of 128 voxels. Bricks of several are in one row here."""
        boxes = [((1, 2, 3), (20, 9, 11)), ((120, 1, 120), (135, 9, 290)), ((3, 2, 130), (9, 130, 141))]
        text = of_shapes(boxes).replace(HEAD, "[grid]\nsize = [140, 140, 300]\n")
        write(self.folder, text, "shapes.toml")
        self.good("export", "shapes.toml", "--format", "vdb", "--out", "s")
        back = volume("s/volume.vdb", 'part = "solid"\nat = [1, 1, 3]\n').replace(HEAD, "[grid]\nsize = [140, 140, 300]\n")
        self.assertEqual(self.digest(back), self.digest(text))

    def test_states_of_a_run_are_those_of_exports(self):
        options = ["--write", "vdb", "--write-every", 20, "--steps", 40, "--frame-every", 0]
        self.good("run", "scene.toml", *options, "--out", "a")
        states = self.folder / "a/states"
        self.assertEqual(sorted(str(path.relative_to(states)) for path in states.rglob("*.*")), [f"step_000{step}/volume.vdb" for step in ("00", "20", "40")])
        self.assertEqual((states / "step_00040/volume.vdb").read_bytes(), (self.folder / "v/volume.vdb").read_bytes())
        files = [path.read_bytes() for path in states.rglob("*.vdb")]
        self.assertEqual(len({file[21:57] for file in files}), 3)  # identifiers
        self.assertLess(max(map(len, files)), 80000)

    def test_a_scene_without_heat_has_no_temperature(self):
        write(self.folder, of_shapes() + '[flow]\nlaw = "viscous"\nviscous = { kappa = 0.2 }\n', "cold.toml")
        self.good("export", "cold.toml", "--format", "vdb", "--out", "c")
        result = voxmelt("digest", write(self.folder, volume("c/volume.vdb", 'part = "temperature"\n')), "--steps", 0)
        self.assertIn("it has no grid 'temperature'; its grids are 'density', 'liquid', 'solid', 'inert'", result.stderr)


@unittest.skipUnless(HELPER.exists(), f"built without OpenVDB: {HOW}")
class TheCup(Vdb):
    def test_the_cup_is_that_of_magica_voxel(self):
        digests = [self.good("digest", DATA / name, "--steps", 3) for name in ("cup.vdb", "cup.vox")]
        self.assertEqual(digests[0], digests[1])
        self.assertGreater(int(digests[0].split()[7]), 50000)
        self.good("run", DATA / "cup.vdb", "--steps", 1, "--size", "32x32", "--out", "cup")
        self.assertIn('shape = "volume"', (self.folder / "cup/scene.toml").read_text())


@unittest.skipUnless(HELPER.exists() and PYTHON, f"no OpenVDB or no pyopenvdb: {HOW} python3-openvdb python3-numpy")
class In(Vdb):
    def write(self, text):
        self.python(WRITER + text)

    def same(self, name, more="", boxes=BOXES, at="at = [1, 2, 3]\n"):
        self.assertEqual(self.digest(volume(name, at + more)), self.digest(of_shapes(boxes)), name)

    def test_fog_volumes(self):
        self.write("""
save("float.vdb", fog())
save("bool.vdb", grid_of(v.BoolGrid, cells != 0))
half = fog(); half.saveFloatAsHalf = True; save("half.vdb", half)
save("thin.vdb", fog(cells * 0.25))
moved = v.FloatGrid(); moved.copyFromArray(cells, ijk=(-700, 5, 3000)); save("moved.vdb", moved)
save("whole.vdb", fog(n.pad(cells, ((0, 40), (0, 40), (0, 40)))))
""")
        for name in ("float.vdb", "bool.vdb", "half.vdb", "moved.vdb", "whole.vdb"):
            self.same(name)
        self.same("thin.vdb", "filled = [0.25, 0.25]\n")
        self.bad("no number is within `filled`", "digest", write(self.folder, volume("thin.vdb")))

    def test_level_sets_are_filled_within(self):
        self.write("""
ball = v.createLevelSetSphere(radius=2.5, center=(3, 3, 3), voxelSize=0.5); ball.name = "ball"; save("ball.vdb", ball)
# distances of a box of 4 x 4 x 4 voxels, one half at its outermost ones
far = n.indices((10, 10, 10)).astype(n.float32) + 0.5
box = n.abs(far - 5).max(0) - 2
level = v.FloatGrid(background=3.0); level.copyFromArray(box); level.gridClass = v.GridClass.LEVEL_SET; save("box.vdb", level)
""")
        self.same("box.vdb", "", [((1, 2, 3), (5, 6, 7))], at="at = [-2, -1, 0]\n")
        self.same("box.vdb", "filled = [-1.5, -1]\n", [((1, 2, 3), (3, 4, 5))], at="at = [-3, -2, -1]\n")
        # A ball of radius 5 voxels has some 524 of them, 8 to a cell, and is hollow if what is not active were left out.
        line = self.good("digest", write(self.folder, volume("ball.vdb", "at = [2, 2, 2]\n")), "--steps", 0).split()
        self.assertAlmostEqual(int(line[5]) / 4096, 4 / 3 * 3.14159 * 2.5**3, delta=5)

    def test_one_of_several_grids(self):
        self.write("""
other = n.zeros_like(cells); other[2:4, 2:5, 2:6] = 1
save("two.vdb", fog(), fog(other, "other"))
wind = v.Vec3SGrid(); wind.name = "wind"; wind.fill((0, 0, 0), (1, 1, 1), (1, 2, 3)); save("wind.vdb", wind)
""")
        self.same("two.vdb", 'part = "body"\n')
        self.same("two.vdb", 'part = "other"\n', [((1, 2, 3), (3, 5, 7))])
        self.same("two.vdb", 'part = "other"\nup = "z"\n', [((1, 2, 3), (3, 6, 6))])
        result = voxmelt("digest", write(self.folder, volume("two.vdb")), "--steps", 0)
        self.assertRegex(result.stderr, r"^warning: \S*two\.vdb: the grid '(body|other)' is read, the first of '(body|other)', '(body|other)'; `part` names one\n$")
        self.assertEqual(voxmelt("digest", write(self.folder, volume("two.vdb", 'part = "body"\n')), "--steps", 0).stderr, "")
        self.bad("it has no grid 'none'; its grids are ", "digest", write(self.folder, volume("two.vdb", 'part = "none"\n')))
        self.bad("part and array exclude each other", "digest", write(self.folder, volume("two.vdb", 'part = "body"\narray = "body"\n')))
        self.bad("the grid 'wind' has values of the type vec3s, not numbers; its grids are 'wind'", "digest", write(self.folder, volume("wind.vdb")))

    def test_voxels_have_sides(self):
        self.write("""
one = n.ones((2, 1, 1), n.float32)
def placed(file, matrix):
    grid = fog(one); grid.transform = v.createLinearTransform(matrix); save(file, grid)
placed("sides.vdb", [[2, 0, 0, 0], [0, 3, 0, 0], [0, 0, 5, 0], [9, 9, 9, 1]])
l = n.zeros((3, 2, 1), n.float32); l[:, 0] = 1; l[0, 1] = 1
grid = fog(l); save("l.vdb", grid)
grid.transform = v.createLinearTransform([[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]); save("mirrored.vdb", grid)
placed("turned.vdb", [[0.8, 0.6, 0, 0], [-0.6, 0.8, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
grid = fog(one); grid.transform = v.createFrustumTransform((0, 0, 0), (9, 9, 9), 0.5, 10); save("frustum.vdb", grid)
""")
        at = "at = [1, 1, 1]\n"
        self.assertEqual(self.digest(volume("sides.vdb", at)), self.digest(of_shapes([((1, 1, 1), (5, 4, 6))])))
        for name, x in (("l.vdb", 1), ("mirrored.vdb", 3)):
            self.assertEqual(self.digest(volume(name, at)), self.digest(of_shapes([((1, 1, 1), (4, 2, 2)), ((x, 2, 1), (x + 1, 3, 2))])), name)
        for name in ("turned.vdb", "frustum.vdb"):
            self.bad("its voxels are turned, or no boxes; resample it to a grid along the axes", "digest", write(self.folder, volume(name)))

    def test_bad_files(self):
        self.write("""
big = n.random.default_rng(1).random((12, 10, 14), n.float32) * cells
save("good.vdb", grid_of(v.FloatGrid, big))
v.write("none.vdb", grids=[])
save("empty.vdb", v.FloatGrid())
def far(file, *ends):
    grid = v.FloatGrid(); grid.name = "far"
    for end in ends: grid.getAccessor().setValueOn(end, 1.0)
    save(file, grid)
far("wide.vdb", (0, 0, 0), (4096, 0, 0))
far("farther.vdb", (-2**31, 0, 0), (2**31 - 1, 5, 5))
far("huge.vdb", (0, 0, 0), (4095, 4095, 4095))
nan = v.FloatGrid(); nan.fill((0, 0, 0), (2, 2, 2), n.nan); save("nan.vdb", nan)
""")
        good = (self.folder / "good.vdb").read_bytes()
        self.assertGreater(len(good), 5000)
        bad = {name: ((self.folder / name).read_bytes(), said) for name, said in
               (("none.vdb", "it has no grids"), ("empty.vdb", "has no active voxel"), ("wide.vdb", "a side of 4097 voxels; 1 to 4096 are read"),
                ("farther.vdb", "voxels; 1 to 4096 are read"), ("huge.vdb", "68719476736 voxels; at most 1073741824 are read"),
                ("nan.vdb", "no number is within `filled`"))}
        bad |= {"zero.vdb": (b"", "no file of OpenVDB"), "text.vdb": (b"solid cup\n" * 9, "no file of OpenVDB"), "vox.vdb": (b"VOX \x96\0\0\0", "no file of OpenVDB"),
                "pointer.vdb": (b"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"), "nano.vdb": (b"NanoVDB0" + bytes(99), "no file of OpenVDB"),
                "magic.vdb": (good[:8], "is it truncated?"), "zeros.vdb": (good[:8] + bytes(4000), ""), "ones.vdb": (good[:8] + b"\xff" * 4000, ""),
                "old.vdb": (good[:8] + (100).to_bytes(4, "little") + good[12:], "")}
        for i, end in enumerate([20, 56, 60, 80, 200, 400, 700, 1000, 2000, len(good) // 2, len(good) - 100, len(good) - 1]):
            bad[f"cut_{i}.vdb"] = (good[:end], "is it truncated?")
        # The type of the grid, sizes of strings, counts and positions: whatever is hurt there, it is refused or read.
        name = good.index(b"Tree_float")
        bad["type.vdb"] = (good[:name] + b"Tree_floot" + good[name + 10:], "Tree_floot")
        bad["long.vdb"] = (good[:name - 4] + b"\xff\xff\xff\x7f" + good[name:], "")
        bad_files.check(self, bad, volume)

    def test_no_damage_does_more(self):
        self.write('save("good.vdb", fog(), fog(cells * 0.7, "other"))')
        good = (self.folder / "good.vdb").read_bytes()
        scene = write(self.folder, volume("hurt.vdb", 'part = "other"\n'))
        for at in [*range(8, 300, 7), *range(300, len(good), max(1, len(good) // 60))]:
            (self.folder / "hurt.vdb").write_bytes(good[:at] + bytes([good[at] ^ 255]) + good[at + 1:])
            result = subprocess.run([PROGRAM, "digest", scene, "--steps", "0"], capture_output=True, text=True, timeout=60)
            self.assertIn(result.returncode, (0, 2), result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1 if result.returncode else 0, result.stderr)

    def test_only_plain_files(self):
        os.mkfifo(self.folder / "pipe.vdb")
        self.write('save("good.vdb", fog())')
        scene = write(self.folder, volume("pipe.vdb"))
        feeder = subprocess.Popen(["sh", "-c", "cat good.vdb > pipe.vdb"], cwd=self.folder)
        self.bad("OpenVDB reads plain files alone", "digest", scene)
        feeder.wait(10)


unittest.main(argv=["vdb_test"])
