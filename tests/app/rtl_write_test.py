#!/usr/bin/env python3
"""`voxmelt rtl`: the folder that it writes passes its own test bench, in a place without voxmelt.

  rtl_write_test.py PROGRAM          one small pipeline
  rtl_write_test.py PROGRAM --large  three of committed scenes (slow)
"""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from program import SMALL, voxmelt, write

SCENES = Path(__file__).resolve().parents[2] / "scenes"


def make(folder, *arguments, timeout=1500):
    """Runs make with the tools of the system alone."""
    return subprocess.run(["make", "-C", str(folder), *arguments], capture_output=True, text=True, timeout=timeout,
                          env={"PATH": "/usr/bin:/bin"})


class Written(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def written(self, scene, *options):
        done = voxmelt("rtl", scene, "--out", self.folder / "rtl", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return shutil.move(self.folder / "rtl", self.folder / "elsewhere")

    def passes(self, folder, tokens, *arguments):
        done = make(folder, *arguments)
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])
        said = re.findall(r"(\d+) tokens, no difference; (\d+) cycles", done.stdout)
        self.assertEqual([int(n) for n, _ in said], [tokens, tokens], "without and with stalls")
        self.assertGreater(int(said[1][1]), int(said[0][1]), "stalls cost cycles")


@unittest.skipUnless(shutil.which("verilator"), "skipped: `apt-get install verilator`")
class Small(Written):
    def test_it_passes_its_test_bench_and_a_wrong_vector_does_not(self):
        scene = write(self.folder, SMALL)
        folder = Path(self.written(scene, "--from", 8, "--passes", 3, "--set", "hw.lanes=1", "--set", "hw.cascade=2",
                                   "--set", "pieces.fall=false"))
        self.passes(folder, 3 * 12 * 10 * 12)
        lines = (folder / "out.hex").read_text().splitlines()
        lines[700] = f"{int(lines[700], 16) ^ 4:0{len(lines[700])}x}"
        (folder / "out.hex").write_text("\n".join(lines) + "\n")
        done = make(folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("token 700 differs", done.stdout)
        loads = subprocess.run(["./built/testbench", "+load"], cwd=folder, capture_output=True, text=True)
        self.assertEqual(loads.returncode, 0, loads.stdout)
        self.assertNotIn("token", loads.stdout)  # it only reads the vectors

    @unittest.skipUnless(shutil.which("yosys"), "skipped: `apt-get install yosys`")
    def test_yosys_reads_it_without_a_warning(self):
        viscous = SMALL.replace('law = "paper"', 'law = "viscous"\n[flow.viscous]\nkappa = 0.01\nsubsteps = 2')
        for scene, substeps in (SMALL, 1), (viscous, 2):
            self.check(self.written(write(self.folder, scene), "--set", "hw.lanes=2", "--set", "hw.cascade=1",
                                    "--set", f"hw.substeps={substeps}"))
            shutil.rmtree(self.folder / "elsewhere")
        self.check(self.written(SCENES / "chocolate_nuts.toml", "--set", "hw.lanes=2", "--set", "flow.viscous.substeps=1"))  # materials

    def check(self, folder):
        sources = ["voxmelt_pkg.sv"] + sorted(f.name for f in Path(folder).glob("*.sv")
                                              if f.name not in ("voxmelt_pkg.sv", "testbench.sv"))
        done = subprocess.run(["yosys", "-q", "-e", ".*", "-p", f"read_verilog -sv {' '.join(sources)}; "
                               "hierarchy -check -top axi_pipeline; proc; check -assert"],
                              cwd=folder, capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout[-2000:])


class Refused(Written):
    def test_what_cannot_be_written(self):
        for scene, options, words in (
                ("lesson_tubes", (), "the number of sub-steps follows from the state; set it by flow.viscous.substeps"),
                ("lesson_tubes", ("--set", "flow.viscous.substeps=2"), "a step has 2 sub-steps, and hw.substeps is 1"),
                ("lesson_spread", ("--set", "hw.lanes=3"), "hw.lanes is 1, 2, 4, 8 or 16"),
                ("cello", ("--set", "hw.cascade=2"), "where pieces fall, hw.cascade is 1")):
            done = voxmelt("rtl", SCENES / f"{scene}.toml", "--out", self.folder / "rtl", *options)
            self.assertEqual(done.returncode, 2, scene)
            self.assertIn(words, done.stderr)
            self.assertFalse((self.folder / "rtl").exists())
        done = voxmelt("rtl", SCENES / "cello.toml")
        self.assertEqual((done.returncode, done.stderr), (2, "error: --out DIR: the folder that is written must be named\n"))


@unittest.skipUnless(shutil.which("verilator"), "skipped: `apt-get install verilator`")
class Large(Written):
    def test_behind_axi4_stream(self):
        scene = write(self.folder, SMALL)
        folder = Path(self.written(scene, "--from", 8, "--passes", 2, "--set", "hw.lanes=1", "--set", "hw.cascade=1"))
        self.passes(folder, 2 * 12 * 10 * 12, "AXI=1")
        wrapper = folder / "axi_pipeline.sv"
        wrapper.write_text(wrapper.read_text().replace("left == 32'd0 ? TOKENS - 32'd1", "left == 32'd0 ? TOKENS - 32'd2"))
        done = make(folder, "AXI=1")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("token 2878: TLAST is 1", done.stdout)

    def test_radiation_and_pieces(self):
        self.check("bunny_small", 500, passes=1, lanes=8, cascade=1)

    def test_air_vents_freezing_and_drains(self):
        self.check("proving_ground", 30, passes=2, lanes=4, cascade=2)

    def test_one_lane_without_heat(self):
        self.check("lesson_spread", 20, passes=2, lanes=1, cascade=3)

    def test_sub_steps(self):
        self.check("bunny_small_viscous", 500, 1, 4, 1, "--set", "flow.viscous.substeps=2", "--set", "hw.substeps=2",
                   "--set", "pieces.fall=false", size=(35, 28, 38))

    def check(self, scene, first, passes, lanes, cascade, *options, size=None):
        path = SCENES / f"{scene}.toml"
        x, y, z = size or map(int, re.search(r"size = \[(\d+), (\d+), (\d+)\]", path.read_text()).groups())
        folder = self.written(path, "--from", first, "--passes", passes, "--set", f"hw.lanes={lanes}",
                              "--set", f"hw.cascade={cascade}", *options)
        self.passes(folder, passes * -(-x // lanes) * y * z, "BLOCKS=1")


if __name__ == "__main__":
    cases = [Large] if "--large" in sys.argv else [Small, Refused]
    tests = unittest.TestSuite(unittest.TestLoader().loadTestsFromTestCase(case) for case in cases)
    sys.exit(not unittest.TextTestRunner(verbosity=2).run(tests).wasSuccessful())
