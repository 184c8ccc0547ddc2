#!/usr/bin/env python3
"""`voxmelt new`: each scene that it writes runs without a warning, melts or flows, and has a word for each number.

  new_test.py PROGRAM
"""
import json
import re
import tempfile
import unittest
from pathlib import Path

from program import voxmelt

KINDS = ("candle", "lava", "oven")


class New(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def test_each_runs_and_changes(self):
        for kind, steps in (("candle", 150), ("lava", 60), ("oven", 300)):
            with self.subTest(kind):
                made = voxmelt("new", kind, f"{kind}.toml", cwd=self.folder)
                self.assertEqual((made.returncode, made.stderr), (0, ""))
                self.assertIn(f"voxmelt run {kind}.toml", made.stdout)
                done = voxmelt("run", f"{kind}.toml", "--steps", steps, "--frame-every", 0, cwd=self.folder)
                self.assertEqual((done.returncode, re.findall("warning.*", done.stderr)), (0, []))
                report = json.loads((self.folder / f"out/{kind}/report.json").read_text())
                self.assertGreater(report["mass"]["liquid"], 0)
                self.assertEqual(report["mass"]["drift"], 0)

    def test_each_number_is_explained(self):
        for kind in KINDS:
            voxmelt("new", kind, "scene.toml", cwd=self.folder)
            text = (self.folder / "scene.toml").read_text()
            (self.folder / "scene.toml").unlink()
            explained = set(re.findall(r"(?m)^(\w+) = .*#", text))
            for name in re.findall(r"(?m)^(\w+) = [-\d.]+\s*$", text):
                self.assertIn(name, explained | {"thickness", "height", "radius"}, f"{kind} says nothing of {name}")

    def test_what_is_refused(self):
        (self.folder / "mine.toml").write_text("mine")
        (self.folder / "lost.toml").symlink_to("nowhere")
        for arguments, word in ((("wax", "a.toml"), "there are candle, lava, oven"), (("../candle", "a.toml"), "there are candle"),
                                (("candle", "mine.toml"), "mine.toml: error: is there already"), (("candle", "lost.toml"), "is there already"),
                                (("candle", "a.txt"), "ends with .toml"), (("candle", "none/a.toml"), "there is no folder"), (("candle",), "file is required")):
            with self.subTest(arguments):
                said = voxmelt("new", *arguments, cwd=self.folder)
                self.assertEqual((said.returncode, len(said.stderr.splitlines())), (2, 1), said.stderr)
                self.assertIn(word, said.stderr)
        self.assertEqual((self.folder / "mine.toml").read_text(), "mine")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["lost.toml", "mine.toml"])


if __name__ == "__main__":
    unittest.main(argv=["new_test"], verbosity=1)
