#!/usr/bin/env python3
"""`run --write` and `export` write states that other programs read, and a run that goes on writes the same.

  write_test.py PROGRAM
"""
import csv
import io
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import zipfile
from pathlib import Path

from program import PROGRAM, SMALL, voxmelt, write

PYTHON = next((python for python in ("python3", "/usr/bin/python3") if shutil.which(python)
               and subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode == 0), None)
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
        child = subprocess.Popen([PROGRAM, "run", "scene.toml", "--out", "b", *arguments], cwd=self.folder,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 60
        while child.poll() is None and time.monotonic() < end:
            if any(after(folder) for folder in self.folder.glob("b.partial-*")):
                break
            time.sleep(0.002)
        child.send_signal(signal.SIGINT)
        self.assertEqual(child.wait(60), 4)

    def test_a_run_that_goes_on_writes_the_same(self):
        options = ["--write", "csv,npz", "--write-every", "50", "--steps", "1930", "--frame-every", "0"]
        self.good("run", "scene.toml", *options, "--out", "a")
        self.interrupt(*options, after=lambda folder: (folder / "states/step_00300").exists())
        held = len(rows_of(self.folder / "b/steps.csv"))
        self.assertGreater(held, 5)
        self.assertLess(held, 40)
        self.good("run", "--resume", "b")
        rows = rows_of(self.folder / "a/steps.csv")
        self.assertEqual(len(rows), 40)
        self.assertEqual(without_times(rows), without_times(rows_of(self.folder / "b/steps.csv")))
        for path in (self.folder / "a/states").rglob("*.npz"):
            self.assertEqual(path.read_bytes(), (self.folder / "b" / path.relative_to(self.folder / "a")).read_bytes())

        # The state of a last step that is last no more goes, as its frame does.
        self.good("run", "--resume", "b", "--steps", "+30")
        self.assertEqual([int(row["step"]) for row in rows_of(self.folder / "b/steps.csv")][-3:], [1900, 1950, 1960])
        self.assertEqual(sorted(path.name for path in (self.folder / "b/states").iterdir())[-2:], ["step_01950", "step_01960"])

    def test_mistakes_are_said(self):
        for options, said in ((["--write", "tiff"], "--write tiff: error: 'tiff' is not one of npy, vti, nrrd, npz, ply, glb, stl, obj, csv"),
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
