#!/usr/bin/env python3
"""`voxmelt accuracy`: what it writes can be read, a wrong rule ends it with 1, bad use ends in one line."""
import csv
import json
import tempfile
import unittest
from pathlib import Path

from program import voxmelt

KEYS = {"name", "setting", "quantity", "value", "exact", "error", "error_is", "gate", "passed", "cells_per_second",
        "baseline_cells_per_second", "state_bits", "note"}


class Accuracy(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def accuracy(self, *arguments):
        result = voxmelt("accuracy", "--quick", *arguments, cwd=self.folder, timeout=600)
        return result, json.loads((self.folder / "r.json").read_text())

    def test_a_case_that_holds(self):
        result, report = self.accuracy("--case", "slab", "--out", "out", "--report", "r.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(report, json.loads((self.folder / "out/accuracy.json").read_text()))
        self.assertTrue(report["passed"])
        for case in report["cases"]:
            self.assertEqual(set(case), KEYS)
            self.assertEqual(case["name"], "slab")
            self.assertGreater(case["cells_per_second"], 0)
            self.assertGreater(case["baseline_cells_per_second"], 0)
            self.assertEqual(case["state_bits"], 50)  # two masks, amount, heat, energy
            self.assertEqual(case["passed"], abs(case["error"]) <= case["gate"])
        # The table's line says what the report says.
        self.assertIn("passed", result.stdout)
        self.assertIn(f"{report['gates']} of {report['gates']} gates passed", result.stdout)
        rows = list(csv.DictReader((self.folder / "out/accuracy.csv").open()))
        self.assertEqual(len(rows), len(report["cases"]))
        for row, case in zip(rows, report["cases"]):
            self.assertEqual(float(row["error"]), case["error"])
            self.assertEqual(row["setting"], case["setting"])

    # A column that conducts a tenth less, or under a colder wall, is wrong physics.
    def test_a_planted_rule_ends_with_1(self):
        for planted in ("heat.gamma=0.27", "inert.0.temperature=0.85"):
            result, report = self.accuracy("--case", "slab", "--set", planted, "--report", "r.json")
            self.assertEqual(result.returncode, 1, planted)
            self.assertIn("MISSED", result.stdout)
            self.assertFalse(report["passed"])
            self.assertEqual(report["missed"], 1)
            self.assertEqual(report["set"], [planted])

    def test_the_front(self):
        result, report = self.accuracy("--front", "goblet", "--out", "out", "--report", "r.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        points, scene = report["points"], report["scenes"][0]
        self.assertIn(f"{len(points)} points", result.stdout)
        rows = list(csv.DictReader((self.folder / "out/front.csv").open()))
        self.assertEqual([row["name"] for row in rows], [point["name"] for point in points])
        curves = ("liquid_error", "heat_error", "height_error", "radius_error")
        for row, point in zip(rows, points):
            self.assertEqual(point["scene"], "goblet")
            self.assertEqual(float(row["error"]), point["error"])
            self.assertEqual(point["error"], max(point[key] for key in (*curves, "map_error")))
        # The picks by their definition, from the report alone. The goblet has one axis to pick from.
        steps = [p for p in points if p["axis"] == "step" and not p["reference"]]
        usual = next(p for p in steps if p["usual"])
        self.assertEqual([pick["bound"] for pick in scene["picks"]], [0.05, 0.01, 0.001])
        for pick in scene["picks"]:
            alone = scene["noise_of_map"] > pick["bound"]
            self.assertEqual(pick["curves_alone"], alone)
            errors = {p["step"]: max(p[key] for key in curves) if alone else p["error"] for p in steps}
            kept = [p for p in steps if max(errors[p["step"]], scene["noise_of_curves"]) <= pick["bound"]]
            best = kept[0] if kept else usual  # the coarsest
            self.assertEqual(pick["without"], [] if kept else ["step"])
            self.assertEqual(pick["setting"] and pick["setting"]["step"], best["step"] if kept else None)
            self.assertEqual(pick["error_sum"], errors[best["step"]])
        page = (self.folder / "out/front.html").read_text()
        self.assertNotIn("http", page)
        self.assertIn("Which setting to take", page)
        self.assertTrue((self.folder / "out/front.md").read_text().startswith("<!-- Written by"))

    def test_bad_use_of_the_front(self):
        for arguments, said in ((["--front", "swan"], "--front swan"), (["--front", "--case", "slab"], "exclude")):
            result = voxmelt("accuracy", *arguments, cwd=self.folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn(said, result.stderr)

    def test_no_result_but_the_speed_depends_on_who_computes(self):
        found = []
        for more in (["--implementation", "reference"], ["--threads", 2]):
            _, report = self.accuracy("--case", "slab", "--case", "shadow_edge", *more, "--report", "r.json")
            found.append([{k: v for k, v in case.items() if "per_second" not in k} for case in report["cases"]])
        self.assertEqual(found[0], found[1])
        self.assertEqual({case["name"] for case in found[0]}, {"slab", "shadow_edge"})

    def test_list_cases(self):
        lines = voxmelt("list", "cases", cwd=self.folder).stdout.splitlines()
        names = [line.split()[0] for line in lines]
        self.assertEqual(len(names), len(set(names)))
        self.assertIn("stefan", names)

    def test_bad_use(self):
        for arguments, why in [
            (["--case", "no_such_case"], "unknown"),
            (["--implementation", "quantum"], "unknown; this build has"),
            (["--case", "slab", "--set", "heat.gama=1"], "gama"),
            (["--report", "no/such/folder.json"], "there is no folder"),
            (["stray"], "stray"),
        ]:
            result = voxmelt("accuracy", "--quick", *arguments, cwd=self.folder)
            self.assertEqual(result.returncode, 2, (arguments, result.stderr))
            self.assertIn(why, result.stderr)
            self.assertLess(len(result.stderr.splitlines()), 4, result.stderr)


if __name__ == "__main__":
    unittest.main(argv=["accuracy_test"], verbosity=1)
