#!/usr/bin/env python3
"""`voxmelt explore` over the ranges of its numbers: the best design at the ends is that of a plain answer for which
these numbers were set.

  explore_ranges_test.py PROGRAM         on one device, the end that decides most
  explore_ranges_test.py PROGRAM --all   on two, at both ends of three numbers
"""
import csv
import json
import sys
import tempfile
import unittest
from pathlib import Path

from program import SMALL, voxmelt, write

QUICK = ["--points", 0, "--steps", 8, "--set", "hw.fifo_depth=2", "--set", "hw.overlap=1", "--set", "hw.coded=0"]
WHOLE = "--all" in sys.argv


class Ranges(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.scene = write(self.folder, SMALL.replace("[12, 10, 12]", "[48, 40, 12]"))

    def explore(self, *arguments):
        result = voxmelt("explore", self.scene, *QUICK, *arguments, "--out", "out", cwd=self.folder, timeout=400)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads((self.folder / "out/explore.json").read_text()), result.stdout

    def plain(self, device, numbers):
        """The best speed where these numbers are set."""
        sets = [word for name, value in numbers for word in ("--set", f"{name}={value:g}")]
        report, _ = self.explore(*device, *sets)
        self.assertEqual(len(report["ranges"]["alone"]) + len(numbers), self.weighed, "a number that is set has no range")
        return report["best"]["cell_steps_per_second"] if report["best"] else None

    def speed(self, point):
        return point["cell_steps_per_second"] if point else None

    def test_the_ends_are_plain_answers(self):
        devices = (["--device", "ecp5-85f", "--memory", "none"], ["--device", "zu7ev", "--set", "device.lut=60000"])
        for device in devices if WHOLE else devices[:1]:
            with self.subTest(device):
                report, said = self.explore(*device)
                ranges = report["ranges"]
                alone = ranges["alone"]
                self.weighed = len(alone)
                self.assertGreater(len(alone), 20)
                for end in ("better", "worse"):
                    every = [(one["name"], one[end]) for one in alone]
                    self.assertEqual(self.speed(ranges["all"][end]), self.plain(device, every), end)
                spans = [(self.speed(one["best"]["better"]) or 0) - (self.speed(one["best"]["worse"]) or 0) for one in alone]
                self.assertEqual(spans, sorted(spans, reverse=True))
                self.assertGreater(spans[0], 0)
                for one in alone[:2] + alone[-1:] if WHOLE else alone[:1]:
                    for end in ("better", "worse"):
                        self.assertEqual(self.speed(one["best"][end]), self.plain(device, [(one["name"], one[end])]), one)
                self.assertIn(f"{alone[0]['name']} decides most", said)
                low, high = ((self.speed(ranges["all"][end]) or 0) / 1e9 for end in ("worse", "better"))
                self.assertIn(f"Over the ranges of {len(alone)} numbers the best design has {low:.3f} to {high:.3f} Gcell", said)

    def test_designs_are_as_full_as_they_may_be(self):
        report, _ = self.explore("--device", "ecp5-85f")
        rows = list(csv.DictReader((self.folder / "out/explore.csv").read_text().splitlines()))
        for row in rows:
            self.assertLessEqual(float(row["fullest_better"]), float(row["fullest"]))
            self.assertLessEqual(float(row["fullest"]), float(row["fullest_worse"]))
        hw = report["best"]["hw"]
        best = next(row for row in rows if all(int(row[key]) == value for key, value in hw.items()))
        slow = hw["clock_mhz"] > next(one for one in report["ranges"]["alone"] if one["name"] == "device.clock")["worse"]
        self.assertEqual(report["ranges"]["keeps_best"], float(best["fullest_worse"]) <= 1 and not slow)
        picture = (self.folder / "out/explore.svg").read_text()
        changing = {one["name"] for one in report["ranges"]["alone"]
                    if self.speed(one["best"]["better"]) != self.speed(one["best"]["worse"])}
        drawn = {one["name"] for one in report["ranges"]["alone"] if f">{one['name']}<" in picture}
        self.assertLessEqual(drawn, changing)
        self.assertEqual(len(drawn), min(10, len(changing)), "bars are the widest ten")

    def test_a_range_of_ones_own(self):
        report, _ = self.explore("--device", "zu7ev", "--set", "family.stage.melt.lut=70", "--set",
                                 "family.stage.melt.lut_range=[60, 90]", "--set", "family.port.lut=800")
        alone = {one["name"]: one for one in report["ranges"]["alone"]}
        melt = alone["family.stage.melt.lut"]
        self.assertEqual((melt["value"], melt["better"], melt["worse"]), (70, 60, 90))
        self.assertNotIn("family.port.lut", alone)
        self.assertIn("family.port.ff", alone)

    def test_bad_numbers(self):
        for name, message in (("family.stage.melt.lut_range=[1, 2]", "[1, 2] does not hold lut = "),
                              ("family.stage.melt.luts=3", "stage.melt.luts"), ("device.clock_range=[1, 2, 3]", "clock_range"),
                              ("family.port.source=\"guessed\"", "must begin with synthesised, counted or assumed")):
            result = voxmelt("explore", self.scene, "--device", "zu7ev", "--set", name, *QUICK, "--out", "none", cwd=self.folder)
            self.assertEqual(result.returncode, 2, name)
            self.assertIn(message, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
            self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main(argv=["explore_ranges_test"], verbosity=1)
