#!/usr/bin/env python3
"""`voxmelt view` makes a film of what was done: film_test.py VOXMELT

A script stands for ffmpeg and keeps the raw frames. They are those of `voxmelt render --setting best` of the saved scene. The
page goes on meanwhile. A film that is stopped, or that nobody can make, leaves the run as it was."""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "app"))
from page import Page, Server
from program import PROGRAM, SMALL, voxmelt, write

SCENE = SMALL.replace("size = [12, 10, 12]", "size = [20, 16, 20]").replace("size = [4, 4, 4]", "size = [8, 8, 8]")
KEEP = 'for film; do :; done\ncase "$*" in *zero*) exit 0;; esac\ncat > "$film"'


def pixels(png):
    """The bytes of an 8-bit RGB picture, without filters: width, height, rows."""
    width, height = struct.unpack(">II", png[16:24])
    assert png[24:26] == b"\x08\x02", "8 bits, RGB"
    at, packed = 8, b""
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        packed += png[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    data, rows, above, stride = zlib.decompress(packed), [], bytes(3 * width), 3 * width
    for y in range(height):
        kind, row = data[y * (stride + 1)], bytearray(data[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left, up, corner = (row[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
            near = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, near)[kind]) & 255
        above = bytes(row)
        rows.append(above)
    return b"".join(rows)


class FilmTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        self.scene = write(self.path, SCENE)
        (self.path / "programs").mkdir()

    def serve(self, script):
        """A server whose ffmpeg is this script, or that has none."""
        programs = self.path / "programs"
        if script:
            write(programs, f"#!/bin/sh\nPATH=/usr/bin:/bin\n{script}\n", "ffmpeg").chmod(0o755)
        before = os.environ["PATH"]
        os.environ["PATH"] = str(programs)
        try:
            return Server(PROGRAM, self.scene, "--threads", 2, cwd=self.path)
        finally:
            os.environ["PATH"] = before

    def told(self, page):
        """What a page hears of a film until it is over: texts, and the file if one comes."""
        texts = []
        while True:
            heard = page.hear()
            if heard[0] == "file":
                return texts, heard[1:]
            if heard[0] == "text" and heard[1]["type"] == "film":
                texts.append(heard[1])
                if heard[1]["over"]:
                    return texts, None

    def test_frames_are_the_best_pictures(self):
        with self.serve(KEEP) as server, Page(server) as page:
            page.rest(0)
            page.send("size 160 120")
            page.send("speed 4")
            for line in ("step 3", "change heat_source.0.at 3 14 9", "change carve 10 8 10 3", "step 4",
                         "change pour 10 13 10 3 0.9", "step 3"):
                page.send(line)
            digest = page.rest(10)[0]["digest"]
            page.send("save scene")
            write(self.path, page.file()[1].decode(), "saved.toml")
            page.send("film 1")
            page.send("film 1")
            self.assertEqual(page.text("refused")["why"], "error: a film is being made already")
            texts, (head, film) = self.told(page)
            page.send("step 1")  # the run is where it was, and goes on
            page.rest(11)
            page.send("back 10")
            self.assertEqual(page.rest(10)[0]["digest"], digest)
        self.assertEqual(head["name"], "scene.mp4")
        # the first frame may have been told before the refusal, which this page waited for
        told = [(one["frames"], one["planned"]) for one in texts]
        self.assertEqual(told, [(1, 4), (2, 4), (3, 4), (4, 4)][-len(told):])
        size = 3 * 160 * 120
        self.assertEqual(len(film), 4 * size)
        for frame, step in enumerate((0, 4, 8, 10)):
            done = voxmelt("render", "saved.toml", "--steps", step, "--size", "160x120", "--setting", "best", "--out", "one.png",
                           cwd=self.path)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(film[frame * size:(frame + 1) * size], pixels((self.path / "one.png").read_bytes()), f"step {step}")

    @unittest.skipIf(shutil.which("ffmpeg") is None, "there is no ffmpeg")
    def test_a_real_film_shows_them(self):
        with Server(PROGRAM, self.scene, "--threads", 2, cwd=self.path) as server, Page(server) as page:
            page.rest(0)
            page.send("size 160 120")
            page.send("speed 5")
            page.send("step 10")
            page.rest(10)
            page.send("film 1")
            _, (head, film) = self.told(page)
        (self.path / head["name"]).write_bytes(film)
        done = subprocess.run(["ffmpeg", "-v", "error", "-i", head["name"], "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                              cwd=self.path, capture_output=True, check=True)
        size = 3 * 160 * 120
        self.assertEqual(len(done.stdout), 3 * size)
        for frame, step in enumerate((0, 5, 10)):
            voxmelt("render", self.scene, "--steps", step, "--size", "160x120", "--setting", "best", "--out", "one.png", cwd=self.path)
            wanted, shown = pixels((self.path / "one.png").read_bytes()), done.stdout[frame * size:(frame + 1) * size]
            self.assertLess(sum(abs(a - b) for a, b in zip(wanted, shown)) / size, 6, f"step {step}")

    def test_it_can_be_stopped(self):
        with self.serve(KEEP) as server, Page(server) as page:
            page.rest(0)
            page.send("step 2000")
            digest = page.rest(2000)[0]["digest"]
            page.send("speed 1")
            page.send("film 1")
            self.assertEqual(page.text("film")["planned"], 2001)
            page.send("film 0")
            texts, file = self.told(page)
            self.assertIsNone(file)
            self.assertEqual((texts[-1]["over"], texts[-1]["problem"]), (True, ""))
            page.send("home")
            self.assertEqual(page.rest(2000)[0]["digest"], digest)
            page.send("film 1")  # another one may begin, and the server ends at once beside it
            page.text("film")
            self.assertEqual(server.end(), (0, ""))

    def test_without_ffmpeg(self):
        with self.serve(None) as server, Page(server) as page:
            digest = page.rest(0)[0]["digest"]
            page.send("film 1")
            if "libwebp: built in" in voxmelt("--version").stdout:
                _, (head, film) = self.told(page)
                self.assertEqual((head["name"], film[:4], film[8:12], film.count(b"ANMF")), ("scene.webp", b"RIFF", b"WEBP", 1))
            else:
                self.assertIn("Debian's package `ffmpeg` has it", page.text("refused")["why"])
            for wrong in ("film", "film 2", "film x", "film 1 1"):
                page.send(wrong)
                self.assertEqual(page.text("refused")["line"], wrong)
            page.send("home")
            self.assertEqual(page.rest(0)[0]["digest"], digest)
        with self.serve("cat > /dev/null; exit 3") as server, Page(server) as page:
            page.rest(0)
            page.send("film 1")
            texts, file = self.told(page)
            self.assertIsNone(file)
            self.assertIn("no film: ffmpeg failed", texts[-1]["problem"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
