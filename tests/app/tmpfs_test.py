#!/usr/bin/env python3
"""A real file system that is full: at 40 places of a run with checkpoints, and of exports. It is mounted where nobody
else sees it, in a name space of this test alone.

  tmpfs_test.py PROGRAM
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from program import SMALL, voxmelt, write

PLACES = 40
RESERVE = 256  # KiB: room for a report when the disk is full
RUN = ["run", "scene.toml", "--steps", 24, "--frame-every", 4, "--size", "320x240", "--quiet"]
INSIDE = "VOXMELT_TMPFS_TEST"


def pictures(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*.png")}


def data(folder):
    """What an export holds, but for the marker of its folder."""
    return {p.name: p.read_bytes() for p in folder.iterdir() if not p.name.startswith(".")}


class Tmpfs(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        self.mounted = False

    def tearDown(self):
        self.unmount()
        self.temporary.cleanup()

    def unmount(self):
        if self.mounted:
            subprocess.run(["umount", self.disk], check=True)
        self.mounted = False

    def mount(self, kilobytes):
        self.unmount()
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", self.disk], check=True)
        self.mounted = True
        write(self.disk, SMALL)

    def resize(self, kilobytes):
        subprocess.run(["mount", "-o", f"remount,size={kilobytes}k", self.disk], check=True)

    def here(self, *arguments, **env):
        return voxmelt(*arguments, cwd=self.disk, env=dict(os.environ, **env))

    def full(self, result):
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn("No space left on device", result.stderr)

    def kilobytes_of(self, *arguments):
        """What a run needs that has all the room, at its fullest: more than is left in the end."""
        self.mount(65536)
        self.assertEqual(self.here(*arguments).returncode, 0)
        used = sum(p.stat().st_blocks for p in self.disk.rglob("*") if p.is_file()) // 2
        return used

    def test_a_run_with_checkpoints(self):
        most = self.kilobytes_of(*RUN, "--out", "o") + RESERVE + 12
        least = 8 + RESERVE  # the first checkpoint finds room; four places are before it
        whole = pictures(self.disk / "o")
        digest = json.loads((self.disk / "o/report.json").read_text())["digest"]
        stopped = resumed = 0
        for place in range(PLACES):
            # without ffmpeg: a film is written by another process
            with self.subTest(place=place):
                self.mount(8 + 64 * place if place < 4 else least + (most - least) * (place - 4) // (PLACES - 4))
                result = self.here(*RUN, "--out", "o", "--checkpoint-every", 1, PATH="/nowhere")
                if result.returncode == 0:
                    self.assertEqual(pictures(self.disk / "o"), whole)
                    continue
                stopped += 1
                self.full(result)
                kept = self.disk / "o.incomplete"
                for frame in kept.rglob("*.png"):
                    if frame.name in whole:
                        self.assertEqual(frame.read_bytes(), whole[frame.name])
                for one in kept.glob("checkpoints/*"):
                    self.assertEqual(voxmelt("info", one).returncode, 0, one)
                self.resize(65536)
                if "--resume o` goes on" in result.stderr:
                    resumed += 1
                    result = self.here("run", "--resume", "o", "--quiet", PATH="/nowhere")
                else:  # it was full before the second checkpoint
                    self.assertLess(len(list(kept.glob("checkpoints/*"))), 2)
                    result = self.here(*RUN, "--out", "o", PATH="/nowhere")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertEqual(pictures(self.disk / "o"), whole)
                self.assertEqual(json.loads((self.disk / "o/report.json").read_text())["digest"], digest)
        self.assertGreater(stopped, 25)
        self.assertGreater(resumed, 10)

    # An older output of the same name is there each time, and stays.
    def test_exports(self):
        for form in ("npy", "vti"):
            export = ["export", "scene.toml", "--format", form, "--set", "grid.size=[64, 40, 64]", "--out", "e", "--quiet"]
            once = self.kilobytes_of(*export) + RESERVE - 8  # a packed image is small; two pages too few are never enough
            old = data(self.disk / "e")
            stopped = 0
            for place in range(PLACES):
                with self.subTest(format=form, place=place):
                    self.mount(65536)
                    self.assertEqual(self.here(*export).returncode, 0)
                    used = os.statvfs(self.disk)
                    used = (used.f_blocks - used.f_bfree) * used.f_bsize // 1024
                    self.resize(used + once * place // PLACES)
                    result = self.here(*export, "--steps", place)
                    stopped += result.returncode == 3
                    self.full(result)
                    self.assertEqual(data(self.disk / "e"), old)
                    self.assertEqual({p.name for p in self.disk.iterdir()}, {"scene.toml", "e"})
            self.assertEqual(stopped, PLACES)


if __name__ == "__main__":
    if INSIDE not in os.environ:
        alone = ["unshare", "--map-root-user", "--mount"]
        mount = ["sh", "-c", "mount -t tmpfs tmpfs /mnt"]
        try:
            can = subprocess.run([*alone, *mount], capture_output=True).returncode == 0
        except FileNotFoundError:
            can = False
        if not can:
            print("skipped: nothing can be mounted here")
            sys.exit(77)
        sys.exit(subprocess.run([*alone, sys.executable, *sys.argv], env=dict(os.environ, **{INSIDE: "1"})).returncode)
    unittest.main(argv=["tmpfs_test"], verbosity=1)
