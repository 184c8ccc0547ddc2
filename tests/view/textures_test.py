#!/usr/bin/env python3
"""The textures that `voxmelt view` sends to pages that draw by themselves: textures_test.py VOXMELT

They hold the field as the docs define it, whatever a page held before. Only bricks that differ are sent."""
import random
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "app"))
from page import Page, Server
from program import PROGRAM, voxmelt, write
from textures import Textures, field_of

# A warm block melts on a table that nothing carries. The three sides differ, so that no two axes can be exchanged.
GRID = (21, 16, 30)
SCENE = """[grid]
size = [21, 16, 30]
[look]
smooth = 0
smooth_solid = 0
[[solid]]
shape = "box"
size = [8, 6, 12]
at = [9, 8, 17]
temperature = 0.49
[[inert]]
shape = "box"
size = [12, 2, 18]
at = [10, 4, 17]
[material]
melting_point = 0.5
[heat]
gamma = 0.15
visibility_every = 4
[[heat_source]]
at = [22, 14, 28]
power = 60
[camera]
width = 64
height = 48
"""


class TexturesTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)
        self.scene = write(self.path, SCENE)

    def tearDown(self):
        self.folder.cleanup()

    def serve(self, scene=None, *arguments):
        return Server(PROGRAM, scene or self.scene, "--threads", 1, *arguments, cwd=self.path)

    def all_of(self, server):
        """What a page gets that comes now."""
        with Page(server) as page:
            textures = Textures(page)
            textures.update()
            self.assertTrue(textures.news["everything"])
            return textures

    def assert_holds_field(self, textures, step):
        done = voxmelt("export", self.scene, "--steps", step, "--format", "npy", "--out", f"out{step}", cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        levels, matter = field_of(self.path / f"out{step}", GRID)
        i = 0
        for z in range(GRID[2]):
            for y in range(GRID[1]):
                for x in range(GRID[0]):
                    place = (x + 2, y + 2, z + 2)  # of the lattice
                    self.assertEqual(int.from_bytes(textures.texel("levels", *place), "little"), levels[i], place)
                    self.assertEqual(tuple(textures.texel("matter", *place)), matter[i], place)
                    i += 1
        inside = lambda place: all(2 <= p < n + 2 for p, n in zip(place, GRID))
        size = textures.shapes["levels"]["size"]
        beyond = [(x, y, z) for x in range(size[0]) for y in range(size[1]) for z in range(size[2]) if not inside((x, y, z))]
        self.assertTrue(all(textures.texel("levels", *place) == b"\0\0" for place in beyond), "beside the grid is air")
        return any(256 > liquid > 0 for liquid, *_ in matter)

    def test_they_hold_the_field(self):
        with self.serve() as server, Page(server) as page:
            textures = Textures(page)
            textures.update()
            self.assertTrue(textures.news["everything"])
            self.assertFalse(self.assert_holds_field(textures, 0), "nothing is liquid yet")
            melted, done = False, 0
            for step in (7, 40, 55):
                page.send(f"step {step - done}")
                done = step
                page.rest(step)
                while textures.update()["step"] != step:
                    pass
                self.assertFalse(textures.news["everything"])
                melted = self.assert_holds_field(textures, step) or melted
            self.assertTrue(melted)

    def test_whatever_a_page_held_it_holds_all(self):
        dice = random.Random(5)
        with self.serve() as server, Page(server) as driver:
            pages = [Page(server) for _ in range(3)]
            held = [Textures(page) for page in pages]
            step = driver.rest(0)[0]["step"]
            for textures in held:
                textures.update()
            for round_ in range(16):
                count = dice.choice((1, 1, 2, 5))
                step += count
                driver.send(f"step {count}")
                driver.rest(step)
                fresh = self.all_of(server)
                for i, textures in enumerate(held):
                    if round_ % (i + 1) != 0:
                        continue  # the others skip versions
                    before = dict(textures.held())
                    while textures.update()["step"] != step:
                        before = dict(textures.held())
                    self.assertFalse(textures.news["everything"])
                    self.assertEqual(textures.held(), fresh.held(), f"page {i}, step {step}")
                    if i == 0:  # it held the version before, and not one brick is sent that is the same
                        for key, data in textures.sent.items():
                            self.assertNotEqual(data, before.get(key, bytes(len(data))), key)
            driver.send("restart")
            driver.rest(0)
            fresh = self.all_of(server)
            for textures in held:
                while textures.update()["step"] != 0:
                    pass
                self.assertTrue(textures.news["everything"], "its version is of another run")
                self.assertEqual(textures.held(), fresh.held())
            for page in pages:
                page.link.close()

    def test_a_filtered_field_is_that_of_a_fresh_picture(self):
        write(self.path, SCENE.replace("smooth = 0", "smooth = 2").replace("smooth_solid = 0", "smooth_solid = 1"), "soft.toml")
        with self.serve("soft.toml") as server, Page(server) as page:
            textures = Textures(page)
            for step in range(2, 61, 2):
                page.send("step 2")
                page.rest(step)
                while textures.update()["step"] != step:
                    pass
            page.send("save checkpoint")
            (self.path / "soft.checkpoint").write_bytes(page.file()[1])
        with self.serve("soft.checkpoint") as server:
            self.assertEqual(self.all_of(server).held(), textures.held())

    def test_bytes_are_those_of_changed_bricks(self):
        with self.serve("cello") as server, Page(server) as page:
            textures = Textures(page)
            textures.update()
            first = sum(map(len, textures.sent.values()))
            page.send("exact 0")
            page.send("speed 100")
            page.send("step 300")
            while textures.update()["step"] != 300:
                pass
            volume = textures.bytes("levels", "matter")
            for step in range(303, 315, 3):
                before = dict(textures.bricks)
                page.send("step 3")
                self.assertEqual(textures.update()["step"], step)
                changed = sum(len(data) for (name, _), data in textures.sent.items() if name in ("levels", "matter"))
                self.assertGreater(changed, 0)
                self.assertLess(changed, 0.15 * volume)
                self.assertLess(textures.packed, 0.15 * textures.bytes(*textures.shapes))
                self.assertTrue(all(data != before.get(key) for key, data in textures.sent.items()))
            self.assertLess(first, textures.bytes(*textures.shapes), "air is not sent")

    def test_who_does_not_ask_gets_nothing(self):
        with self.serve() as server, Page(server) as exact, Page(server) as own:
            exact.rest(0)
            own.rest(0)
            own.send("exact 0")
            textures = Textures(own)
            textures.update()
            exact.send("step 4")
            exact.rest(4)
            time.sleep(0.2)
            own.send("pick 1 1")  # its answer is the first thing that comes
            while (heard := own.hear())[0] == "frame" or heard[1]["type"] == "books":
                self.assertTrue(heard[0] == "text" or heard[1]["step"] == 0, "a frame that nobody wanted")
            self.assertEqual((heard[0], heard[1]["type"]), ("text", "pick"))
            self.assertEqual(textures.update()["step"], 4)
            exact.send("pick 1 1")
            while (heard := exact.hear())[0] != "text" or heard[1]["type"] != "pick":
                self.assertNotEqual(heard[0], "textures", "it has not asked")
            own.send("exact 1")
            self.assertEqual(own.rest(4)[0]["step"], 4)

    def test_a_page_that_waits_gets_what_is_new(self):
        with self.serve() as server, Page(server) as page:
            textures = Textures(page)
            page.send("exact 0")
            textures.update()
            textures.ask()
            time.sleep(0.3)  # there is nothing new, or only that no frames are wanted
            page.send("step 1")
            while textures.take()["step"] != 1:
                textures.ask()

    def test_wrong_lines_change_nothing(self):
        with self.serve() as server, Page(server) as page:
            page.rest(0)
            for line in ("textures", "textures -1", "textures 1.5", "textures nan", "textures 1e300", "textures 1 2",
                         "exact", "exact 2", "exact x"):
                page.send(line)
                self.assertEqual(page.text("refused")["line"], line)
            self.assertEqual(Textures(page).update()["step"], 0)

    def test_a_grid_that_is_too_large_is_refused(self):
        write(self.path, SCENE.replace("size = [21, 16, 30]", "size = [1032, 16, 30]"), "wide.toml")
        with self.serve("wide.toml") as server, Page(server) as page:
            page.send("textures 0")
            self.assertIn("1032 x 16 x 30 cells exceeds 1024", page.text("refused")["why"])
            page.send("step 1")
            self.assertEqual(page.rest(1)[0]["step"], 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
