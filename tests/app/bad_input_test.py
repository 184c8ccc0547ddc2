#!/usr/bin/env python3
"""Bad input: exit code 2 (3 for resources), one clear line with its place, nothing left behind.

What the scene reader refuses in detail is tested in tests/kernel/scene/bad_input_test.cpp; here it is the
program, end to end.
"""
import os
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from program import PROGRAM, SMALL, voxmelt, write

CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))


def changed(old, new):
    assert old in SMALL, old
    return SMALL.replace(old, new)


# name: (scene text, what the message must hold, exit code)
SCENES = {
    "malformed": ("[grid\nsize = 3", "scene.toml:1:", 2),
    "unfinished string": ('title = "x\n' + SMALL, "scene.toml:", 2),
    "twice the same key": (SMALL + "[grid]\nsize = [3, 3, 3]\n", "scene.toml:", 2),
    "empty": ("", "grid.size is missing", 2),
    "unknown key": (changed("gamma", "gama"), "did you mean heat.gamma?", 2),
    "unknown table": (SMALL + "[weather]\nrain = 1\n", "weather", 2),
    "wrong type": (changed("gamma = 0.15", 'gamma = "much"'), "heat.gamma", 2),
    "text for a size": (changed("[12, 10, 12]", '"big"'), "grid.size", 2),
    "two sizes": (changed("[12, 10, 12]", "[12, 10]"), "grid.size", 2),
    "fractional size": (changed("[12, 10, 12]", "[12.5, 10, 12]"), "grid.size", 2),
    "not a number": (changed("power = 30", "power = nan"), "heat_source.0.power", 2),
    "infinite": (changed("at = [14, 12, 14]", "at = [inf, 12, 14]"), "heat_source.0.at", 2),
    "negative size": (changed("[12, 10, 12]", "[12, -10, 12]"), "grid.size", 2),
    "zero size": (changed("[12, 10, 12]", "[0, 10, 12]"), "grid.size", 2),
    "enormous size": (changed("[12, 10, 12]", "[1000000000, 10, 12]"), "grid.size", 2),
    "larger than memory": (changed("[12, 10, 12]", "[4096, 4096, 4096]"), "bytes", 3),
    "gamma past its bound": (changed("0.15", "0.53"), "0.5236", 2),
    "negative gamma": (changed("0.15", "-0.15"), "heat.gamma", 2),
    "7 neighbours": (changed("gamma = 0.15", "gamma = 0.15\nneighbours = 7"), "heat.neighbours", 2),
    "unknown law": (changed('"paper"', '"papre"'), "flow.law", 2),
    "the other law's table": (SMALL + "[flow.viscous]\nkappa = 0.1\n", "flow.viscous", 2),
    "share past its bound": (SMALL + "[flow.paper]\nshare = 0.3\n", "flow.paper.share", 2),
    "unknown shape": (changed('"box"', '"bix"'), "solid.0.shape", 2),
    "negative radius": (changed('shape = "box"\nsize = [4, 4, 4]', 'shape = "sphere"\nradius = -2'), "radius", 2),
    "nothing can flow": (changed("[[solid]]", "[[inert]]").replace("temperature = 0.49\n", ""), "nothing can flow", 2),
    "missing mesh": (changed('shape = "box"\nsize = [4, 4, 4]', 'shape = "mesh"\nfile = "no.obj"\nheight = 4'), "no.obj", 2),
    "empty mesh": (changed('shape = "box"\nsize = [4, 4, 4]', 'shape = "mesh"\nfile = "empty.obj"\nheight = 4'), "empty.obj", 2),
    "truncated mesh": (changed('shape = "box"\nsize = [4, 4, 4]', 'shape = "mesh"\nfile = "cut.obj"\nheight = 4'), "cut.obj", 2),
    "mesh with a missing vertex": (changed('shape = "box"\nsize = [4, 4, 4]', 'shape = "mesh"\nfile = "far.obj"\nheight = 4'), "far.obj", 2),
    "a folder for a mesh": (changed('shape = "box"\nsize = [4, 4, 4]', 'shape = "mesh"\nfile = "."\nheight = 4'), "scene.toml:9:8: error: cannot read .: it is a folder", 2),
    "truncated height field": (SMALL + '[[inert]]\nshape = "heightfield"\nfile = "cut.asc"\nvertical_scale = 1\n', "cut.asc", 2),
    "vent with a negative rate": (SMALL + "[[vent]]\nat = [6, 6, 6]\nradius = 1\nrate = -1\n", "vent.0.rate", 2),
    "extends itself": ('extends = "scene.toml"\n' + SMALL, "scene.toml", 2),
    "latent heat past the range": (changed("melting_point = 0.5", "melting_point = 0.5\nlatent_heat = 0.6"), "material.latent_heat", 2),
    "a key of 100,000 parts": ("a" + ".a" * 100000 + " = 1\n" + SMALL, "scene.toml:1:128: error: a key of more than 64 parts", 2),
    "two deep lines": ("k" + ".a" * 16000 + " = 1\n[k" + ".a" * 16000 + "]\n", "scene.toml:1:128: error: a key of more", 2),
    "300 brackets": ("x = " + "[" * 300 + "]" * 300 + "\n" + SMALL, "scene.toml:1:69: error: more than 64 brackets deep", 2),
    "a letter outside ASCII": ("x = [1, \u0262]\n" + SMALL, "scene.toml:1:9: error: a letter outside ASCII", 2),
    "a header without a name": ("[\n" + SMALL, "scene.toml:1:1: error: a table's name is missing", 2),
    "a number that is none": ("x = t\n" + SMALL, "scene.toml:1:6: error: ", 2),
    "a control character": ('description = "\\u001b[31m"\nnme = 1\n' + SMALL, "scene.toml:2:1: error: unknown key nme", 2),
    "an escape in a key": ('"\\u001b[31m" = 1\n' + SMALL, "unknown key \\x1b[31m", 2),
    "start from nowhere": (SMALL + '[start]\nfields = "nowhere"\n', "nowhere", 2),
}

FILES = {"empty.obj": "", "cut.obj": CUBE + "f 1 2", "far.obj": CUBE + "f 1 2 99\n",
         "cut.asc": "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4\n1 2\n"}

# arguments after the command: (arguments, what the message must hold, exit code)
ARGUMENTS = [
    (["run"], "scene", 2),
    (["digest", "scene.toml", "--report", "scene.toml"], "--report scene.toml: error: the scene reads this file", 2),
    (["render", "scene.toml", "--out", "./scene.toml"], "pictures are written as PNG, not as .toml", 2),
    (["render", "scene.toml", "--out", "p.jpg"], "--out p.jpg: error: pictures are written as PNG, not as .jpg", 2),
    (["render", "scene.toml", "--depth", "d.jpg"], "--depth d.jpg", 2),
    (["run", "scene.toml", "--size", ""], "--size", 2),
    (["run", "scene.toml", "--out", ".."], "--out ..: error: the scene reads", 2),
    (["run", "scene.toml", "--set", ".".join("a" * 30000) + "=1"], "a key of more than 64 parts", 2),
    (["run", "scene.toml", "--set", "title=" + "[" * 100], "more than 64 brackets deep", 2),
    (["run", "n" * 300 + ".toml"], "File name too long", 2),
    *[([*command, long], f"{long}: error: {why}", 2) for long in ("n" * 300, "a/" + "n" * 300, "n" * 300 + "/a")
      for command, why in ((["run", "scene.toml", "--out"], ""), (["export", "scene.toml", "--out"], ""),
                           (["render", "scene.toml", "--turntable", "2", "--out"], ""),
                           (["render", "scene.toml", "--out"], "" if long.startswith("nnn") and "/" not in long else "there is no folder"),
                           (["run", "--resume"], ""), (["info"], "there is no such file"))],
    (["render", "scene.toml", "--turntable", "2", "--out", "picture.png"],
     "--out picture.png: error: --turntable writes its views into a folder", 2),
    (["render", "scene.toml", "--turntable", "2", "--out", "film.MP4"], "--out film.MP4: error: --turntable writes", 2),
    (["melt", "scene.toml"], "melt", 2),
    ([], "subcommand", 2),
    (["run", "nosuchscene"], "nosuchscene", 2),
    (["run", "nosuch.toml"], "nosuch.toml", 2),
    (["run", "."], "error", 2),
    (["run", "scene.toml", "--set"], "--set", 2),
    (["run", "scene.toml", "--set", ""], "--set", 2),
    (["run", "scene.toml", "--set", "=1"], "--set", 2),
    (["run", "scene.toml", "--set", "heat.gamma"], "--set", 2),
    (["run", "scene.toml", "--set", "heat.gamma="], "--set", 2),
    (["run", "scene.toml", "--set", "heat.gama=0.1"], "did you mean heat.gamma?", 2),
    (["run", "scene.toml", "--set", "heat.gamma=0.7"], "--set heat.gamma=0.7: error: heat.gamma = 0.7 exceeds 0.5236", 2),
    (["run", "scene.toml", "--set", "solid.7.radius=1"], "solid", 2),
    (["run", "scene.toml", "--steps", "-1"], "--steps", 2),
    (["run", "scene.toml", "--steps", "many"], "--steps", 2),
    (["run", "scene.toml", "--steps", "99999999999"], "--steps", 2),
    (["run", "scene.toml", "--size", "0x0"], "--size", 2),
    (["run", "scene.toml", "--size", "64"], "--size", 2),
    (["run", "scene.toml", "--implementation", "abacus"], "abacus", 2),
    (["run", "scene.toml", "--threads", "0"], "--threads", 2),
    (["run", "scene.toml", "--out", "file"], "file", 2),
    (["run", "scene.toml", "--out", "/proc/voxmelt"], "/proc/voxmelt", 2),
    (["digest", "scene.toml", "--report", "/nowhere/r.json", "--steps", "0"], "/nowhere/r.json", 2),
    (["run", "scene.toml", "--report", "nowhere/r.json"], "there is no folder", 2),
    (["run", "scene.toml", "--out", "o", "--report", "o/r.json"], "lies in --out", 2),
    (["run", "scene.toml", "--out", "."], "--out .: error: the scene reads scene.toml there", 2),
    (["render", "scene.toml", "--azimuth", "nan"], "--azimuth", 2),
    (["render", "scene.toml", "--elevation", "inf"], "--elevation", 2),
    (["digest", "scene.toml", "--seed", "9223372036854775808"], "--seed", 2),
    (["export", "scene.toml"], "--out", 2),
    (["export", "scene.toml", "--out", "x", "--format", "step"], "--format", 2),
    (["render", "scene.toml", "--out", "/nowhere/p.png"], "/nowhere/p.png", 2),
    (["render", "scene.toml", "--setting", "ultra"], "--setting", 2),
    (["list", "sins"], "sins", 2),
    (["digest", "gobelt"], "no scene named 'gobelt'; did you mean 'goblet'?", 2),
    (["digest", "wholly_unlike"], "no scene named 'wholly_unlike'; `voxmelt list scenes`", 2),
    (["verify", "bunny_small_viscous", "--set", "flow.viscous.stages_max=2"], "no stage that relaxes heads", 2),
    (["explore", "bunny_small_viscous", "--device", "zu7ev", "--set", "flow.viscous.stages_max=2"], "no stage that relaxes heads", 2),
    (["verify", "scene.toml", "--plant", "gremlin"], "gremlin", 2),
    (["verify", "scene.toml", "--plant", "vent-rate", "--quiet"], "nothing that this fault could change", 2),
    (["verify", "scene.toml", "--picture", "--plant", "vent-rate"], "--plant vent-rate: unknown in the ray caster", 2),
    (["verify", "scene.toml", "--picture", "--plant", "met-eye", "--plant-step", "1"], "--plant-step: a picture has no steps", 2),
    (["verify", "scene.toml", "--picture", "--plant", "met-eye", "--no-compare"], "--plant: with --no-compare no stage", 2),
    (["verify", "scene.toml", "--plant", "met-eye"], "--plant met-eye: unknown", 2),
    (["verify", "scene.toml", "--machine", "--picture"], "--machine: it draws pictures without --picture", 2),
    (["verify", "scene.toml", "--machine", "--plant", "no-such"], "--plant no-such: unknown", 2),
    (["verify", "scene.toml", "--machine", "--plant", "met-depth", "--plant-step", "2"], "--plant-step: a picture has no steps", 2),
    (["verify", "scene.toml", "--machine", "--size-fifos", "f.toml"], "--size-fifos: only of the pipeline alone", 2),
    (["verify", "scene.toml", "--machine", "--steps", "5", "--frames", "2"], "--frames 2: --steps 5 is no multiple", 2),
    (["verify", "scene.toml", "--machine", "--set", "hw.clock_mhz=0"], "hw.clock_mhz", 2),
    (["verify", "scene.toml", "--machine", "--set", "hw.pipes=0"], "hw.pipes", 2),
    (["verify", "scene.toml", "--machine", "--view", "here"], "--view here", 2),
    (["verify", "scene.toml", "--hw", "huge"], "--hw huge", 2),
    (["verify", "scene.toml", "--hw", "none.toml"], "none.toml", 2),
    (["verify", "scene.toml", "--set", "hw.lanes=33"], "hw.lanes", 2),
    (["verify", "scene.toml", "--set", "hw.lanes=64"], "hw.lanes", 2),
    (["verify", "scene.toml", "--set", "hw.fifo_depth=0"], "hw.fifo_depth", 2),
    (["verify", "scene.toml", "--set", "hw.lane=4"], "hw.lanes", 2),
    (["verify", "scene.toml", "--steps", "0"], "--steps", 2),
    (["verify", "scene.toml", "--plant-step", "3"], "--plant-step", 2),
    (["verify", "scene.toml", "--from", "4294967290"], "--from", 2),
    (["verify", "scene.toml", "--set", "hw.cascade=x"], "hw.cascade", 2),
    (["run", "scene.toml", "--set", "hw.lanes=4"], "hw", 2),
]


class BadInput(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        for name, text in {**FILES, "file": "a file\n"}.items():
            write(self.folder, text, name)

    def tearDown(self):
        self.temporary.cleanup()

    def refused(self, arguments, fragment, code):
        before = sorted(p.name for p in self.folder.iterdir())
        result = voxmelt(*arguments, cwd=self.folder, timeout=60)
        said = result.stderr + result.stdout
        self.assertEqual(result.returncode, code, said)
        self.assertIn(fragment, said)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), before, "left something behind")

    def test_scenes(self):
        self.assertGreaterEqual(len(SCENES), 30)
        for name, (text, fragment, code) in SCENES.items():
            with self.subTest(name):
                write(self.folder, text)
                self.refused(["run", "scene.toml"], fragment, code)

    def test_arguments(self):
        write(self.folder, SMALL)
        for arguments, fragment, code in ARGUMENTS:
            with self.subTest(" ".join(arguments)):
                self.refused(arguments, fragment, code)

    def test_the_scene_is_good_otherwise(self):
        write(self.folder, SMALL)
        self.assertEqual(voxmelt("digest", "scene.toml", "--steps", "1", cwd=self.folder).returncode, 0)

    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_a_full_disk_is_said(self):
        write(self.folder, SMALL)
        result = voxmelt("digest", "scene.toml", "--steps", "0", "--report", "/dev/full", cwd=self.folder)
        self.assertIn(result.returncode, (2, 3), result.stderr)
        limited = f"ulimit -f 1; trap '' XFSZ; exec '{PROGRAM}' export scene.toml --out big --set 'grid.size=[64,64,64]'"
        result = subprocess.run(["bash", "-c", limited], cwd=self.folder, capture_output=True, text=True)
        self.assertIn(result.returncode, (2, 3), result.stderr)
        self.assertIn("cannot write", result.stderr)
        self.assertFalse((self.folder / "big").exists())

    def test_a_pipe_without_a_writer_is_not_waited_for(self):
        os.mkfifo(self.folder / "pipe")
        for command in (["digest", "./pipe"], ["run", "./pipe"], ["run", "--resume", "pipe"], ["info", "pipe"]):
            begin = time.monotonic()
            self.refused(command, "pipe", 2)
            self.assertLess(time.monotonic() - begin, 2, command)
        self.refused(["digest", "./pipe"], "./pipe: error: cannot read ./pipe: nobody writes into this pipe", 2)

    def test_a_pipe_whose_writer_thinks_is_waited_for(self):
        write(self.folder, SMALL)
        piped = f"'{PROGRAM}' digest --steps 1 <(sleep 1.5; cat scene.toml)"
        result = subprocess.run(["bash", "-c", piped], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        piped = f"mkfifo p; exec 7<>p; '{PROGRAM}' digest ./p"
        result = subprocess.run(["bash", "-c", piped], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr),
                         (2, "./p: error: cannot read ./p: nothing came through this pipe for 5 seconds\n"))

    def test_an_output_is_not_replaced_from_within(self):
        scene = write(self.folder, SMALL)
        self.assertEqual(voxmelt("run", scene, "--steps", 0, "--out", "o", cwd=self.folder).returncode, 0)
        for place in (".", "..", self.folder / "o"):
            here = self.folder / ("o/frames" if place == ".." else "o")
            result = voxmelt("run", scene, "--steps", 0, "--out", place, cwd=here)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn("is the current folder or one above it; choose a folder inside", result.stderr)

    # Eight scenes above the first, and no more.
    def test_how_deep_a_scene_extends(self):
        write(self.folder, SMALL, "s0.toml")
        for i in range(1, 10):
            write(self.folder, f'extends = "s{i - 1}.toml"\n', f"s{i}.toml")
        self.assertEqual(voxmelt("digest", "s8.toml", "--steps", 0, cwd=self.folder).returncode, 0)
        self.refused(["digest", "s9.toml", "--steps", 0], "extends is nested more than 8 deep", 2)

    def test_the_largest_scene_file(self):
        filled = SMALL + "#" * ((16 << 20) - len(SMALL) - 1) + "\n"
        write(self.folder, filled)
        self.assertEqual(voxmelt("digest", "scene.toml", "--steps", 0, cwd=self.folder).returncode, 0)
        write(self.folder, filled + "\n")
        self.refused(["digest", "scene.toml", "--steps", 0], "larger than 16777216 bytes", 2)

    # x and z change places, and the body in the middle stays.
    def test_fields_whose_numbers_lie_the_other_way_round(self):
        write(self.folder, SMALL)
        self.assertEqual(voxmelt("export", "scene.toml", "--steps", 0, "--out", "at0", cwd=self.folder).returncode, 0)
        write(self.folder, SMALL + '[start]\nfields = "at0"\n', "from.toml")
        file = self.folder / "at0/amount.npy"
        file.write_bytes(file.read_bytes().replace(b"'fortran_order': False", b"'fortran_order': True "))
        self.assertEqual(voxmelt("digest", "from.toml", "--steps", 0, cwd=self.folder).stdout, voxmelt("digest", "scene.toml", "--steps", 0, cwd=self.folder).stdout)

    # What has a whole path is written all the same.
    def test_a_current_folder_that_was_removed(self):
        scene = write(self.folder, SMALL)
        gone = f"mkdir gone; cd gone; rmdir ../gone; exec '{PROGRAM}' "
        for arguments, name in (("run ../scene.toml", "../scene.toml"), (f"run '{scene}'", "out/scene"),
                                (f"run '{scene}' --out o", "o"), (f"export '{scene}' --out e", "e"),
                                (f"render '{scene}' --turntable 2", "turntable"), ("run --resume x", "x"),
                                (f"digest '{scene}' --report r.json", "r.json")):
            with self.subTest(arguments):
                result = subprocess.run(["bash", "-c", gone + arguments], cwd=self.folder, capture_output=True, text=True)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertEqual(result.stderr, f"{name}: error: the current folder was removed\n")
        for command in ("run", "export"):
            result = subprocess.run(["bash", "-c", f"{gone} {command} '{scene}' --out '{self.folder}/{command}'"],
                                    cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"{self.folder}/{command}", result.stdout)
            self.assertTrue((self.folder / command).is_dir())

    def test_a_scene_may_come_through_a_pipe(self):
        write(self.folder, SMALL)
        piped = f"'{PROGRAM}' digest --steps 1 <(sleep 0.3; cat scene.toml)"
        result = subprocess.run(["bash", "-c", piped], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(result.stdout, voxmelt("digest", "scene.toml", "--steps", "1", cwd=self.folder).stdout)

    def test_what_a_scene_reads_is_never_replaced(self):
        write(self.folder, SMALL)
        self.assertEqual(voxmelt("export", "scene.toml", "--out", "start", cwd=self.folder).returncode, 0)
        write(self.folder, SMALL + '[start]\nfields = "start"\n', "on.toml")
        kept = {p.name: p.read_bytes() for p in (self.folder / "start").iterdir()}
        self.refused(["run", "on.toml", "--out", "start"], "--out start: error: the scene reads", 2)
        self.refused(["digest", "on.toml", "--report", "start/heat.npy"], "the scene reads this file", 2)
        self.assertEqual({p.name: p.read_bytes() for p in (self.folder / "start").iterdir()}, kept)
        warned = voxmelt("digest", "on.toml", "--set", "start.step=3", "--steps", "0", cwd=self.folder)
        self.assertIn("start.step = 3 is no step of visibility", warned.stderr)
        self.assertEqual(voxmelt("digest", "on.toml", "--steps", "0", cwd=self.folder).stderr, "")

    def test_a_run_goes_on_to_the_last_step_number(self):
        """2^32 - 1. Nothing is run, and nothing written, that would need a larger one."""
        write(self.folder, SMALL)
        self.assertEqual(voxmelt("export", "scene.toml", "--out", "start", cwd=self.folder).returncode, 0)
        for first in (2**31 - 8, 2**32 - 16):  # steps of visibility
            write(self.folder, SMALL + f'[start]\nfields = "start"\nstep = {first}\n', "on.toml")
            self.assertEqual(voxmelt("export", "on.toml", "--steps", "8", "--out", "late", cwd=self.folder).returncode, 0)
            whole = voxmelt("digest", "on.toml", "--steps", "15", cwd=self.folder)
            rest = voxmelt("digest", "late/scene.toml", "--steps", "7", cwd=self.folder)
            self.assertEqual((whole.returncode, rest.returncode), (0, 0), whole.stderr + rest.stderr)
            self.assertEqual(whole.stdout.split()[2:], rest.stdout.split()[2:])
        end = "16 steps from step 4294967280: step numbers end at 4294967295"
        picture = ("render", "on.toml", "--out", "late.png")
        for command in (("digest", "on.toml"), ("export", "on.toml", "--out", "later"), ("run", "on.toml", "--out", "later"), picture):
            self.refused([*command, "--steps", "16"], end, 2)
        self.refused(["run", "on.toml", "--set", "run.steps=1000", "--out", "later"], "1000 steps from step 4294967280: step numbers end", 2)
        self.assertFalse((self.folder / "later").exists() or (self.folder / "late.png").exists())
        frames = ("run", "on.toml", "--frame-every", "0", "--steps", "13", "--out", "later")
        self.assertEqual(voxmelt(*frames, cwd=self.folder).returncode, 0)
        self.refused(["run", "--resume", "later", "--steps", "+3"], "step numbers end at 4294967295", 2)
        self.assertEqual(voxmelt("run", "--resume", "later", "--steps", "+2", cwd=self.folder).returncode, 0)

    def test_two_runs_do_not_share_a_folder(self):
        write(self.folder, SMALL)
        first = subprocess.Popen([PROGRAM, "run", "scene.toml", "--steps", "4000000", "--quiet"], cwd=self.folder)
        try:
            for _ in range(100):
                if list(self.folder.glob("out/*/frames/*.png")):
                    break
                time.sleep(0.1)
            second = voxmelt("run", "scene.toml", "--steps", "1", cwd=self.folder)
            self.assertEqual(second.returncode, 2, second.stderr)
            self.assertIn("another run is writing there", second.stderr)
        finally:
            first.kill()
            first.wait()


if __name__ == "__main__":
    unittest.main(argv=["bad_input_test"], verbosity=1)
