#!/usr/bin/env python3
"""`voxmelt sweep`: however its runs are made, and however often it is killed, the table is the same.

  sweep_test.py PROGRAM
"""
import csv
import fcntl
import json
import math
import os
import random
import shutil
import signal
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

from program import PROGRAM, SMALL, voxmelt, write

SIXTY = """title = "Sixty"
scene = "scene.toml"
[axes]
heat.gamma = [0.05, 0.1, 0.15]
heat_source.0.power = { from = 20, to = 60, count = 5 }
flow.paper.share = [0.05, 0.1, 0.15, 0.2]
[keep]
steps = 240
frame_every = 120
write = ["csv"]
write_every = 40
outputs = ["frames"]
checkpoint_every = "20"
"""
SEED = 41


def without_times(table):
    """The lines of a table without their last column."""
    lines = table.read_text().splitlines()
    assert lines[0].endswith(",seconds"), lines[0]
    return [line.rsplit(",", 1)[0] for line in lines]


class Sweep(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name).resolve()
        write(self.folder, SMALL)

    def plan(self, text, name="plan.toml"):
        return write(self.folder, text, name).name

    def sweep(self, *arguments, code=0):
        done = voxmelt("sweep", *arguments, cwd=self.folder, timeout=300)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def table(self, out="out/plan"):
        with open(self.folder / out / "table.csv") as file:
            return list(csv.DictReader(file))

    def shell(self, command):
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_killed_resumed_and_by_other_engines(self):
        plan, chance = self.plan(SIXTY), random.Random(SEED)
        self.sweep(plan, "--jobs", 2, "--quiet", "--out", "whole")
        whole = without_times(self.folder / "whole/table.csv")
        self.assertEqual(len(whole), 61)

        kills = resumed = 0
        while kills < 5:
            process = subprocess.Popen([PROGRAM, "sweep", plan, "--jobs", "2", "--out", "killed"], cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
            time.sleep(chance.uniform(0.1, 0.35))
            if process.poll() is not None:
                self.fail(f"it ended before it was killed, with {process.poll()}: {process.stderr.read()}")
            # A kill of the sweep alone, and of all that works for it.
            os.kill(process.pid, signal.SIGKILL) if kills % 2 else os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            process.stderr.close()
            kills += 1
            resumed += len(list(self.folder.glob("killed/runs/*/checkpoints/*"))) > 0
        self.assertLess(len(list(self.folder.glob("killed/runs/*/report.json"))), 60)
        self.sweep(plan, "--jobs", 2, "--out", "killed")
        self.assertEqual(without_times(self.folder / "killed/table.csv"), whole)
        print(f"seed {SEED}: {kills} kills, after {resumed} of them a run had a checkpoint to go on from")

        engines = [("make", "make -s -k -j 2 -f {}/Makefile")]
        if shutil.which("parallel"):
            engines.append(("parallel", "parallel --will-cite -j 2 < {}/commands.txt"))
        for engine, command in engines:
            with self.subTest(engine):
                said = self.sweep(plan, "--out", engine, "--emit", engine).stdout
                self.assertIn(f"{engine}/{'Makefile' if engine == 'make' else 'commands.txt'}", said)
                self.assertEqual(list(self.folder.glob(f"{engine}/runs/*")), [])
                self.shell(command.format(engine))
                self.sweep(plan, "--out", engine, "--gather")
                self.assertEqual(without_times(self.folder / engine / "table.csv"), whole)
                # What is complete is not made again.
                before = {path: path.stat().st_mtime_ns for path in self.folder.glob(f"{engine}/runs/*/report.json")}
                self.shell(command.format(engine))
                self.sweep(plan, "--out", engine)
                self.assertEqual(before, {path: path.stat().st_mtime_ns for path in before})

    # The first row is a run of its own, made without the sweep.
    def test_a_row_is_what_the_run_says(self):
        plan = self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.2]\nrun.seed = [3, 4, 5]\n')
        self.sweep(plan)
        rows = self.table()
        self.assertEqual([(r["heat.gamma"], r["run.seed"]) for r in rows],
                         [(g, s) for g in ("0.05", "0.2") for s in "345"])
        for row in rows:
            voxmelt("run", "scene.toml", "--set", f"heat.gamma={row['heat.gamma']}", "--seed", row["run.seed"],
                    "--out", "alone", "--report", "alone.json", cwd=self.folder)
            report = json.loads((self.folder / "alone.json").read_text())
            self.assertEqual((row["digest"], row["steps"]), (report["digest"], str(report["steps"])))
            for section in ("cells", "mass", "energy", "heat"):
                for key, value in report[section].items():
                    self.assertEqual(row[f"{section}_{key}"], str(value))
        self.assertGreater(len({row["digest"] for row in rows}), 1)
        kept = {path.name for path in (self.folder / "out/plan/runs/gamma_0.05__seed_3").iterdir()}
        self.assertLessEqual({"frames", "contact_sheet.png", "report.json", "last.vxc"}, kept)

    def test_only_what_is_asked_for_is_kept(self):
        plan = self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05]\n[keep]\nsteps = 4\noutputs = ["sheet"]\n'
                         'write = ["csv"]\nwrite_every = 2\nsize = "32x32"\nsetting = "fast"\n')
        self.sweep(plan)
        folder = self.folder / "out/plan/runs/gamma_0.05"
        self.assertEqual({p.name for p in folder.iterdir() if not p.name.startswith(".")},
                         {"contact_sheet.png", "report.json", "steps.csv"})
        self.assertEqual(json.loads((folder / "report.json").read_text())["steps"], 4)
        self.assertEqual([line.split(",")[0] for line in (folder / "steps.csv").read_text().splitlines()], ["step", "0", "2", "4"])

    # Each of N equal parts of each axis has one value.
    def test_a_latin_hypercube(self):
        text = ('scene = "scene.toml"\ndesign = "latin_hypercube"\nruns = 12\nseed = {}\n[keep]\nsteps = 0\nframe_every = 0\n[axes]\n'
                'heat.gamma = {{ from = 0.0, to = 0.24 }}\nheat_source.0.power = {{ from = 1, to = 1000, scale = "log" }}\n'
                'run.seed = {{ from = 1, to = 24 }}\nheat.visibility_every = [1, 2, 4]\n')
        self.sweep(self.plan(text.format(7)))
        rows = self.table()
        self.assertEqual(sorted(int(float(r["heat.gamma"]) / 0.02) for r in rows), list(range(12)))
        self.assertEqual(sorted(int(4 * math.log10(float(r["heat_source.0.power"]))) for r in rows), list(range(12)))
        self.assertEqual(sorted((int(r["run.seed"]) - 1) // 2 for r in rows), list(range(12)))
        self.assertEqual(sorted(r["heat.visibility_every"] for r in rows), ["1"] * 4 + ["2"] * 4 + ["4"] * 4)
        values = [list(r.values())[1:5] for r in rows]
        self.sweep(self.plan(text.format(7), "again.toml"))
        self.assertEqual([list(r.values())[1:5] for r in self.table("out/again")], values)
        self.sweep(self.plan(text.format(8), "other.toml"))
        self.assertNotEqual([list(r.values())[1:5] for r in self.table("out/other")], values)

    def test_a_list_takes_values_side_by_side(self):
        (self.folder / "plans").mkdir()
        (self.folder / "cube.stl").write_text("solid\nendsolid\n")
        self.plan('scene = "../scene.toml"\ndesign = "list"\n[keep]\nsteps = 1\n[axes]\nheat.gamma = [0.1, 0.2]\n'
                  'heat_source.0.at = [[14, 12, 14], [0, 12, 14]]\nsolid.0.shape = ["box", "sphere"]\nsolid.0.radius = [1, 2]\n', "plans/l.toml")
        refused = self.sweep("plans/l.toml", code=2).stderr
        self.assertRegex(refused, r"^plans/l.toml:\d+:\d+: error: ")
        self.plan('scene = "../scene.toml"\ndesign = "list"\n[keep]\nsteps = 1\n[axes]\nheat.gamma = [0.1, 0.2]\n'
                  'heat_source.0.at = [[14, 12, 14], [0, 12, 14]]\n', "plans/l.toml")
        self.sweep("plans/l.toml")
        self.assertEqual([(r["heat.gamma"], r["heat_source.0.at"]) for r in self.table("out/l")],
                         [("0.1", "[14, 12, 14]"), ("0.2", "[0, 12, 14]")])

    # A foreign file stands where a run would write.
    def test_a_failed_run_is_named_and_stops_no_other(self):
        plan = self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.1, 0.2]\n')
        self.sweep(plan, "--emit", "parallel")
        blocked = self.folder / "out/plan/runs/gamma_0.1"
        blocked.mkdir()
        (blocked / "letter.txt").write_text("dear")
        failed = self.sweep(plan, "--jobs", 1, code=1)
        self.assertIn("gamma_0.1", failed.stderr.splitlines()[-1])
        self.assertIn("letter.txt", failed.stderr)
        self.assertIn("2 of 3 runs are complete", failed.stdout)
        self.assertEqual([r["heat.gamma"] for r in self.table()], ["0.05", "0.2"])
        page = (self.folder / "out/plan/index.html").read_text()
        self.assertIn("<h2>Failed</h2>", page)
        self.assertIn("letter.txt", page)
        shutil.rmtree(blocked)
        self.sweep(plan)
        self.assertEqual(len(self.table()), 3)
        page = (self.folder / "out/plan/index.html").read_text()
        self.assertNotIn("<h2>Failed</h2>", page)
        self.assertEqual(page.count("<img "), 3)
        for picture in page.split('src="')[1:]:
            self.assertTrue((self.folder / "out/plan" / picture.split('"')[0]).is_file())

    # More values are more runs; those that are complete stay.
    def test_a_plan_may_grow(self):
        self.sweep(self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.1]\n'))
        old = {p: p.stat().st_mtime_ns for p in self.folder.glob("out/plan/runs/*/report.json")}
        self.sweep(self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.02, 0.05, 0.1]\n'))
        self.assertEqual(len(self.table()), 3)
        self.assertEqual(old, {p: p.stat().st_mtime_ns for p in old})

    def test_another_scene_is_refused(self):
        plan = self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.1]\n')
        self.sweep(plan)
        for change in (lambda: write(self.folder, SMALL.replace("size = [4, 4, 4]", "size = [4, 4, 3]")),
                       lambda: (write(self.folder, SMALL), self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.1]\n[keep]\nsteps = 3\n'))):
            change()
            self.assertIn("another scene", self.sweep(plan, code=2).stderr)
        (self.folder / "mine").mkdir()
        (self.folder / "mine/letter.txt").write_text("dear")
        self.assertIn("no sweep", self.sweep(plan, "--out", "mine", code=2).stderr)
        self.assertIn("no sweep to gather", self.sweep(plan, "--out", "none", "--gather", code=2).stderr)

    # It was killed while it wrote its scene, or before its own file. What is of somebody else stays.
    def test_a_folder_that_was_only_begun_is_gone_on_with(self):
        plan = self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.1]\n')
        self.sweep(plan, "--out", "whole")
        begun = self.folder / "begun"
        begun.mkdir()
        (begun / "scene.toml.partial-abc123").write_text("[gri")
        self.sweep(plan, "--out", "begun", "--emit", "make")
        shutil.rmtree(begun)
        begun.mkdir()
        shutil.copy(self.folder / "whole/scene.toml", begun)
        self.sweep(plan, "--out", "begun")
        self.assertEqual(without_times(begun / "table.csv"), without_times(self.folder / "whole/table.csv"))
        shutil.rmtree(begun)
        begun.mkdir()
        (begun / "scene.toml").write_text("another")
        self.assertIn("no sweep", self.sweep(plan, "--out", "begun", code=2).stderr)
        self.assertEqual((begun / "scene.toml").read_text(), "another")

    # The child of a sweep that was killed may have it until its own program begins.
    def test_a_lock_that_goes_soon_is_waited_for(self):
        plan = self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.1]\n')
        self.sweep(plan, "--jobs", 1)
        held = os.open(self.folder / "out/plan", os.O_RDONLY)
        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        goes = threading.Timer(0.5, os.close, [held])
        goes.start()
        begin = time.monotonic()
        self.sweep(plan, "--jobs", 1)
        self.assertGreater(time.monotonic() - begin, 0.4)
        goes.join()

    def test_one_sweep_at_a_time_and_a_signal_ends_it(self):
        plan = self.plan('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.1]\n[keep]\nsteps = 4000000\nframe_every = 0\n')
        process = subprocess.Popen([PROGRAM, "sweep", plan, "--jobs", "2"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        while len(list(self.folder.glob("out/plan/runs/*.partial-*/frames"))) < 2:
            self.assertIsNone(process.poll())
        self.assertIn("another sweep is at work", self.sweep(plan, code=2).stderr)
        self.assertIn("0 of 2 runs", self.sweep(plan, "--gather").stdout)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=30)[1]
        self.assertEqual(process.returncode, 4)
        self.assertIn("the same command goes on", said)
        self.assertEqual(len(list(self.folder.glob("out/plan/runs/*/checkpoints/*"))) > 0, True)

    def test_continue_begins_goes_on_and_is_done(self):
        def run(*more, code=0):
            done = voxmelt("run", "scene.toml", "--out", "o", "--continue", *more, cwd=self.folder)
            self.assertEqual(done.returncode, code, done.stderr)
            return done
        run("--steps", 4)
        when = (self.folder / "o/report.json").stat().st_mtime_ns
        self.assertIn("is complete", run("--steps", 4).stdout)
        self.assertIn("is complete", run("--steps", 3).stdout)
        self.assertEqual((self.folder / "o/report.json").stat().st_mtime_ns, when)
        run("--steps", 6)
        whole = voxmelt("digest", "scene.toml", "--steps", 6, cwd=self.folder).stdout.split()[3]
        self.assertEqual(json.loads((self.folder / "o/report.json").read_text())["digest"], whole)
        self.assertIn("another --set", run("--set", "heat.gamma=0.1", code=2).stderr)
        self.assertIn("another --set", run("--seed", "9", code=2).stderr)
        self.assertIn("steps in all", run("--steps", "+5", code=2).stderr)

    def test_bad_plans(self):
        head, axes = 'scene = "scene.toml"\n', "[axes]\nheat.gamma = [0.1]\n"
        bad = {  # text: place and word
            "scene = \n": ("plan.toml:1:", "error"),
            "[axes]\nheat.gamma = [0.1]\n": ("plan.toml", "scene is missing"),
            head: ("plan.toml:1:", "no axes"),
            head + "[axes]\n": ("plan.toml:2:", "no axes"),
            head + "axes = 3\n": ("plan.toml:2:", "axes must be a table"),
            head + "[axes]\nheat.gamma = []\n": ("plan.toml:3:14:", "axes.heat.gamma has no values"),
            head + "[axes]\nheat.gamma = 0.1\n": ("plan.toml:3:14:", "must be a list"),
            head + "[axes]\nheat.gama = [0.1]\n": ("plan.toml:3:", "did you mean heat.gamma"),
            head + "[axes]\nheat.gamma = [0.1, 0.9]\n": ("plan.toml:3:20:", "exceeds"),
            head + '[axes]\nheat.gamma = [0.1, "hot"]\n': ("plan.toml:3:20:", "must be a number"),
            head + "[axes]\nheat.gamma = [0.1, 1979-05-27]\n": ("plan.toml:3:20:", "a date"),
            head + "[axes]\nheat.gamma = [{ a = 1 }]\n": ("plan.toml:3:15:", "a table"),
            head + "[axes]\nheat_source.7.power = [1]\n": ("plan.toml:3:", "there is no heat_source.7"),
            head + "[axes]\nsolid.0.at = [[6, 4, 6], 3]\n": ("plan.toml:3:26:", "must be an array"),
            head + '[axes]\nheat.gamma = [0.1]\n"heat.gamma" = [0.2]\n': ("plan.toml:4:", "comes twice"),
            head + "[axes]\nheat.gamma = [0.1]\nheat.gamma = [0.2]\n": ("plan.toml:4:", "error"),
            head + "[axes]\nheat.gamma = [0.1, 0.1]\n": ("plan.toml:3:20:", "are the same"),
            head + "[axes]\nheat.gamma = { from = 0.1, to = 0.2 }\n": ("plan.toml:3:", "count is missing"),
            head + "[axes]\nheat.gamma = { from = 0.2, to = 0.1, count = 3 }\n": ("plan.toml:3:", "must be more than from"),
            head + '[axes]\nheat.gamma = { from = 0, to = 0.1, count = 3, scale = "log" }\n': ("plan.toml:3:", "more than 0"),
            head + "[axes]\nheat.gamma = { from = 0.1, to = 0.2, count = 3, step = 1 }\n": ("plan.toml:3:", "unknown key"),
            head + "[axes]\nheat.gamma = { from = 0.1, to = 0.2, count = 1 }\n": ("plan.toml:3:", "outside 2"),
            head + "[axes]\nrun.seed = { from = 1, to = 200, count = 200 }\nheat.gamma = { from = 0.1, to = 0.2, count = 200 }\n":
                ("plan.toml:4:", "40000 runs"),
            head + 'design = "list"\n[axes]\nrun.seed = [1, 2]\nheat.gamma = [0.1]\n': ("plan.toml:5:", "1 values"),
            head + 'design = "spiral"\n' + axes: ("plan.toml:2:", "is not one of grid"),
            head + "runs = 5\n" + axes: ("plan.toml:2:", "latin_hypercube"),
            head + 'design = "latin_hypercube"\n' + axes: ("plan.toml", "runs is missing"),
            head + 'design = "latin_hypercube"\nruns = 3\n[axes]\nheat.gamma = [0.1]\n': ("plan.toml:5:", "are the same"),
            head + 'design = "latin_hypercube"\nruns = 3\n[axes]\nheat.gamma = { from = 0.1, to = 0.2, count = 3 }\n': ("plan.toml:5:", "as many as"),
            head + "extra = 5\n" + axes: ("plan.toml:2:", "unknown key extra"),
            'scene = 3\n' + axes: ("plan.toml:1:", "must be a string"),
            'scene = "nowhere.toml"\n' + axes: ("nowhere.toml", "error"),
            'scene = "nowhere"\n' + axes: ("", "no scene named 'nowhere'"),
            head + axes + "[keep]\nsteps = -1\n": ("plan.toml:5:", "outside 0"),
            head + axes + "[keep]\nwrite = [\"cvs\"]\n": ("plan.toml:5:10:", "is not one of"),
            head + axes + "[keep]\nwrite_every = 3\n": ("plan.toml:5:", "keep.write"),
            head + axes + "[keep]\noutputs = [\"sheet\", \"sheet\"]\n": ("plan.toml:5:21:", "twice"),
            head + axes + "[keep]\nsize = \"big\"\n": ("plan.toml:5:", "WIDTHxHEIGHT"),
            head + axes + "[keep]\nsetting = \"ugly\"\n": ("plan.toml:5:", "is not one of fast"),
            head + axes + "[keep]\ncheckpoint_every = \"often\"\n": ("plan.toml:5:", "60s"),
            head + axes + "[keep]\nsteps = 3\n[axes.run]\nsteps = [3]\n": ("plan.toml:7:", "keep.steps"),
            "\x00\x01": ("plan.toml:1:", "error"),
        }
        for text, (place, word) in bad.items():
            with self.subTest(text):
                said = self.sweep(self.plan(text), code=2).stderr
                self.assertEqual(len(said.splitlines()), 1, said)
                self.assertTrue(said.startswith(place), said)
                self.assertIn(word, said)
                self.assertFalse((self.folder / "out").exists(), "something was written")
        self.assertIn("nowhere.toml", self.sweep("nowhere.toml", code=2).stderr)


if __name__ == "__main__":
    unittest.main(argv=["sweep_test"], verbosity=1)
