#!/usr/bin/env python3
"""Films without ffmpeg: animated WebP, read back by Pillow, against the PNG files of the same run.

Pillow composes the parts of which frames are made. Where Pillow is missing, the test reads the film's chunks alone."""
import json
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
from frames_test import picture
from program import PROGRAM, SMALL, voxmelt, write

BUILT_IN = "libwebp: built in" in voxmelt("--version").stdout
# Prints the durations as JSON, and writes all pixels of all frames.
READER = """
import json, sys
from PIL import Image
film = Image.open(sys.argv[1])
durations = []
with open(sys.argv[2], "wb") as out:
    for i in range(film.n_frames):
        film.seek(i)
        out.write(film.convert("RGB").tobytes())
        durations.append(film.info["duration"])
print(json.dumps([film.size, film.info["loop"], durations]))
"""


def python_with_pillow():
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import PIL.WebPImagePlugin"], capture_output=True).returncode == 0:
            return python
    return None


PYTHON = python_with_pillow()


def chunks(data):
    """The chunks of a RIFF file or of one of its frames: name and content. Nothing may be left over."""
    found, at = [], 0
    while at < len(data):
        name, size = struct.unpack("<4sI", data[at:at + 8])
        assert at + 8 + size <= len(data), f"{name} at {at} is cut off"
        found.append((name.decode(), data[at + 8:at + 8 + size]))
        at += 8 + size + size % 2
    return found


def parts_of(film):
    """Canvas, and of each frame its place, size, duration and kind of picture, from the bytes themselves."""
    data = film.read_bytes()
    assert data[:4] == b"RIFF" and data[8:12] == b"WEBP", data[:12]
    assert struct.unpack("<I", data[4:8])[0] == len(data) - 8, "the size of all"
    (extended, canvas), (animation, loop), *frames = chunks(data[12:])
    assert (extended, canvas[0], animation, len(loop)) == ("VP8X", 2, "ANIM", 6)
    number = lambda text: int.from_bytes(text, "little")
    parts = []
    for name, content in frames:
        assert name == "ANMF" and content[15] == 2, "blends nothing, disposes of nothing"
        (kind, _), = chunks(content[16:])
        x, y, width, height, duration = (number(content[i:i + 3]) for i in range(0, 15, 3))
        parts.append(((2 * x, 2 * y, width + 1, height + 1), duration, kind))
    return (number(canvas[4:7]) + 1, number(canvas[7:10]) + 1), parts


@unittest.skipUnless(BUILT_IN, "built without libwebp: apt-get install libwebp-dev")
class Films(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.scene = write(self.folder, SMALL)

    def tearDown(self):
        self.temporary.cleanup()

    def env(self, script=""):
        """An environment in which this is ffmpeg; without a script there is none."""
        programs = self.folder / "programs"
        programs.mkdir(exist_ok=True)
        (programs / "ffmpeg").unlink(missing_ok=True)
        if script:
            write(programs, f'#!/bin/sh\nPATH=/usr/bin:/bin\nfor film; do :; done\ncase "$*" in */dev/zero*) exit 0;; esac\n{script}\n',
                  "ffmpeg").chmod(0o755)
        return {**os.environ, "PATH": str(programs)}

    def run_scene(self, out, *arguments, script="", code=0):
        result = voxmelt("run", self.scene, "--out", out, *arguments, cwd=self.folder, env=self.env(script))
        self.assertEqual(result.returncode, code, result.stderr)
        return result.stdout

    def frames(self, out):
        return [bytes(picture(f)[3]) for f in sorted((self.folder / out / "frames").iterdir())]

    def same(self, one, other):
        """Which frames differ: to show how takes minutes."""
        self.assertEqual(len(one), len(other))
        self.assertEqual([i for i, (a, b) in enumerate(zip(one, other)) if a != b], [])

    def seen(self, out):
        """Size, loops, durations and frames, as Pillow sees them."""
        if PYTHON is None:
            self.skipTest("no Pillow here: apt-get install python3-pil")
        raw = self.folder / "raw"
        result = subprocess.run([PYTHON, "-c", READER, self.folder / out / "film.webp", raw], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        (width, height), loop, durations = json.loads(result.stdout)
        data, size = raw.read_bytes(), 3 * width * height
        return (width, height), loop, durations, [data[i:i + size] for i in range(0, len(data), size)]

    def test_without_loss_every_pixel_is_that_of_its_frame(self):
        said = self.run_scene("o", "--steps", 20, "--frame-every", 1, "--film", "webp-lossless", "--size", "65x47")
        self.assertIn("film           o/film.webp\n", said)
        size, loop, durations, frames = self.seen("o")
        self.assertEqual((size, loop, len(frames)), ((65, 47), 0, 21))
        self.same(frames, self.frames("o"))
        self.assertGreater(len(set(frames)), 10, "nothing moves: the test would prove nothing")

    # The bound is for pictures: a mean of 2 levels of 255, over all pixels and colours.
    def test_the_usual_film_is_close_and_small(self):
        for kind in ("webp", "webp-lossless"):
            self.run_scene(kind, "--steps", 40, "--frame-every", 4, "--film", kind, "--size", "320x240")
        _, _, _, frames = self.seen("webp")
        wanted = self.frames("webp")
        self.assertEqual(len(frames), len(wanted))
        for i, (one, other) in enumerate(zip(frames, wanted)):
            off = [abs(a - b) for a, b in zip(one, other)]
            self.assertLess(sum(off) / len(off), 2, i)
            self.assertLess(max(off), 80, i)
        sizes = [(self.folder / kind / "film.webp").stat().st_size for kind in ("webp", "webp-lossless")]
        self.assertLess(2 * sizes[0], sizes[1])

    def test_frames_hold_what_has_changed(self):
        self.run_scene("o", "--steps", 12, "--frame-every", 1, "--film", "webp")
        canvas, parts = parts_of(self.folder / "o/film.webp")
        frames = self.frames("o")
        self.assertEqual((canvas, len(parts)), ((64, 48), 13))
        self.assertEqual(parts[0][0], (0, 0, 64, 48))
        for i in range(1, 13):
            places = [(k // 3 % 64, k // 3 // 64) for k in range(len(frames[i])) if frames[i][k] != frames[i - 1][k]]
            left, top = (min(p[axis] for p in places) & ~1 for axis in (0, 1))
            right, bottom = (max(p[axis] for p in places) + 1 for axis in (0, 1))
            self.assertEqual(parts[i][0], (left, top, right - left, bottom - top), i)
        self.assertEqual({part[2] for part in parts}, {"VP8 "})

    def test_a_frame_without_change_is_a_pixel(self):
        self.run_scene("o", "--steps", 3, "--frame-every", 1, "--film", "webp-lossless", "--set", "heat_source.0.power=0")
        self.assertEqual([part[0] for part in parts_of(self.folder / "o/film.webp")[1]], [(0, 0, 64, 48)] + 3 * [(0, 0, 1, 1)])
        self.same(self.seen("o")[3], self.frames("o"))

    def test_times_do_not_add_up_to_an_error(self):
        for fps in (7, 12, 240):
            self.run_scene("o", "--steps", 40, "--frame-every", 1, "--film", "webp", "--fps", fps)
            durations = [part[1] for part in parts_of(self.folder / "o/film.webp")[1]]
            for n in range(1, 42):
                self.assertLessEqual(abs(sum(durations[:n]) - 1000 * n / fps), 0.5, (fps, n))

    def test_it_takes_the_place_of_a_film_that_fails(self):
        self.run_scene("asked", "--steps", 8, "--frame-every", 1, "--film", "webp")
        wanted = (self.folder / "asked/film.webp").read_bytes()
        for threads in (1, 2, 8):
            for script, why in (("", "ffmpeg cannot be started: No such file or directory (Debian's package `ffmpeg` has it)"),
                                ("cat > /dev/null; exit 3", "ffmpeg failed with exit status 3"),
                                ('head -c 30000 > "$film"; kill -9 $$', "ffmpeg failed with exit status 128")):
                with self.subTest(why, threads=threads):
                    said = self.run_scene("o", "--steps", 8, "--frame-every", 1, "--threads", threads, script=script)
                    self.assertIn(f"film           o/film.webp; no film.mp4: {why}\n", said)
                    self.assertTrue((self.folder / "o/film.webp").read_bytes() == wanted)
                    self.assertEqual([p.name for p in (self.folder / "o").glob("film*")], ["film.webp"])

    def test_a_film_that_was_asked_for_is_no_other(self):
        said = self.run_scene("o", "--film", "mp4")
        self.assertIn("film           no film: ffmpeg cannot be started", said)
        self.assertEqual(list((self.folder / "o").glob("film*")), [])
        self.run_scene("o", "--film", "webp", script='cat > "$film"')
        self.assertEqual([p.name for p in (self.folder / "o").glob("film*")], ["film.webp"])
        self.run_scene("o", script='cat > "$film"')
        self.assertEqual([p.name for p in (self.folder / "o").glob("film*")], ["film.mp4"])
        wrong = voxmelt("run", self.scene, "--film", "gif", cwd=self.folder)
        self.assertEqual((wrong.returncode, "webp-lossless" in wrong.stderr), (2, True), wrong.stderr)

    def test_what_is_not_kept_is_gone(self):
        self.run_scene("o", "--film", "webp", "--keep", "sheet")
        self.assertEqual(list((self.folder / "o").glob("film*")), [])
        self.run_scene("o", "--film", "webp", "--keep", "film")
        self.assertEqual([p.name for p in (self.folder / "o").glob("*") if p.name[0] != "."].count("film.webp"), 1)

    # A resumed run makes the film that it was told to make, of all frames.
    def test_an_interrupted_film_is_whole_and_goes_on(self):
        arguments = ["run", self.scene, "--steps", "3000", "--frame-every", "100", "--film", "webp-lossless", "--quiet"]
        whole = voxmelt(*arguments, "--out", "whole", cwd=self.folder, env=self.env())
        self.assertEqual(whole.returncode, 0, whole.stderr)
        process = subprocess.Popen([PROGRAM, *arguments, "--out", "o"], cwd=self.folder, env=self.env(), stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 100
        while len(list(self.folder.glob("o.partial-*/frames/*.png"))) < 5 and time.monotonic() < deadline:
            time.sleep(0.005)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 4, "it was interrupted")
        self.assertEqual(len(parts_of(self.folder / "o/film.webp")[1]), len(self.frames("o")))
        again = voxmelt("run", "--resume", "o", "--quiet", cwd=self.folder, env=self.env())
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertTrue((self.folder / "o/film.webp").read_bytes() == (self.folder / "whole/film.webp").read_bytes())
        said = voxmelt("run", "--resume", "o", "--steps", "+100", "--film", "webp", cwd=self.folder, env=self.env())
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertEqual({part[2] for part in parts_of(self.folder / "o/film.webp")[1]}, {"VP8 "})

    # A file may have 30 KB: each frame has, and the film has not. The frames are worth more.
    def test_a_film_without_room_is_a_message(self):
        limited = (f"ulimit -f 30; trap '' XFSZ; exec '{PROGRAM}' run scene.toml --out o --steps 200 --frame-every 1 "
                   "--film webp-lossless --keep frames,film")
        result = subprocess.run(["bash", "-c", limited], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("film           no film: it cannot be written: File too large\n", result.stdout)
        self.assertEqual(list((self.folder / "o").glob("film*")), [])
        self.assertEqual(len(self.frames("o")), 201)

    def test_a_picture_may_be_too_wide(self):
        said = self.run_scene("o", "--steps", 0, "--film", "webp", "--size", "16384x16", "--setting", "fast")
        self.assertIn("film           no film: a WebP picture has at most 16383 pixels a side\n", said)
        said = self.run_scene("o", "--steps", 0, "--film", "webp", "--size", "16383x16", "--setting", "fast")
        self.assertIn("film           o/film.webp\n", said)


class WithoutLibwebp(unittest.TestCase):
    @unittest.skipIf(BUILT_IN, "built with libwebp")
    def test_what_brings_it_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = write(folder, SMALL)
            command = "this build has no libwebp: apt-get install libwebp-dev, then configure and build again\n"
            said = voxmelt("run", scene, "--film", "webp", cwd=folder)
            self.assertEqual((said.returncode, said.stderr), (2, f"--film webp: error: {command}"))
            said = voxmelt("run", scene, "--out", "o", cwd=folder, env={**os.environ, "PATH": "/nowhere"})
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertIn("no film.webp: this build has no libwebp (apt-get install libwebp-dev", said.stdout)


if __name__ == "__main__":
    unittest.main(argv=["film_test"], verbosity=1)
