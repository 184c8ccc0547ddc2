#!/usr/bin/env python3
"""`voxmelt explore` of several scenes, of several values of a number, and what differs between two reports.

  explore_several_test.py PROGRAM
"""
import csv
import json
import tempfile
import unittest
from pathlib import Path

from program import SMALL, voxmelt, write

QUICK = ["--device", "ecp5-85f", "--steps", 8, "--set", "hw.overlap=1", "--set", "hw.coded=0", "--set", "hw.clock_mhz=100"]
SHARED = ("lanes", "cascade", "substeps", "fifo_depth", "overlap", "coded", "clock_mhz")


class Several(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.scenes = [write(self.folder, SMALL.replace("[12, 10, 12]", size), f"{name}.toml")
                       for name, size in (("flat", "[48, 8, 12]"), ("high", "[13, 60, 10]"))]

    def explore(self, *arguments, code=0):
        result = voxmelt("explore", *arguments, cwd=self.folder, timeout=400)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result.stdout

    def table(self, name):
        return list(csv.DictReader((self.folder / name).read_text().splitlines()))

    def every_design(self):
        """Of each scene alone: the best speed of each design that fits, whatever its tiles."""
        designs, lanes, found = [], set(), []
        for scene in self.scenes:
            self.explore(scene, *QUICK, "--points", 0, "--out", "alone")
            lanes |= {int(row["lanes"]) for row in self.table("alone/explore.csv")}
        for scene in self.scenes:
            of_scene = {}
            for one in sorted(lanes):
                self.explore(scene, *QUICK, "--points", 0, "--out", "alone", "--set", f"hw.lanes={one}")
                for row in self.table("alone/explore.csv"):
                    key = tuple(int(row[name]) for name in SHARED)
                    if row["fits"] == "1":
                        of_scene[key] = max(of_scene.get(key, 0), int(row["cell_steps_per_second"]))
            found.append(of_scene)
        return found

    def test_one_design_for_two_scenes(self):
        alone = self.every_design()
        cells = (48 * 8 * 12 * 8, 13 * 60 * 10 * 8)
        best = [max(one.values()) for one in alone]
        shared = {key: [one[key] for one in alone] for key in alone[0] if key in alone[1]}
        seconds = {key: sum(c / s for c, s in zip(cells, speeds)) for key, speeds in shared.items()}
        shares = {key: min(s / b for s, b in zip(speeds, best)) for key, speeds in shared.items()}
        for aim, wanted in (("sum", min(seconds.values())), ("worst", max(shares.values()))):
            with self.subTest(aim):
                said = self.explore(*self.scenes, *QUICK, "--points", 1, "--for", aim, "--out", "both")
                report = json.loads((self.folder / "both/explore.json").read_text())
                hw = tuple(report["best"]["hw"][name] for name in SHARED)
                self.assertAlmostEqual(seconds[hw] if aim == "sum" else shares[hw], wanted, delta=1e-6 * wanted)
                self.assertAlmostEqual(report["best"]["seconds"], seconds[hw], delta=1e-5 * seconds[hw])
                self.assertAlmostEqual(report["best"]["worst_share"], shares[hw], delta=1e-5)
                self.assertEqual([one["scene"] for one in report["scenes"]], ["flat", "high"])
                self.assertEqual([one["own"]["cell_steps_per_second"] for one in report["scenes"]], best)
                self.assertEqual([one["simulated"]["state"] for one in report["scenes"]], ["verified"] * 2)
                self.assertIn("the least sum of times" if aim == "sum" else "the greatest of the worst shares", said)
                rows = self.table("both/explore.csv")
                self.assertEqual({tuple(int(row[name]) for name in SHARED) for row in rows}, set(shared))
                for row in rows:
                    key = tuple(int(row[name]) for name in SHARED)
                    self.assertEqual([int(row[f"{name}_cell_steps_per_second"]) for name in ("flat", "high")], shared[key])

    def test_a_number_takes_several_values(self):
        """Each line is the answer for that value alone."""
        for key, values, text in (("memory.channels", [1, 2, 4], "1..4"), ("device.bram", [40, 70, 100], "40..100+30"),
                                  ("family.stage.gravity.lut", [700, 20000], "700,20000")):
            with self.subTest(key):
                self.explore(self.scenes[0], *QUICK, "--sweep", f"{key}={text}", "--out", "swept")
                rows = self.table("swept/sweep.csv")
                self.assertEqual([int(row[key]) for row in rows], values)
                for row in rows:
                    self.explore(self.scenes[0], *QUICK, "--points", 0, "--set", f"{key}={row[key]}", "--out", "alone")
                    report = json.loads((self.folder / "alone/explore.json").read_text())
                    self.assertEqual(int(row["cell_steps_per_second"]), report["best"]["cell_steps_per_second"])
                    for end in ("better", "worse"):
                        point = report["ranges"]["all"][end]
                        self.assertEqual(int(row[end]), point["cell_steps_per_second"] if point else 0)
        speeds = [int(row["cell_steps_per_second"]) for row in rows]
        self.assertGreater(speeds[0], speeds[1])

    def test_the_highest_clock_is_the_one_that_is_tried(self):
        every_clock = QUICK[:QUICK.index("hw.clock_mhz=100") - 1]
        self.explore(self.scenes[0], *every_clock, "--sweep", "device.clock=60,100", "--out", "swept")
        rows = self.table("swept/sweep.csv")
        self.assertEqual([row["clock_mhz"] for row in rows], ["60", "100"])
        for row in rows:
            self.explore(self.scenes[0], *every_clock, "--points", 0, "--set", f"device.clock={row['device.clock']}",
                         "--out", "alone")
            report = json.loads((self.folder / "alone/explore.json").read_text())
            self.assertEqual(int(row["cell_steps_per_second"]), report["best"]["cell_steps_per_second"])

    def test_what_differs(self):
        for name, more in (("a", []), ("b", ["--set", "device.dsp=30"])):
            self.explore(self.scenes[0], *QUICK, "--points", 0, *more, "--out", name)
        a, b = (json.loads((self.folder / name / "explore.json").read_text())["best"] for name in ("a", "b"))
        said = self.explore("--compare", "a/explore.json", "b/explore.json", "--report", "diff.json")
        report = json.loads((self.folder / "diff.json").read_text())
        self.assertEqual([one for one in report["asked"] if not one["path"].startswith("available")], [])
        self.assertIn({"path": "available.dsp", "a": "156", "b": "30"}, report["asked"])
        answered = {one["path"]: (one["a"], one["b"]) for one in report["answered"]}
        speeds = tuple(str(one["cell_steps_per_second"]) for one in (a, b))
        self.assertEqual(answered["best.cell_steps_per_second"], speeds)
        self.assertIn(f"x {int(speeds[1]) / int(speeds[0]):.3f}", said)
        self.assertNotIn("seconds:", said)
        same = self.explore("--compare", "a/explore.json", "a/explore.json")
        self.assertIn("what was asked: the same\nwhat was answered: the same\n", same)

    def test_bad_usage(self):
        write(self.folder, "{}", "other.json")
        for arguments, message in ((["--compare", "other.json"], "needs two reports"),
                                   (["--compare", "other.json", "other.json"], "no report of `voxmelt explore`"),
                                   (["--compare", "x.json", "other.json"], "x.json"),
                                   ([self.scenes[0]], "--device is required"), (["--device", "zu7ev"], "scene is required"),
                                   ([self.scenes[0], *QUICK, "--sweep", "hw.lanes=1..4"], "hw.lanes"),
                                   ([self.scenes[0], *QUICK, "--sweep", "memory.channels=3"], "not a power of 2"),
                                   ([self.scenes[0], *QUICK, "--sweep", "device.clock=9..1"], "ends before it begins"),
                                   ([*self.scenes, *QUICK, "--sweep", "device.clock=90"], "one scene"),
                                   ([self.scenes[0], *QUICK, "--memory", "none", "--set", "memory.channels=2"], "--memory none")):
            result = voxmelt("explore", *arguments, "--out", "none", cwd=self.folder)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(message, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
            self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main(argv=["explore_several_test"], verbosity=1)
