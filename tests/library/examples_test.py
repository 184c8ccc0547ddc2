#!/usr/bin/env python3
"""The examples do what they say, on a small scene, and are short.

  examples_test.py ROOT FOLDER_OF_PROGRAMS VOXMELT
"""
import json
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from png_pixels import pixels  # noqa: E402

root, programs, voxmelt = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
SCENE = root / "scenes/bunny_small.toml"
LONGEST = 40


class Examples(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def good(self, name, *arguments):
        result = subprocess.run([programs / name, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_each_is_tested_and_short(self):
        sources = sorted((root / "examples").glob("*.cpp"))
        self.assertEqual([s.stem for s in sources], ["cello", "heights", "melt", "picture", "torch", "viewer"])
        for source in sources:
            self.assertLessEqual(len(source.read_text().splitlines()), LONGEST, source.name)

    def test_cello_draws_the_molten_cello(self):
        (self.folder / "scenes").symlink_to(root / "scenes")
        self.good("cello")
        self.assertEqual(struct.unpack(">II", (self.folder / "cello.png").read_bytes()[16:24]), (600, 600))

    def test_melt_prints_the_approved_digest(self):
        approved = json.loads((root / "tests/app/digests.json").read_text())["bunny_small"]["500"]
        line = self.good("melt", SCENE, 500).splitlines()[-1]
        self.assertEqual(line.split(), approved.split()[:4])

    def test_picture_draws_different_pictures(self):
        self.good("picture", SCENE, 3, 20)
        pictures = [p.read_bytes() for p in sorted(self.folder.glob("picture_?.png"))]
        self.assertEqual(len(set(pictures)), 3)
        self.assertEqual(struct.unpack(">II", pictures[0][16:24]), (320, 240))

    def test_torch_pours_and_melts(self):
        said = dict(line.rsplit(" ", 1) for line in self.good("torch", SCENE, 2).splitlines())
        self.assertGreater(int(said["mass added"]), 0)
        self.assertEqual(int(said["mass removed"]), 0)
        self.assertGreater(int(said["liquid cells"]), 100)

    def test_heights_sees_the_liquid(self):
        words = self.good("heights", SCENE, 300).split()
        self.assertEqual(words[:4], ["P2", "35", "38", "255"])
        self.assertEqual(len(words[4:]), 35 * 38)
        self.assertGreater(sum(map(int, words[4:])), 1000)

    def test_the_viewers_frames_are_the_programs_pictures(self):
        result = subprocess.run([programs / "viewer", SCENE, "3"], cwd=self.folder, capture_output=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        header, size = b"P6 320 240 255\n", 3 * 320 * 240
        frames = [result.stdout[k * (len(header) + size):][:len(header) + size] for k in range(3)]
        self.assertEqual([f[:len(header)] for f in frames], [header] * 3)
        self.assertEqual(len(set(frames)), 3)
        subprocess.run([voxmelt, "render", SCENE, "--size", "320x240", "--out", "p.png", "--quiet"], cwd=self.folder, check=True)
        self.assertEqual(frames[0][len(header):], pixels(self.folder / "p.png"))

        said = result.stderr.decode().splitlines()
        self.assertEqual(said[-1], "at step 30, saved")
        self.assertRegex(said[0], r"^in the middle: cell \d+ \d+ \d+, \d+(\.\d+)? cells away$")
        # The program goes on with the library's checkpoint.
        line = subprocess.run([voxmelt, "digest", "viewer.vxc", "--steps", "500"], cwd=self.folder, capture_output=True,
                              text=True, check=True).stdout
        self.assertEqual(line.strip(), json.loads((root / "tests/app/digests.json").read_text())["bunny_small"]["500"])

    def test_a_mistake_is_one_line(self):
        for arguments in (["missing.toml", 1], [SCENE]):
            result = subprocess.run([programs / "melt", *map(str, arguments)], capture_output=True, text=True)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)


if __name__ == "__main__":
    unittest.main(argv=["examples_test"], verbosity=1)
