#!/usr/bin/env python3
"""`voxmelt plot`: its curves are those of steps.csv.

  plot_test.py PROGRAM
"""
import csv
import re
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

from program import SMALL, voxmelt, write

SVG = "{http://www.w3.org/2000/svg}"


class Plot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        write(cls.folder, SMALL)
        for name, gamma in (("slow", "0.05"), ("fast & hot", "0.2")):
            done = voxmelt("run", "scene.toml", "--set", f"heat.gamma={gamma}", "--steps", 60, "--write", "csv", "--write-every", 4,
                           "--out", f"out/{name}", cwd=cls.folder)
            assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def plot(self, *arguments, code=0):
        done = voxmelt("plot", *arguments, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def drawn(self, file="plot.svg"):
        root = xml.parse(self.folder / file).getroot()
        self.assertEqual(root.tag, SVG + "svg")
        panels = {}
        for group in root.findall(SVG + "g"):
            paths = group.find(SVG + "g").findall(SVG + "path")
            panels[group.find(SVG + "text").text] = [
                [tuple(map(float, pair.split())) for pair in re.split("[ML]", path.get("d"))[1:]] for path in paths]
        return root, panels

    def column(self, run, name):
        with open(self.folder / f"out/{run}/steps.csv") as file:
            return [(int(row["step"]), int(row[name])) for row in csv.DictReader(file)]

    def test_curves_are_the_columns(self):
        self.plot("out/slow", "out/fast & hot", "--columns", "liquid_cells,heat")
        root, panels = self.drawn()
        self.assertEqual(list(panels), ["liquid_cells", "heat"])
        self.assertEqual([t.text for t in root.findall(SVG + "text")], ["slow", "fast & hot"])
        for name, curves in panels.items():
            # The same straight scale holds for both curves: found from the first, it gives the places of all.
            rows = [self.column(run, name) for run in ("slow", "fast & hot")]
            low, high = min(rows[0], key=lambda r: r[1]), max(rows[0], key=lambda r: r[1])
            self.assertGreater(high[1], low[1], "nothing changed: the test would prove nothing")
            (x0, _), (x1, _) = curves[0][0], curves[0][-1]
            y_low, y_high = (curves[0][rows[0].index(row)][1] for row in (low, high))
            self.assertLess(y_high, y_low, "more is higher up")
            for row, curve in zip(rows, curves):
                self.assertEqual(len(row), len(curve))
                for (step, value), (x, y) in zip(row, curve):
                    self.assertAlmostEqual(x, x0 + (x1 - x0) * step / 60, delta=0.11)
                    self.assertAlmostEqual(y, y_low + (y_high - y_low) * (value - low[1]) / (high[1] - low[1]), delta=0.5)
            self.assertNotEqual(curves[0], curves[1])

    def test_usual_columns_are_those_that_change(self):
        self.plot("out/slow/steps.csv", "--out", "one.svg")
        self.assertEqual(set(self.drawn("one.svg")[1]), {"solid_cells", "liquid_cells", "energy", "heat"})

    def test_what_cannot_be_drawn(self):
        self.plot("out/slow", "--out", "kept.svg")
        (self.folder / "other.csv").write_text("step,a\n0,1\n1\n")
        (self.folder / "empty.csv").write_text("step,a\n")
        for arguments, word in ((["out/none"], "out/none: error: is not there"), (["other.csv"], "is no table of steps"),
                                (["empty.csv"], "has no rows"), (["out/slow", "--columns", "liquid"], "there are step, seconds_per_step"),
                                (["out/slow", "--out", "nowhere/plot.svg"], "there is no folder"), (["scene.toml"], "is no table")):
            with self.subTest(arguments):
                said = self.plot(*arguments, code=2).stderr
                self.assertEqual(len(said.splitlines()), 1)
                self.assertIn(word, said)


if __name__ == "__main__":
    unittest.main(argv=["plot_test"], verbosity=1)
