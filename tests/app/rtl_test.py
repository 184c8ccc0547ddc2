#!/usr/bin/env python3
"""`voxmelt verify --rtl`: stages in SystemVerilog in the places of their models, and what is refused.

  rtl_test.py PROGRAM
"""
import re
import sys
import tempfile
import unittest
from pathlib import Path

from program import SMALL, voxmelt, write

SCENES = Path(__file__).resolve().parents[2] / "scenes"


class Rtl(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        asked = cls.verify("lesson_gravity", "--rtl", "all")
        if "built without Verilator" in asked.stderr:
            raise unittest.SkipTest("skipped: this program was built without Verilator")

    @staticmethod
    def verify(scene, *options, lanes=4):
        return voxmelt("verify", SCENES / f"{scene}.toml", "--steps", 2, "--set", f"hw.lanes={lanes}", *options)

    def test_every_stage_of_a_scene(self):
        for scene, first, lanes in ("lesson_oven", 300, 4), ("lesson_spread", 100, 1), ("proving_ground", 40, 4), (
                "proving_ground_viscous", 40, 4), ("paper_literal", 200, 4), ("paper_literal_printed", 200, 1):
            done = self.verify(scene, "--from", first, "--rtl", "all", lanes=lanes)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertRegex(done.stdout, r"\d{4,} cells compared .*: no difference; digest [0-9a-f]{16}")
            self.assertRegex(done.stdout, r"\d{3,} cycles beside the models: both sides of every channel did the same")

    def test_one_of_them_gives_what_the_models_give(self):
        digest = re.compile(r"digest ([0-9a-f]{16})")
        models = digest.search(self.verify("lesson_oven", "--from", 300).stdout)[1]
        for stages in "gravity", "melt,exchange":
            done = self.verify("lesson_oven", "--from", 300, "--rtl", stages)
            self.assertEqual((done.returncode, digest.search(done.stdout)[1]), (0, models))

    def test_a_fault_of_a_model_stands_alone(self):
        for scene, first, faults in (
                ("proving_ground", 40, ("side-missed", "axis-uncounted", "air-axis-missed", "gravity-mix",
                                        "gravity-room", "pattern-margin", "apply-flow-lost", "drain-energy")),
                ("proving_ground_viscous", 40, ("vent-rate", "settle-head", "settle-run-broken", "gravity-set-falls",
                                                "viscous-flow-lost", "viscous-across"))):
            for fault in faults:
                done = self.verify(scene, "--from", first, "--rtl", "all", "--plant", fault)
                planted = re.search(r"planted: (\S+?)[, ].*; found there\n", done.stdout)
                self.assertEqual((done.returncode, planted is not None), (1, True), fault + done.stdout + done.stderr)
                alone = re.search(r"SystemVerilog agrees with the software: the model of (\S+) stands alone", done.stdout)
                self.assertIsNotNone(alone, fault + done.stdout)
                self.assertEqual(alone[1], planted[1], fault)

    def test_what_is_refused(self):
        for options, words in (
                (("--rtl", "gravit"), "error: --rtl gravit: of the stages of this scene, these are written in "
                                      "SystemVerilog: conduction, convection, exchange, melt, gravity, pattern, apply"),
                (("--rtl", "all", "--machine"), "error: --rtl: only of the pipeline alone")):
            done = self.verify("lesson_oven", *options)
            self.assertEqual((done.returncode, done.stderr.strip()), (2, words), options)
        done = self.verify("lesson_oven", "--rtl", "all", lanes=3)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"error: --rtl: stages in SystemVerilog are compiled for [0-9, ]+ lanes, not for 3")

    def test_several_materials(self):
        """In mid-melt, where heat moves along runs of liquid, which holds settle."""
        done = self.verify("chocolate_nuts", "--from", 1500, "--rtl", "conduction,melt,settle,spread")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"\d{7,} cells compared .*: no difference; digest [0-9a-f]{16}")
        self.assertGreater(float(re.search(r"predicted without stalls \d+ \(\+([\d.]+) %\)", done.stdout)[1]), 10)

    def test_a_grid_that_is_too_low(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = write(folder, SMALL.replace("size = [12, 10, 12]", "size = [16, 5, 8]"))
            done = voxmelt("verify", scene, "--steps", 1, "--set", "hw.lanes=4", "--rtl", "all")
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertIn("a column of 5 cells and a plane of 20 tokens are too short for its registers", done.stderr)

    def test_a_plane_of_one_block(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = SMALL.replace("size = [12, 10, 12]", "size = [4, 18, 12]").replace("at = [6, 4, 6]", "at = [2, 4, 6]")
            scene = write(folder, scene.replace('law = "paper"', 'law = "viscous"\n[flow.viscous]\nkappa = 0.01'))
            done = voxmelt("verify", scene, "--steps", 1, "--set", "hw.lanes=4", "--rtl", "all")
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertIn("spread in SystemVerilog: a plane has several blocks", done.stderr)
            done = voxmelt("verify", scene, "--steps", 2, "--set", "hw.lanes=1", "--rtl", "all")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
