#!/usr/bin/env python3
"""`voxmelt bench`: the quick run works, what it writes can be read, bad use ends in one line."""
import csv
import json
import os
import re
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

from program import SMALL, voxmelt, write

ROOT = Path(__file__).resolve().parents[2]
CASE = re.compile(r"^(flow|heat)/[\w.]+/[\w:/.]+/threads:\d+$")


class Bench(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def bench(self, *arguments):
        result = voxmelt("bench", *arguments, cwd=self.folder, timeout=600)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_quick_run(self):
        text = self.bench("--quick", "--threads", 1, "--out", "out", "--report", "report.json")
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report, json.loads((self.folder / "out/bench.json").read_text()))

        machine = report["machine"]
        self.assertGreater(len(machine["lanes_16_bit"]), 0)
        for rate in machine["lanes_16_bit"]:
            self.assertGreater(rate["multiply_lanes_per_second"], 0)
            self.assertGreater(rate["add_lanes_per_second"], 0)
        self.assertTrue(all(b["copy_bytes_per_second"] > 0 for b in machine["bandwidth"]))

        names = [case["name"] for case in report["cases"]]
        self.assertEqual(len(names), len(set(names)))
        for case in report["cases"]:
            self.assertRegex(case["name"], CASE)
            self.assertEqual(case["checked_against"], "reference")
            self.assertGreater(case["cells_per_second"], 0)
            self.assertGreater(case["bytes_per_cell"], 0)
            self.assertIn("percent_of_roof", case)
            if case["percent_of_roof"] is not None:
                self.assertGreater(case["percent_of_roof"], 0)
            self.assertGreaterEqual(case["rounds"], 3)
            self.assertGreaterEqual(case["median_milliseconds"], 0.999 * case["milliseconds"], "no round beats the least")
            self.assertGreater(case["ratio_to_baseline"], 0)
            if case["ratio_to_native_baseline"] is not None:  # null where it was compiled for another processor
                self.assertGreater(case["ratio_to_native_baseline"], 0)
        kinds = {case["workload"].split(":")[0] for case in report["cases"]}
        self.assertEqual(kinds, {"scene", "dense", "asleep"})
        # Where there is something to do, and only there, there is a roof.
        for case in report["cases"]:
            self.assertEqual(case["roof"] is None, case["workload"].startswith("asleep"))

        # A scene under the paper's law is bounded by a full volume that this run has timed.
        bounded = [case for case in report["cases"] if case["needed"]]
        self.assertEqual({case["workload"].split("/")[0] for case in bounded}, {"scene:bunny_small"})
        for case in bounded:
            self.assertGreater(case["needed"]["milliseconds_at_full_volume_speed"], 0)
            self.assertGreater(case["needed"]["gravity_vectors"], 0)

        # The table: every number stands in a column of its own.
        lines = [line.split() for line in text.splitlines() if re.match(r"  (flow|heat) ", line)]
        self.assertEqual(len(lines), len(names))
        for line in lines:
            self.assertEqual(len(line), 18 if line[0] == "flow" else 16, line)

        with open(self.folder / "out/bench.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(names))
        for row, case in zip(rows, report["cases"]):
            self.assertEqual(case["name"], f'{row["subject"]}/{row["implementation"]}/{row["workload"]}/threads:{row["threads"]}')
            self.assertAlmostEqual(float(row["milliseconds"]), case["milliseconds"])
            for phase, value in case["phase_milliseconds"].items():
                self.assertAlmostEqual(float(row[f"{phase}_milliseconds"]), value)
            self.assertEqual(row["percent_of_roof"] == "", case["percent_of_roof"] is None)
            self.assertAlmostEqual(float(row["ratio_to_baseline"]), case["ratio_to_baseline"])

        tables = (self.folder / "out/performance_tables.md").read_text()
        for name in ("machine", "scenes", "dense", "bounds", "densebounds", "picture", "memory", "rates", "flow", "heat", "scaling", "roofs", "drawing",
                     "drawings", "grids", "films"):
            self.assertIn(f"<!-- table: {name} -->", tables)
        for block in re.findall(r"(?:^\|.*\n)+", tables, re.M):
            self.assertEqual(len({row.count("|") for row in block.splitlines()}), 1, block)
        svg = xml.parse(self.folder / "out/roofline.svg").getroot()
        self.assertTrue(svg.tag.endswith("svg"))

        # Each picture, part by part.
        self.assertEqual([one["workload"].split("/")[0] for one in report["pictures"]],
                         ["scene:bunny_small", "scene:bunny_small_viscous"])
        for one in report["pictures"]:
            self.assertEqual(one["checked_against"], "plain painter")
            self.assertGreater(one["bricks_filtered"], 0)
            self.assertTrue(0 < one["rays"]["fast"] < one["rays"]["normal"] < one["rays"]["best"])
            self.assertLessEqual(one["rays"]["fast"], one["side"] ** 2)
            sets = [timing["instruction_set"] for timing in one["timings"]]
            self.assertEqual(sets, [name for name in ("sse4.2", "avx2", "avx512", "neon") if name in sets])
            for timing in one["timings"]:
                for part in ("field", "light_and_bricks", "fast", "normal", "best"):
                    self.assertGreater(timing[part], 0)
                self.assertAlmostEqual(timing["fast_nanoseconds_per_ray"], 1e6 * timing["fast"] / one["rays"]["fast"])
        pictures = [line.split() for line in text.splitlines() if line.startswith("  picture ")]
        self.assertEqual(len(pictures), sum(len(one["timings"]) for one in report["pictures"]))
        for line in pictures:
            self.assertEqual(len(line), 11, line)

        self.pages(self.folder / "out")

    def test_grids_and_films(self):
        text = self.bench("--quick", "--parts", "grids,film", "--scenes", "bunny_small,bunny_small_viscous", "--report", "report.json")
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual((report["cases"], report["pictures"]), ([], []))
        grids, films = report["finer_grids"], report["films"]
        names = [grid["workload"].split("/")[0] for grid in grids]
        self.assertEqual(set(names), {"scene:bunny_small", "scene:bunny_small_viscous"})
        for grid in grids:
            before = [one for one in grids if one["instruction_set"] == grid["instruction_set"] and one != grid]
            if grid["workload"].startswith("scene:bunny_small/"):
                self.assertIsNone(grid["growth_of_normal"])
            else:
                self.assertAlmostEqual(grid["growth_of_normal"], grid["normal"] / before[0]["normal"])
        self.assertEqual([film["scene"] for film in films], ["bunny_small", "bunny_small_viscous"])
        for film in films:
            self.assertEqual(film["steps"], 1000)
            self.assertAlmostEqual(film["frames_per_second"], film["frames"] / film["seconds"])
        self.assertEqual(len([line for line in text.splitlines() if line.startswith("a whole melt")]), 2)

    def pages(self, out):
        """The pages of docs come from these files, and the one that people read stays short."""
        stub = self.folder / "voxmelt"  # bench --out FOLDER
        stub.write_text(f'#!/bin/sh\ncp -r "{out}" "$3"\n')
        stub.chmod(0o755)
        docs = self.folder / "docs"
        result = subprocess.run([ROOT / "bench/write_performance.sh", stub], capture_output=True, text=True,
                                env={**os.environ, "WRITE_TO": str(docs)})
        self.assertEqual(result.returncode, 0, result.stderr)
        short = (docs / "results/performance.md").read_text()
        full = (docs / "results/performance_tables.md").read_text()
        picture = (docs / "results/performance_picture.md").read_text()
        for page, heading in ((short, "| scene | million cells |"), (short, "| subject | volume |"),
                              (short, "| scene | program |"), (full, "| footprint | threads |"),
                              (full, "| Feature | A scene without it |"), (full, "| **in all** |"), (full, "| scene | instruction set | threads | field, ms |"),
                              (picture, "| scene | instruction set | threads | field, ms |"),
                              (picture, "| scene | grid | instruction set |"), (picture, "| scene | steps | frames |"),
                              (picture, "| scene | drawn by | ms | dB |")):
            self.assertIn(heading, page)
        for page in (short, full, picture):
            self.assertTrue(page.startswith("<!-- Written by"))
            self.assertNotIn("{{", page)
        self.assertLessEqual(len(short.splitlines()), 120)
        self.assertTrue((docs / "gallery/roofline.svg").exists())

    def test_a_scene_of_ones_own(self):
        write(self.folder, SMALL)
        text = self.bench("--quick", "--scenes", "scene.toml", "--from", 4, "--implementation", "reference")
        self.assertIn("scene:scene/step:4", text)
        self.assertNotIn("dense", text)
        lines = [line.split() for line in text.splitlines() if line.startswith("  flow")]
        self.assertEqual([line[1] for line in lines], ["reference"])

    def test_bad_use(self):
        for arguments, why in [
            (["--implementation", "quantum"], "unknown; this build has"),
            (["--scenes", "no_such_scene"], "no scene named 'no_such_scene'"),
            (["--threads", "0"], "0"),
            (["--from", "-1"], "-1"),
            (["--report", "no/such/folder.json"], "there is no folder"),
            (["--parts", "paint"], "paint"),
            (["stray"], "stray"),
        ]:
            result = voxmelt("bench", "--quick", *arguments, cwd=self.folder)
            self.assertEqual(result.returncode, 2, (arguments, result.stderr))
            self.assertIn(why, result.stderr)
            self.assertLess(len(result.stderr.splitlines()), 4, result.stderr)


if __name__ == "__main__":
    unittest.main(argv=["bench_test"], verbosity=1)
