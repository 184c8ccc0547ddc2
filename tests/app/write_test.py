#!/usr/bin/env python3
"""`run --write` and `export` write states that other programs read, and a run that goes on writes the same.

  write_test.py PROGRAM
"""
import csv
import io
import json
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile
from pathlib import Path

from program import PROGRAM, SMALL, voxmelt, write

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import vti

PYTHON = next((python for python in ("python3", "/usr/bin/python3") if shutil.which(python)
               and subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode == 0), None)
VTK = next((python for python in ("python3", "/usr/bin/python3") if shutil.which(python)
            and subprocess.run([python, "-c", "import vtk"], capture_output=True).returncode == 0), None)
SCENE = SMALL.replace("steps = 6", "steps = 40") + '[[vent]]\nat = [4, 8, 4]\nradius = 1.5\nrate = 0.2\nuntil = 12\n'
FIELDS = {"solid", "liquid", "inert", "amount", "energy", "heat"}


def rows_of(file):
    return list(csv.DictReader(io.StringIO(file.read_text())))


def without_times(rows):
    return [{name: value for name, value in row.items() if name != "seconds_per_step"} for row in rows]


class Write(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        write(self.folder, SCENE)

    def tearDown(self):
        self.temporary.cleanup()

    def good(self, *arguments):
        result = voxmelt(*arguments, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_the_table_has_the_books(self):
        said = self.good("run", "scene.toml", "--write", "csv", "--write-every", 7, "--out", "a")
        self.assertIn("table          a/steps.csv\n", said)
        rows = rows_of(self.folder / "a/steps.csv")
        self.assertEqual([int(row["step"]) for row in rows], [0, 7, 14, 21, 28, 35, 40])
        lines = {line.split()[1]: line.split() for line in self.good("digest", "scene.toml", "--steps", 40, "--every", 1).splitlines()}
        for row in rows:
            told = lines[row["step"]]
            self.assertEqual([row["mass"], row["solid_cells"], row["liquid_cells"]], [told[5], told[7], told[9]])
            self.assertEqual(int(row["solid_mass"]) + int(row["liquid_mass"]), int(row["mass"]))
            for quantity in ("mass", "energy", "heat"):
                terms = sum(int(value) for name, value in row.items() if name.startswith(f"{quantity}_"))
                self.assertEqual(terms, int(row[quantity]), f"{quantity} at step {row['step']}")
        self.assertGreater(int(rows[-1]["mass_added"]), 0)
        self.assertLess(int(rows[-1]["energy_dissipated"]), 0)
        self.assertEqual({float(row["seconds_per_step"]) > 0 for row in rows[1:]}, {True})
        self.assertFalse((self.folder / "a/states").exists())
        self.good("export", "scene.toml", "--steps", 14, "--format", "csv", "--out", "e")
        self.assertEqual(without_times(rows_of(self.folder / "e/steps.csv")), without_times(rows[2:3]))

    def test_states_are_those_of_exports(self):
        self.good("run", "scene.toml", "--write", "npz,nrrd,vti,npy", "--write-every", 20, "--steps", 30, "--out", "a")
        states = self.folder / "a/states"
        self.assertEqual(sorted(path.name for path in states.iterdir()), ["step_00000", "step_00020", "step_00030"])
        for step in (0, 20, 30):
            written = states / f"step_{step:05}"
            for form in ("npy", "npz", "nrrd", "vti"):
                self.good("export", "scene.toml", "--steps", step, "--format", form, "--out", f"{form}{step}")
                exported = self.folder / f"{form}{step}"
                files = [path for path in exported.iterdir() if path.suffix == f".{form}"]
                self.assertTrue(files)
                for file in files:
                    self.assertEqual((written / file.name).read_bytes(), file.read_bytes(), file)
            with zipfile.ZipFile(written / "fields.npz") as archive:
                self.assertIsNone(archive.testzip())
                self.assertEqual({name[:-4] for name in archive.namelist()}, FIELDS)
                for name in archive.namelist():
                    self.assertEqual(archive.read(name), (written / name).read_bytes())

    def test_images_hold_the_arrays_and_a_list_their_times(self):
        said = self.good("run", "scene.toml", "--write", "npy,vti", "--write-every", 20, "--steps", 30, "--out", "a")
        self.assertIn("for ParaView   a/states.pvd\n", said)
        listed = re.findall(r'<DataSet timestep="(\d+)" part="0" file="(.*?)"/>', (self.folder / "a/states.pvd").read_text())
        self.assertEqual([int(step) for step, _ in listed], [0, 20, 30])
        for step, name in listed:
            image = (self.folder / "a" / name).read_bytes()
            self.assertEqual(vti.time_of(image), float(step))
            arrays = vti.arrays_of(image)
            self.assertEqual(set(arrays), FIELDS)
            for field, cells in arrays.items():
                numbers = (self.folder / "a" / name).with_name(f"{field}.npy").read_bytes()
                self.assertTrue(numbers.endswith(b"}\n" + cells) or numbers.endswith(b" \n" + cells), field)

    def test_blocks_end_anywhere(self):
        """Blocks of 2^20 bytes: one cell less, just one block, and one cell more; with and without a shorter last one."""
        for size in ((1023, 5, 205), (1024, 16, 64), (1025, 31, 33)):
            write(self.folder, f'[grid]\nsize = {list(size)}\n[[solid]]\nshape = "sphere"\nradius = 2\nat = [9, 2, 9]\n', "wide.toml")
            for form in ("vti", "npy"):
                self.good("export", "wide.toml", "--steps", 1, "--format", form, "--out", f"{form}{size[0]}")
            for field, cells in vti.arrays_of((self.folder / f"vti{size[0]}/volume.vti").read_bytes()).items():
                numbers = (self.folder / f"npy{size[0]}/{field}.npy").read_bytes()
                self.assertTrue(numbers[-len(cells):] == cells, f"{field} of {size}")
                self.assertEqual(len(cells), size[0] * size[1] * size[2] * (1 if field in ("solid", "liquid", "inert") else 2))

    @unittest.skipUnless(VTK, "no VTK here: apt-get install python3-vtk9")
    def test_vtk_reads_images(self):
        self.good("export", "scene.toml", "--steps", 20, "--format", "vti", "--out", "e")
        self.good("export", "scene.toml", "--steps", 20, "--out", "n")
        text = ("import sys, numpy, vtk\nfrom vtk.util.numpy_support import vtk_to_numpy\n"
                "r = vtk.vtkXMLImageDataReader(); r.SetFileName('e/volume.vti'); r.Update(); d = r.GetOutput()\n"
                "print(d.GetFieldData().GetArray('TimeValue').GetValue(0), *d.GetDimensions())\n"
                "c = d.GetCellData()\n"
                "for i in range(c.GetNumberOfArrays()):\n"
                "    n = c.GetArrayName(i)\n"
                "    print(n, numpy.array_equal(vtk_to_numpy(c.GetArray(i)), numpy.load('n/' + n + '.npy').ravel()))\n")
        said = subprocess.run([VTK, "-c", text], cwd=self.folder, capture_output=True, text=True, check=True).stdout.split("\n")
        self.assertEqual(said[0], "20.0 13 11 13")
        self.assertEqual(set(said[1:-1]), {f"{name} True" for name in FIELDS})

    @unittest.skipUnless(VTK, "no VTK here: apt-get install python3-vtk9")
    def test_vtk_reads_the_parameters(self):
        """All of parameters.json, and where it comes from. A second, plain way: each number by its path."""
        more = ('[heat.air]\nexchange = 0.01\nbottom = 0.25\ntop = 0.5\n[[vent]]\nat = [4, 8, 6]\nradius = 1\nrate = 0.125\n'
                '[[heat_source]]\nkind = "sphere"\nkeyframes = [{ step = 0, at = [14, 12, 1], radius = 2, power = 3 }, { step = 9, at = [1, 2, 3], radius = 1, power = 4.5 }]\n')
        write(self.folder, SCENE.replace("[flow]", more + "[flow]"), "much_heat.toml")
        self.good("export", "much_heat.toml", "--steps", 20, "--format", "vti", "--out", "e", "--set", f"run.seed={2**63 - 1}")
        text = ("import sys, json, vtk\n"
                "r = vtk.vtkXMLImageDataReader(); r.SetFileName('e/volume.vti'); r.Update(); f = r.GetOutput().GetFieldData()\n"
                "out = {}\n"
                "for i in range(f.GetNumberOfArrays()):\n"
                "    a = f.GetAbstractArray(i); n = a.GetNumberOfComponents()\n"
                "    out[a.GetName()] = [a.GetDataTypeAsString(), n, [str(a.GetVariantValue(k).ToString()) for k in range(a.GetNumberOfValues())]]\n"
                "print(json.dumps(out))\n")
        held = json.loads(subprocess.run([VTK, "-c", text], cwd=self.folder, capture_output=True, text=True, check=True).stdout)
        self.assertEqual(held.pop("TimeValue"), ["double", 1, ["20"]])
        self.assertEqual(held.pop("scene"), ["string", 1, ["much_heat"]])
        version = self.good("--version").split()[1]
        self.assertEqual(held.pop("version"), ["string", 1, [version]])

        told = json.loads((self.folder / "e/parameters.json").read_text())
        del told["grid"], told["step"]
        numbers = lambda value: [part for one in value for part in numbers(one)] if isinstance(value, list) else [str(int(value))]
        sources = told["heat"].pop("sources")
        vents = told.pop("vents")
        wanted = {f"vents.{key}": (3 if key == "at" else 1, numbers([vent[key] for vent in vents])) for key in vents[0]}
        self.assertEqual((len(vents), len(sources)), (2, 2))
        for i, source in enumerate(sources):
            if "kind" in source:
                wanted[f"heat.sources.{i}.kind"] = (1, [source["kind"]])
            for key in source["keys"][0]:
                wanted[f"heat.sources.{i}.keys.{key}"] = (3 if key == "at" else 1, numbers([one[key] for one in source["keys"]]))

        def leaves(value, path):
            if isinstance(value, dict):
                for key, member in value.items():
                    leaves(member, path + [key])
            elif value != []:
                wanted[".".join(path)] = (len(value[0]) if isinstance(value, list) and isinstance(value[0], list) else 1, [value] if isinstance(value, str) else numbers(value))
        leaves(told, [])
        self.assertEqual({name: (n, values) for name, (_, n, values) in held.items()}, wanted)
        self.assertEqual(held["flow.law"][0], "string")
        self.assertEqual(held["seed"][2], [str(2**63 - 1)])
        self.assertEqual(len(held["heat.air_temperature"][2]), 10)
        self.assertEqual(len(set(held["heat.air_temperature"][2])), 10)
        self.assertEqual(held["vents.at"][1:], [3, numbers([vent["at"] for vent in vents])])
        self.assertEqual(len(held["heat.sources.1.keys.step"][2]), 2)

    @unittest.skipUnless(PYTHON, "no NumPy here: apt-get install python3-numpy")
    def test_numpy_reads_npz(self):
        self.good("export", "scene.toml", "--steps", 20, "--format", "npz", "--out", "e")
        text = ("import numpy; f = numpy.load('e/fields.npz')\n"
                "m = (f['solid'] | f['liquid']) != 0\n"
                "print(sorted(f.files) == sorted(%r), f['amount'].shape, f['amount'][m].sum(dtype=int), f['solid'].sum())" % FIELDS)
        said = subprocess.run([PYTHON, "-c", text], cwd=self.folder, capture_output=True, text=True, check=True).stdout.split()
        line = self.good("digest", "scene.toml", "--steps", 20).split()
        self.assertEqual(said, ["True", "(12,", "10,", "12)", line[5], line[7]])

    def test_a_scene_takes_an_archive(self):
        self.good("export", "scene.toml", "--steps", 0, "--format", "npz", "--out", "e")
        write(self.folder, '[grid]\nsize = [12, 10, 12]\n[[solid]]\nshape = "volume"\nfile = "e/fields.npz"\narray = "solid"\n', "again.toml")
        line = self.good("digest", "again.toml", "--steps", 0).split()
        self.assertEqual(line[7], self.good("digest", "scene.toml", "--steps", 0).split()[7])

    def interrupt(self, *arguments, after):
        # The program is nice: on a busy machine it should not end before we have looked.
        child = subprocess.Popen(["nice", "-n", "19", PROGRAM, "run", "scene.toml", "--out", "b", *arguments],
                                 cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 60
        while child.poll() is None and time.monotonic() < end:
            if any(after(folder) for folder in self.folder.glob("b.partial-*")):
                break
            time.sleep(0.002)
        child.send_signal(signal.SIGINT)
        self.assertEqual(child.wait(60), 4)

    def test_a_run_that_goes_on_writes_the_same(self):
        options = ["--write", "csv,npz,vti", "--write-every", "50", "--steps", "1930", "--frame-every", "0"]
        self.good("run", "scene.toml", *options, "--out", "a")
        self.interrupt(*options, after=lambda folder: (folder / "states/step_00300").exists())
        held = len(rows_of(self.folder / "b/steps.csv"))
        self.assertGreater(held, 5)
        self.assertLess(held, 40)
        self.good("run", "--resume", "b")
        rows = rows_of(self.folder / "a/steps.csv")
        self.assertEqual(len(rows), 40)
        self.assertEqual(without_times(rows), without_times(rows_of(self.folder / "b/steps.csv")))
        written = [*(self.folder / "a/states").rglob("*.npz"), *(self.folder / "a/states").rglob("*.vti")]
        self.assertEqual(len(written), 80)
        for path in [*written, self.folder / "a/states.pvd"]:
            self.assertEqual(path.read_bytes(), (self.folder / "b" / path.relative_to(self.folder / "a")).read_bytes())

        # The state of a last step that is last no more goes, as its frame does.
        self.good("run", "--resume", "b", "--steps", "+30")
        self.assertEqual([int(row["step"]) for row in rows_of(self.folder / "b/steps.csv")][-3:], [1900, 1950, 1960])
        self.assertEqual(sorted(path.name for path in (self.folder / "b/states").iterdir())[-2:], ["step_01950", "step_01960"])
        listed = re.findall(r'timestep="(\d+)"', (self.folder / "b/states.pvd").read_text())
        self.assertEqual(listed, [str(step) for step in [*range(0, 1951, 50), 1960]])

    def test_mistakes_are_said(self):
        for options, said in ((["--write", "tiff"], "--write tiff: error: 'tiff' is not one of npy, vti, nrrd, vdb, npz, ply, glb, stl, obj, csv"),
                              (["--write", "npy,,csv"], "--write npy,,csv: error: '' is not one of"),
                              (["--write", "csv,npy,csv"], "csv comes twice"),
                              (["--write-every", 3], "--write-every 3: error: --write says what is written"),
                              (["--write", "csv", "--write-every", -1], "--write-every")):
            result = voxmelt("run", "scene.toml", *options, cwd=self.folder)
            self.assertEqual(result.returncode, 2, options)
            self.assertIn(said, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1)
        result = voxmelt("run", "--resume", "a", "--write", "csv", cwd=self.folder)
        self.assertEqual((result.returncode, "excludes" in result.stderr), (2, True))
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main(argv=["write_test"], verbosity=1)
