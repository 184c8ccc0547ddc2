#!/usr/bin/env python3
"""`voxmelt view` saves what a hand did as a scene: saved_scene_test.py VOXMELT

`voxmelt digest` and `run` of that scene give the page's digest at every step, in any folder."""
import re
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "app"))
from page import Page, Server
from program import PROGRAM, SMALL, voxmelt, write

SCENE = SMALL.replace("size = [12, 10, 12]", "size = [20, 16, 20]").replace("size = [4, 4, 4]", "size = [8, 8, 8]")
MESH = '[[solid]]\nshape = "mesh"\nfile = "tetrahedron.obj"\nheight = 5\nat = [15, 3, 4]\n'
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"


class SavedSceneTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        (self.path / "elsewhere").mkdir()

    def serve(self, *arguments):
        return Server(PROGRAM, *arguments, "--threads", 1, cwd=self.path)

    def digests(self, scene, *arguments, steps, cwd=None):
        done = voxmelt("digest", scene, "--steps", steps, "--every", 1, *arguments, cwd=cwd or self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        return {int(step): digest for step, digest in re.findall(r"step (\d+) digest ([0-9a-f]{16})", done.stdout)}

    def act(self, page, *lines):
        """Says the lines, a step after each; returns digests by step."""
        seen = {}
        for line in lines:
            page.send(line)
            page.send("step 1")
            step = max(seen, default=self.step) + 1
            seen[step] = page.rest(step)[0]["digest"]
        self.step = step
        return seen

    def script(self, page):
        """A long session: everything that a hand can do, also what is taken back. Returns digests by step."""
        self.step = 0
        seen = {0: page.rest(0)[0]["digest"]}
        self.act(page, "change carve 10 5 10 4", "change heat.gamma 0.3")
        page.send("restart")
        page.rest(0)
        self.step = 0
        seen |= self.act(page, "change heat_source.0.at 3.1 14.3 9.7", "change vent.add 10 12 7 2 0.4 0.9", "home",
                         "change heat.gamma 0.1", "change pour 4 9 15 3 0.8", "change vent.0.rate 0.1")
        self.act(page, "change carve 4 4 4 3", "change vent.0.remove")
        page.send("back 6")
        page.rest(6)
        self.step = 6
        seen |= self.act(page, "change carve 10 5 12 2.5", "change flow.paper.slump 0.3", "change drain.add 6 3 14 3 0.5",
                         "change heat_source.add_sun 1 2 0.5 0.003", "change heat_source.add_sky 0.002", "change heat_source.0.power 55")
        page.send("change material.melting_point 0.4")  # two before one step
        seen |= self.act(page, "change heat_source.0.remove")
        page.send("step 30")
        self.step += 30
        seen[self.step] = page.rest(self.step)[0]["digest"]
        return seen

    def check(self, text, journal, seen, scene, *sets):
        """The saved scene against the page's digests, and at every step against the journal."""
        saved = write(self.path / "elsewhere", text, "saved.toml")
        write(self.path, journal, "journal.txt")
        wanted = self.digests(scene, "--journal", "journal.txt", *sets, steps=self.step)
        self.assertEqual({step: wanted[step] for step in seen}, seen)
        for implementation, threads in (("reference", 1), ("auto", 3)):
            found = self.digests(saved.name, "--implementation", implementation, "--threads", threads, steps=self.step,
                                 cwd=saved.parent)
            self.assertEqual(found, wanted, implementation)
        done = voxmelt("run", "saved.toml", "--steps", self.step, "--out", "out", cwd=saved.parent)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(wanted[self.step], (saved.parent / "out/report.json").read_text())

    def saved(self, page, what):
        page.send(f"save {what}")
        name, data = page.file()
        return name, data.decode()

    def test_a_long_session(self):
        write(self.path, TETRAHEDRON, "tetrahedron.obj")
        scene = write(self.path, SCENE + MESH)
        with self.serve(scene.name, "--set", "heat_source.0.power=40") as server, Page(server) as page:
            seen = self.script(page)
            name, text = self.saved(page, "scene")
            self.assertEqual(name, "scene-by-hand.toml")
            _, journal = self.saved(page, "journal")
        self.check(text, journal, seen, scene.name, "--set", "heat_source.0.power=40")
        # A page that shows the saved scene makes the changes, too, and saves them again.
        with self.serve("elsewhere/saved.toml") as server, Page(server) as page:
            page.rest(0)
            page.send(f"step {self.step}")
            self.assertEqual(page.rest(self.step)[0]["digest"], seen[self.step])
            self.assertEqual(tomllib.loads(self.saved(page, "scene")[1]), tomllib.loads(text))
            page.send("back 9")
            self.assertEqual(page.rest(9)[0]["digest"], seen[9])
            page.send("restart")
            page.rest(0)
            page.send("step 11")
            self.assertEqual(page.rest(11)[0]["digest"], seen[11])

    def test_a_scene_that_changes_itself(self):
        own = '[[change]]\nstep = 3\ndo = ["vent.add 10 12 7 2 0.4 0.9"]\n[[change]]\nstep = 7\ndo = ["vent.0.rate 1"]\n'
        scene = write(self.path, SCENE + own)
        with self.serve(scene.name) as server, Page(server) as page:
            self.step = 0
            seen = {0: page.rest(0)[0]["digest"]}
            page.send("step 3")
            page.rest(3)
            self.step = 3
            # The hand is before the scene: its vent is the first one, and step 7 changes that.
            seen |= self.act(page, "change vent.add 5 12 5 2 0.3 0.8", "change heat.gamma 0.2", "home", "change vent.1.rate 0.5", "home")
            text, journal = self.saved(page, "scene")[1], self.saved(page, "journal")[1]
        self.check(text, journal, seen, scene.name)

    def test_a_run_that_began_late(self):
        """Steps of a scene count from `start.step`."""
        write(self.path, SCENE)
        done = voxmelt("export", "scene.toml", "--steps", 16, "--out", "there", cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        with self.serve("there/scene.toml") as server, Page(server) as page:
            self.step = 0
            seen = {0: page.rest(0)[0]["digest"]}
            seen |= self.act(page, "home", "change pour 4 9 15 3 0.8", "change heat.gamma 0.1", "home")
            text, journal = self.saved(page, "scene")[1], self.saved(page, "journal")[1]
        self.assertIn("step = 17\n", text)
        self.check(text, journal, seen, "there/scene.toml")

    def test_what_began_from_a_checkpoint_is_refused(self):
        write(self.path, SCENE)
        done = voxmelt("run", "scene.toml", "--steps", 4, "--out", "out", cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        with self.serve("out/last.vxc") as server, Page(server) as page:
            page.rest(4)
            page.send("save scene")
            self.assertEqual(page.text("refused")["why"],
                             "error: this run began from a checkpoint; a scene begins at its first state")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
