#!/usr/bin/env python3
"""The disk is full after so many bytes (tests/app/full_disk.cpp): what is complete is kept, what was there stays."""
import errno
import json
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

from program import SMALL, voxmelt, write

DISK = str(Path(sys.argv[2]).resolve())
RESERVE = 256 << 10


class FullDisk(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.scene = write(self.folder, SMALL)

    def tearDown(self):
        self.temporary.cleanup()

    def with_room(self, room, *arguments, error=errno.ENOSPC):
        # without ffmpeg: a film is written by another process
        env = dict(os.environ, LD_PRELOAD=DISK, FULL_DISK_BYTES=str(RESERVE + room), FULL_DISK_ERROR=str(error), PATH="/nowhere")
        return voxmelt(*arguments, cwd=self.folder, env=env)

    # A disk that breaks, a file that may grow no more, a handle that has become stale: frames that are whole stay.
    def test_other_errors_keep_what_is_made(self):
        self.assertEqual(voxmelt("run", self.scene, "--steps", 2, cwd=self.folder).returncode, 0)
        old = {p: p.read_bytes() for p in (self.folder / "out/scene").rglob("*") if p.is_file()}
        run = ["run", self.scene, "--steps", 40, "--frame-every", 2, "--size", "160x120", "--quiet"]
        for number in (errno.EIO, errno.EFBIG, errno.ESTALE):
            with self.subTest(os.strerror(number)):
                result = self.with_room(60000, *run, error=number)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertIn(f"{os.strerror(number)}; the run ended after step", result.stderr)
                self.assertIn("is kept in out/scene.incomplete/", result.stderr)
                self.assertGreater(len(list((self.folder / "out/scene.incomplete/frames").glob("*.png"))), 2)
                self.assertEqual({p: p.read_bytes() for p in old}, old, "the old output is as it was")
        result = self.with_room(-RESERVE, *run, error=errno.EIO)
        self.assertEqual(result.returncode, 2)
        self.assertNotIn("kept", result.stderr, "no frame was whole")

    def test_views_of_a_turntable_are_kept(self):
        views = ["render", self.scene, "--turntable", 12, "--size", "160x120", "--out", "views", "--quiet"]
        result = self.with_room(30000, *views, error=errno.EIO)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"of 12 views are kept in views.incomplete/\n.*Input/output error")
        self.assertGreater(len(list((self.folder / "views.incomplete").glob("*.png"))), 2)

    def test_a_run_keeps_its_frames_and_the_old_output(self):
        self.assertEqual(voxmelt("run", self.scene, "--steps", 2, cwd=self.folder).returncode, 0)
        old = {p: p.read_bytes() for p in (self.folder / "out/scene").rglob("*") if p.is_file()}
        run = ["run", self.scene, "--steps", 40, "--frame-every", 2, "--size", "160x120", "--quiet"]
        kept, last = set(), None
        for room in range(0, 400000, 10000):
            result = self.with_room(room, *run)
            if result.returncode == 0:
                break
            with self.subTest(room=room):
                self.assertEqual(result.returncode, 3, result.stderr)
                said = result.stderr.splitlines()
                self.assertEqual(len(said), 1, said)
                self.assertIn("No space left on device; the run ended after step", said[0])
                self.assertIn("is kept in out/scene.incomplete/", said[0])
                self.assertEqual({p.name for p in (self.folder / "out").iterdir()}, {"scene", "scene.incomplete"})
                self.assertEqual({p: p.read_bytes() for p in old}, old, "the old output is as it was")
                report = json.loads((self.folder / "out/scene.incomplete/report.json").read_text())
                self.assertIs(report["complete"], False)
                frames = sorted((self.folder / "out/scene.incomplete/frames").iterdir())
                for frame in frames:
                    self.assertTrue(frame.name.endswith(".png"), frame)
                    self.assertEqual(frame.read_bytes()[-8:-4], b"IEND", frame)
                kept.add(len(frames))
                last = {frame.name: frame.read_bytes() for frame in frames}
        else:
            self.fail("never enough room")
        self.assertGreater(len(kept), 4, "the disk was full at different places")
        self.assertIs(json.loads((self.folder / "out/scene/report.json").read_text())["complete"], True)
        whole = {p.name: p.read_bytes() for p in (self.folder / "out/scene/frames").iterdir()}
        self.assertEqual(len(whole), 21)
        self.assertEqual({name: whole[name] for name in last}, last, "what was kept is what it would have been")

    # 40 places, most of them within a checkpoint or a frame. The checkpoint before is good, with all its frames.
    def test_a_run_with_checkpoints_goes_on_from_the_one_before(self):
        run = ["run", self.scene, "--steps", 24, "--frame-every", 4, "--size", "160x120", "--quiet"]
        self.assertEqual(voxmelt(*run, "--out", "whole", cwd=self.folder).returncode, 0)
        whole = {p.relative_to(self.folder / "whole"): p.read_bytes() for p in (self.folder / "whole").rglob("*.png")}
        digest = json.loads((self.folder / "whole/report.json").read_text())["digest"]
        stopped = resumed = 0
        for place in range(40):
            room = 6000 + 2500 * place
            with self.subTest(room=room):
                result = self.with_room(room, *run, "--out", "o", "--checkpoint-every", 1)
                if result.returncode == 0:
                    shutil.rmtree(self.folder / "o")
                    continue
                stopped += 1
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertIn("No space left on device; the run ended after step", result.stderr)
                kept = self.folder / "o.incomplete"
                checkpoints = sorted((kept / "checkpoints").glob("*"))
                for checkpoint in checkpoints:
                    self.assertEqual(voxmelt("info", checkpoint, cwd=self.folder).returncode, 0)
                if "--resume o` goes on" in result.stderr:
                    resumed += 1
                    result = voxmelt("run", "--resume", "o", "--quiet", cwd=self.folder)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assertFalse(kept.exists())
                    self.assertEqual({p.relative_to(self.folder / "o"): p.read_bytes()
                                      for p in (self.folder / "o").rglob("*.png")}, whole)
                    self.assertEqual(json.loads((self.folder / "o/report.json").read_text())["digest"], digest)
                    shutil.rmtree(self.folder / "o")
                else:
                    self.assertLess(len(checkpoints), 2)
                    shutil.rmtree(kept)
        self.assertGreater(stopped, 20)
        self.assertGreater(resumed, 15)

    def test_other_outputs_leave_nothing(self):
        for arguments in (["export", self.scene, "--out", "e"], ["render", self.scene, "--out", "p.png"],
                          ["digest", self.scene, "--report", "r.json"]):
            with self.subTest(arguments[0]):
                result = self.with_room(-RESERVE + 100, *arguments, "--quiet")
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertIn("No space left on device", result.stderr)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertEqual([p.name for p in self.folder.iterdir()], ["scene.toml"])


if __name__ == "__main__":
    unittest.main(argv=["full_disk_test"], verbosity=1)
