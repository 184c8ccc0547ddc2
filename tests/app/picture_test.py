#!/usr/bin/env python3
"""`voxmelt verify --picture`: what it prints, writes and reports, on a small scene; bad use ends in one line."""
import json
import shlex
import tempfile
import unittest
from pathlib import Path

from program import SMALL, voxmelt, write

STEP = 16  # of visibility: later ones would begin there


class Picture(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.scene = write(self.folder, SMALL)

    def tearDown(self):
        self.temporary.cleanup()

    def picture(self, *arguments, code=0):
        result = voxmelt("verify", self.scene, "--picture", "--from", STEP, *arguments, "--report", "p.json",
                         cwd=self.folder)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result.stdout, json.loads((self.folder / "p.json").read_text())

    def test_a_good_run_says_so_and_its_report_sums_up(self):
        for sets in ([], ["hw.pipes=2", "hw.stall_seed=5", "hw.fifo_depth=2", "hw.bus_bytes=32"]):
            out, report = self.picture("--size", "40x28", *[a for s in sets for a in ("--set", s)])
            self.assertIn("no difference", out)
            self.assertTrue(report["good"])
            self.assertEqual(report["different_pixels"], 0)
            for key in ("difference", "planted", "replay"):
                self.assertNotIn(key, report)
            pipes, bus = report["configuration"]["pipes"], report["configuration"]["bus_bytes"]
            self.assertEqual((pipes, bus), (2, 32) if sets else (1, 64))
            self.assertEqual(report["cycles"], report["cycles_of_last_frame"])

            stages = {stage["name"]: stage for stage in report["stages"]}
            self.assertGreaterEqual(len(stages), 25)
            for stage in report["stages"]:
                self.assertEqual(sum(stage[key] for key in ("busy", "starved", "blocked", "memory", "fill", "drain")),
                                 pipes * report["cycles"], stage["name"])
            rays, pixels = report["rays"], 40 * 28
            self.assertGreater(rays, pixels, "nothing is drawn twice")
            self.assertEqual((rays - pixels) % 8, 0)
            for name in ("set-up", "met", "colour", "press", "pixel"):
                self.assertEqual(stages[name]["busy"], rays, name)
            self.assertGreater(report["compared_numbers"], 20 * rays)

            # Two frames of 5 x 4 tiles are written; the second pass reads each tile and those beside it.
            memory = report["memory"]
            self.assertEqual(memory["written_bytes"], 2 * 20 * 192)
            tiles = 5 * 20 - 2 * (5 + 4)
            misses = sum(cache["misses"] for cache in report["caches"])
            lines = sum(cache["misses"] * cache["line_bytes"] for cache in report["caches"])
            self.assertEqual(memory["reads"], misses + tiles)
            self.assertEqual(memory["read_bytes"], lines + tiles * 192)
            if bus == 64:  # all lines are whole bursts
                self.assertEqual(memory["bus_cycles"], (memory["read_bytes"] + memory["written_bytes"]) // 64)
            for cache in report["caches"]:
                self.assertLessEqual(cache["misses"], cache["lookups"], cache["name"])
                self.assertEqual(cache["line_bytes"] % 64, 0)

    def test_the_picture_is_that_of_render(self):
        for view, setting in (((35, 20), "normal"), ((-120, 60), "fast"), ((10, -15), "best")):
            self.picture("--view={},{}".format(*view), "--setting", setting, "--size", "45x33", "--png", "hard.png")
            drawn = voxmelt("render", self.scene, "--steps", STEP, "--azimuth", view[0], "--elevation", view[1], "--size",
                            "45x33", "--setting", setting, "--out", "soft.png", cwd=self.folder)
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
            self.assertEqual((self.folder / "hard.png").read_bytes(), (self.folder / "soft.png").read_bytes(), view)

    def test_later_frames_find_warm_caches(self):
        _, one = self.picture("--size", "32x32")
        _, three = self.picture("--size", "32x32", "--frames", 3)
        for key in ("rays", "walk_samples", "compared_numbers"):
            self.assertEqual(three[key], 3 * one[key], key)
        self.assertLess(three["cycles_of_last_frame"], one["cycles_of_last_frame"])
        self.assertLess(three["memory"]["reads"], 3 * one["memory"]["reads"])
        self.assertGreater(three["cycles"], 2 * three["cycles_of_last_frame"])

    def test_no_compare_compares_the_bytes(self):
        _, compared = self.picture("--size", "32x32")
        out, bytes_alone = self.picture("--size", "32x32", "--no-compare")
        self.assertIn("no difference", out)
        self.assertEqual(bytes_alone["compared_numbers"], 32 * 32)
        for key in ("cycles", "rays", "memory", "stages", "caches"):
            self.assertEqual(bytes_alone[key], compared[key], key)

    def test_quiet_prints_no_table(self):
        loud, _ = self.picture("--size", "16x16")
        quiet, _ = self.picture("--size", "16x16", "--quiet")
        self.assertIn("starved", loud)
        self.assertNotIn("starved", quiet)
        self.assertIn("no difference", quiet)

    def test_a_planted_fault_is_told_and_its_pixel_drawn_alone(self):
        out, report = self.picture("--size", "32x32", "--setting", "fast", "--plant", "normal-root", code=1)
        self.assertFalse(report["good"])
        at = report["difference"]
        self.assertIn(f"DIFFERENCE behind stage normal: pixel ({at['x']}, {at['y']}), sample 0, cycle", out)
        self.assertIn("planted: normal", out)
        self.assertIn("found there", out)
        self.assertTrue(report["planted"]["found_there"])
        self.assertEqual((at["stage"], at["name"], at["sample"]), ("normal", "normal", 0))
        self.assertNotEqual(at["expected"], at["actual"])
        self.assertIn(f"pixel ({at['x']}, {at['y']}), drawn alone, fails too", out)
        self.assertEqual(report["replay"], {"pixel": f"{at['x']},{at['y']}", "fails_alone": True})

        # What it says to type shows the same difference.
        line, = [line.strip() for line in out.splitlines() if line.startswith("  voxmelt verify")]
        again = voxmelt(*shlex.split(line)[1:], "--report", "again.json", cwd=self.folder)
        self.assertEqual(again.returncode, 1, again.stderr)
        there = json.loads((self.folder / "again.json").read_text())["difference"]
        for key in ("stage", "x", "y", "sample", "name", "expected", "actual"):
            self.assertEqual(there[key], at[key], key)

    def test_the_command_to_type_repeats_every_option(self):
        scene = write(self.folder, SMALL, "it's odd.toml")
        result = voxmelt("verify", scene, "--picture", "--from", STEP, "--size", "24x24", "--setting", "fast", "--view=-30,15",
                         "--set", "hw.pipes=2", "--set", "look.liquid=[0.2, 0.3, 0.4]", "--seed", 3, "--plant", "met-depth",
                         cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stderr)
        line, = [line.strip() for line in result.stdout.splitlines() if line.startswith("  voxmelt verify")]
        typed = shlex.split(line)
        for part in (str(scene), "--picture", f"--from {STEP}", "--size 24x24", "--setting fast", "--view=-30,15",
                     "--set hw.pipes=2", "--set look.liquid=[0.2, 0.3, 0.4]", "--seed 3", "--plant met-depth", "--pixel "):
            self.assertIn(part, " ".join(typed))
        again = voxmelt(*typed[1:], cwd=self.folder)
        self.assertEqual(again.returncode, 1, again.stderr)
        self.assertIn("found there", again.stdout)

    def test_a_fault_between_pixels_is_right_alone(self):
        out, report = self.picture("--size", "32x32", "--setting", "fast", "--plant", "dealer-twice", code=1)
        self.assertEqual(report["difference"]["stage"], "dealer")
        self.assertIn("drawn alone, is right", out)
        self.assertFalse(report["replay"]["fails_alone"])
        self.assertIn("8x8", report["replay"]["pixel"])

    def test_a_hang_names_channels_and_stages(self):
        out, report = self.picture("--size", "32x32", "--plant", "channel-never-ready", code=1)
        self.assertIn("nothing moves any more; channels that hold tokens:\n  pipe 0: ", out)
        self.assertIn("channels that have room and take nothing:\n  pipe 0: texture -> matter\n", out)
        self.assertIn("a ray under way: pixel (", out)
        self.assertFalse(report["good"])
        self.assertTrue(report["planted"]["found_there"])
        out, _ = self.picture("--size", "32x32", "--plant", "cache-lost-miss", code=1)
        self.assertIn("stages that wait for the memory:\n", out)
        self.assertIn("  pipe 0: levels data\n", out)

    def test_a_part_of_the_picture_is_drawn(self):
        out, report = self.picture("--size", "32x32", "--setting", "fast", "--pixel", "20,9")
        self.assertIn("no difference", out)
        self.assertEqual((report["rays"], report["memory"]["written_bytes"]), (1, 192))
        self.picture("--size", "32x32", "--setting", "fast", "--pixel", "31,31")
        self.picture("--size", "32x32", "--setting", "fast", "--pixel", "30,29,2x3")
        _, report = self.picture("--size", "32x32", "--setting", "fast", "--pixel", "20,9,5x8")
        self.assertEqual((report["rays"], report["memory"]["written_bytes"]), (40, 4 * 192))

    def test_bad_use_ends_in_one_line(self):
        for options, message in (
                (["--view", "40"], "--view 40: want AZIMUTH,ELEVATION"),
                (["--view", "40,"], "--view 40,"),
                (["--view", "40,10,3"], "--view 40,10,3"),
                (["--size", "32"], "--size"),
                (["--size", "0x32"], "--size"),
                (["--setting", "ultra"], "--setting"),
                (["--frames", "0"], "--frames"),
                (["--frames", "many"], "--frames"),
                (["--pixel", "3"], "--pixel 3: want X,Y or X,Y,WxH"),
                (["--pixel", "3,4,5"], "--pixel 3,4,5"),
                (["--pixel", "3,4,5x6x7"], "--pixel 3,4,5x6x7"),
                (["--pixel", "64,4"], "--pixel 64,4: not in a picture of 64 x 48 pixels"),
                (["--pixel", "-1,4"], "not in a picture"),
                (["--pixel", "60,4,5x1"], "not in a picture"),
                (["--pixel", "4294967297,4"], "--pixel"),
                (["--hw", "huge"], "--hw huge"),
                (["--set", "hw.pipes=0"], "hw.pipes"),
                (["--set", "hw.pipes=65"], "hw.pipes"),
                (["--set", "hw.levels_ways=3"], "hw.levels_ways"),
                (["--set", "hw.light_spare=7"], "hw.light_spare"),
                (["--set", "hw.apron=2"], "hw.apron"),
                (["--set", "hw.level_bits=4"], "hw.level_bits"),
                (["--set", "hw.pipe=2"], "hw.pipe"),
                (["--plant", "gremlin"], "--plant gremlin: unknown in the ray caster"),
                (["--plant", "met-eye", "--plant-step", "1"], "--plant-step: a picture has no steps"),
                (["--plant", "met-eye", "--no-compare"], "--plant: with --no-compare"),
                (["--plant", "texture-bump"], "there is nothing that this fault could change"),
                (["--report", "/nowhere/r.json"], "/nowhere"),
                (["--png", "/nowhere/p.png"], "/nowhere/p.png")):
            result = voxmelt("verify", self.scene, "--picture", *options, cwd=self.folder)
            self.assertEqual(result.returncode, 2, f"{options}: {result.stdout}{result.stderr}")
            self.assertIn(message, result.stderr, options)


if __name__ == "__main__":
    unittest.main(argv=["picture_test"])
