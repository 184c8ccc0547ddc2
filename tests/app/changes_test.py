#!/usr/bin/env python3
"""A scene that changes while it runs, by [[change]]: changes_test.py VOXMELT

The bits are those of a journal with the same lines, and where a key says the same, those of the key. So it is with every
implementation, across checkpoints and exports. What is wrong is refused by its place, before or at its step."""
import random
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
from program import SMALL, voxmelt, write

SCENE = SMALL.replace("size = [12, 10, 12]", "size = [20, 16, 20]").replace("size = [4, 4, 4]", "size = [8, 8, 8]")
JOURNAL = """0 heat_source.0.at 3.5 14 9
0 heat.gamma 0.1
4 vent.add 10 12 7 2 0.4 0.9
9 vent.0.rate 0.2
9 heat_source.add_sky 0.002
12 pour 4 9 15 3 0.8
13 carve 10 5 12 2.5
17 drain.add 6 3 14 3 0.5
17 flow.paper.slump 0.3
25 vent.0.remove
33 heat_source.0.remove
"""
STEPS = 40


def entries(journal, shuffled=None):
    """The tables of these lines; those of one step stay in their order."""
    by_step = {}
    for line in journal.splitlines():
        step, _, what = line.partition(" ")
        by_step.setdefault(int(step), []).append(what)
    order = list(by_step)
    if shuffled:
        random.Random(shuffled).shuffle(order)
    quoted = lambda words: ", ".join(f'"{one}"' for one in words)
    return "".join(f"[[change]]\nstep = {step}\ndo = [{quoted(by_step[step])}]\n" for step in order)


class ChangesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)

    def digests(self, scene, *arguments, steps=STEPS):
        done = voxmelt("digest", scene, "--steps", steps, "--every", 1, *arguments, cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        return dict(re.findall(r"step (\d+) digest ([0-9a-f]{16})", done.stdout))

    def test_as_a_journal(self):
        write(self.path, SCENE, "plain.toml")
        write(self.path, JOURNAL, "journal.txt")
        wanted = self.digests("plain.toml", "--journal", "journal.txt")
        self.assertNotEqual(wanted, self.digests("plain.toml"))
        for shuffled in (None, 1, 2):
            write(self.path, SCENE + entries(JOURNAL, shuffled), "changing.toml")
            for implementation, threads in (("reference", 1), ("auto", 1), ("auto", 3)):
                self.assertEqual(self.digests("changing.toml", "--implementation", implementation, "--threads", threads), wanted)
        # A journal of one half, and a scene with the other one.
        lines = JOURNAL.splitlines(keepends=True)
        write(self.path, "".join(lines[:6]), "half.txt")
        write(self.path, SCENE + entries("".join(lines[6:])), "half.toml")
        self.assertEqual(self.digests("half.toml", "--journal", "half.txt"), wanted)

    def test_as_a_key(self):
        """What a key of the scene says, too, is the same by a change of the right step."""
        plain = write(self.path, SCENE)
        vent, drain = "at=[10, 12, 7], radius=2, rate=0.4", "at=[6, 3, 14], radius=3, rate=0.5"
        for change, sets in (("0 heat_source.0.sun 1 2 0.5 0.003",
                              ['heat_source=[{kind="directional", direction=[1, 2, 0.5], power=0.003}]']),
                             ("0 heat_source.0.sphere 3 14 9 2 40", ['heat_source=[{kind="sphere", at=[3, 14, 9], radius=2, power=40}]']),
                             ("0 heat_source.0.sky 0.002", ['heat_source=[{kind="sky", power=0.002}]']),
                             ("0 heat_source.0.point 3 14 9 40", ["heat_source.0.at=[3, 14, 9]", "heat_source.0.power=40"]),
                             ("0 vent.add 10 12 7 2 0.4 0\n8 vent.0.off", [f"vent=[{{{vent}, until=8}}]"]),
                             ("0 vent.add 10 12 7 2 0.4 0\n0 vent.0.off\n9 vent.0.on", [f"vent=[{{{vent}, from=9}}]"]),
                             ("0 drain.add 6 3 14 3 0.5\n8 drain.0.off\n21 drain.0.on",
                              [f"drain=[{{{drain}, until=8}}, {{{drain}, from=21}}]"]),
                             ("0 heat.gamma 0.3", ["heat.gamma=0.3"]), ("0 heat_source.0.power 55", ["heat_source.0.power=55"]),
                             ("7 vent.add 10 12 7 2 0.4 0.9",
                              ["vent=[{at=[10, 12, 7], radius=2, rate=0.4, temperature=0.9, from=7}]"]),
                             ("11 drain.add 6 3 14 3 0.5", ["drain=[{at=[6, 3, 14], radius=3, rate=0.5, from=11}]"])):
            changing = write(self.path, SCENE + entries(change), "changing.toml")
            keys = [word for one in sets for word in ("--set", one)]
            self.assertEqual(self.digests(changing), self.digests(plain, *keys), change)

    def test_extends_and_set(self):
        write(self.path, SCENE + entries(JOURNAL), "base.toml")
        write(self.path, 'extends = "base.toml"\n' + entries("5 heat.gamma 0.3"), "sister.toml")
        write(self.path, SCENE + entries("5 heat.gamma 0.3"), "alone.toml")
        self.assertEqual(self.digests("sister.toml"), self.digests("alone.toml"))
        write(self.path, SCENE + entries("8 heat.gamma 0.3"), "later.toml")
        self.assertEqual(self.digests("alone.toml", "--set", "change.0.step=8"), self.digests("later.toml"))

    def test_a_run_goes_on(self):
        write(self.path, SCENE + entries(JOURNAL), "changing.toml")
        wanted = self.digests("changing.toml")
        for half in (4, 9, 14, 30):  # before, between and after changes
            begun = voxmelt("run", "changing.toml", "--steps", half, "--out", f"half{half}", cwd=self.path)
            self.assertEqual(begun.returncode, 0, begun.stderr)
            at = self.digests(f"half{half}/last.vxc")
            self.assertEqual(at[str(STEPS)], wanted[str(STEPS)], half)
            rest = voxmelt("run", "--resume", f"half{half}", "--steps", STEPS, cwd=self.path)
            self.assertEqual(rest.returncode, 0, rest.stderr)
            self.assertIn(wanted[str(STEPS)], (self.path / f"half{half}/report.json").read_text())

    def test_an_export_goes_on(self):
        write(self.path, SCENE + entries(JOURNAL), "changing.toml")
        wanted = self.digests("changing.toml")
        for step in (8, 16):  # steps of visibility
            done = voxmelt("export", "changing.toml", "--steps", step, "--out", f"at{step}", cwd=self.path)
            self.assertEqual(done.returncode, 0, done.stderr)
            again = self.digests(f"at{step}/scene.toml", steps=STEPS - step)
            self.assertEqual(again, {str(n): wanted[str(n + step)] for n in range(STEPS - step + 1)})

    def test_a_picture_shows_the_changes(self):
        write(self.path, SCENE, "plain.toml")
        write(self.path, SCENE + entries("3 carve 10 8 10 4"), "changing.toml")
        for name in ("plain", "changing"):
            done = voxmelt("render", f"{name}.toml", "--steps", 4, "--out", f"{name}.png", cwd=self.path)
            self.assertEqual(done.returncode, 0, done.stderr)
        done = voxmelt("run", "changing.toml", "--steps", 4, "--frame-every", 4, "--out", "out", cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        picture = (self.path / "changing.png").read_bytes()
        self.assertNotEqual(picture, (self.path / "plain.png").read_bytes())
        self.assertEqual(picture, sorted((self.path / "out/frames").iterdir())[-1].read_bytes())

    def test_what_is_wrong_is_refused(self):
        first = SCENE.count("\n") + 1  # line of the first entry
        for entry, message in (
                ("step = 2\n", f"{first}:1: error: change.0.do is missing"),
                ('do = ["heat.gamma 0.1"]\n', f"{first}:1: error: change.0.step is missing"),
                ("step = 2\ndo = []\n", f"{first + 2}:6: error: change.0.do is empty"),
                ('step = 2\ndo = "carve 5 5 5 2"\n', f"{first + 2}:6: error: change.0.do must be an array of strings, not a string"),
                ("step = 2\ndo = [3]\n", f"{first + 2}:7: error: change.0.do.0 must be a string, not an integer"),
                ('step = -1\ndo = ["carve 5 5 5 2"]\n', f"{first + 1}:8: error: change.0.step = -1 is outside 0..4294967295"),
                ('step = 2\nat = 1\ndo = ["carve 5 5 5 2"]\n', f"{first + 2}:1: error: unknown key change.0.at"),
                ('step = 90\ndo = ["heat.gamma nan"]\n', f"{first + 2}:7: error: heat.gamma nan: not a number"),
                ('step = 90\ndo = ["carve 5 5 5 2", ""]\n', f"{first + 2}:24: error: no key"),
                ('step = 2\ndo = ["heat.gamma 0.1", "vent.add 1 2 3 1 7 0.5"]\n',
                 f"{first + 2}:25: set_vents: error: vent.0.rate = 7"),
                ('step = 2\ndo = ["vent.3.rate 0.5"]\n', f"{first + 2}:7: error: vent.3.rate is not there"),
                ('step = 2\ndo = ["grid.size 5"]\n', f"{first + 2}:7: set: error: grid.size is not one of the numbers")):
            write(self.path, f"{SCENE}[[change]]\n{entry}", "bad.toml")
            for command in (("digest",), ("run", "--out", "bad"), ("render",), ("export", "--out", "bad")):
                done = voxmelt(command[0], "bad.toml", *command[1:], "--steps", 10, cwd=self.path)
                self.assertEqual(done.returncode, 2, (command, entry))
                self.assertIn(f"bad.toml:{message}", done.stderr, command)
                self.assertFalse((self.path / "bad").exists())

    def test_who_makes_no_changes_says_so(self):
        write(self.path, SCENE + entries("3 carve 10 8 10 4"), "changing.toml")
        for command in (("verify",), ("explore", "--device", "zu7ev", "--memory", "ddr4-2400"), ("bench", "--scenes")):
            done = voxmelt(*command, "changing.toml", cwd=self.path)
            self.assertEqual(done.returncode, 2, command)
            self.assertIn(f"`voxmelt {command[0]}` makes no [[change]]", done.stderr)
        begun = voxmelt("run", "changing.toml", "--steps", 8, "--out", "out", cwd=self.path)
        self.assertEqual(begun.returncode, 0, begun.stderr)
        done = voxmelt("verify", "out/last.vxc", "--steps", 2, cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
