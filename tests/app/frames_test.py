#!/usr/bin/env python3
"""The flow of frames of `voxmelt run`, and what `voxmelt render` writes besides. A script stands for ffmpeg."""
import json
import math
import os
import signal
import struct
import subprocess
import tempfile
import time
import unittest
import zlib
from pathlib import Path

from program import PROGRAM, SMALL, voxmelt, write

CAT = 'cat > "$film"'


def picture(path):
    """Width, height, numbers per pixel and all numbers of a PNG file: a plain reader, for filters 0, 1 and 2."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        name, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(name + body), name
        if name == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
        packed += body if name == b"IDAT" else b""
        at += 12 + size
    channels = {0: 1, 2: 3}[color]
    pixel = channels * depth // 8
    raw, above, rows = zlib.decompress(packed), bytes(width * pixel), b""
    for y in range(height):
        kind, *row = raw[y * (width * pixel + 1):(y + 1) * (width * pixel + 1)]
        assert kind in (0, 1, 2), kind
        for i in range(len(row)):
            row[i] = (row[i] + (0, row[i - pixel] if i >= pixel else 0, above[i])[kind]) % 256
        above = bytes(row)
        rows += above
    return width, height, channels, list(rows if depth == 8 else struct.unpack(f">{len(rows) // 2}H", rows))


class Frames(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.scene = write(self.folder, SMALL)

    def tearDown(self):
        self.temporary.cleanup()

    def with_ffmpeg(self, script):
        """An environment in which this is ffmpeg; without a script there is none."""
        programs = self.folder / "programs"
        programs.mkdir(exist_ok=True)
        (programs / "ffmpeg").unlink(missing_ok=True)
        if script:
            write(programs, f'#!/bin/sh\nPATH=/usr/bin:/bin\nfor film; do :; done\ncase "$*" in */dev/zero*) exit 0;; esac\n'
                            f"{script}\n", "ffmpeg").chmod(0o755)
        return {**os.environ, "PATH": str(programs)}

    def run_scene(self, out, *arguments, script=CAT, code=0):
        result = voxmelt("run", self.scene, "--out", out, *arguments, cwd=self.folder, env=self.with_ffmpeg(script))
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    # A frame is what `render` draws of its step, by the setting that was asked for, also after a resumption.
    def test_frames_are_of_the_setting(self):
        seen = set()
        for setting in ("fast", "normal", "best"):
            asked = () if setting == "normal" else ("--setting", setting)
            self.run_scene(setting, "--steps", 3, "--frame-every", 3, *asked)
            result = voxmelt("run", "--resume", setting, "--steps", 6, cwd=self.folder, env=self.with_ffmpeg(CAT))
            self.assertEqual(result.returncode, 0, result.stderr)
            for frame, step in enumerate((0, 3, 6)):
                drawn = voxmelt("render", self.scene, "--steps", step, "--setting", setting, "--out", "one.png", cwd=self.folder)
                self.assertEqual(drawn.returncode, 0, drawn.stderr)
                made = self.folder / setting / f"frames/frame_{frame:05d}.png"
                self.assertEqual(made.read_bytes(), (self.folder / "one.png").read_bytes(), f"{setting}, step {step}")
            seen.add(made.read_bytes())
        self.assertEqual(len(seen), 3, "the settings draw the same: the test would prove nothing")
        refused = voxmelt("run", self.scene, "--setting", "better", cwd=self.folder)
        self.assertEqual((refused.returncode, "best" in refused.stderr), (2, True), refused.stderr)

    def test_no_byte_depends_on_threads(self):
        made, reports = [], []
        for threads in (1, 2, 8):
            self.run_scene(f"t{threads}", "--steps", 20, "--frame-every", 1, "--threads", threads)
            out = self.folder / f"t{threads}"
            made.append({p.relative_to(out): p.read_bytes() for p in out.rglob("*")
                         if p.is_file() and p.name not in ("report.json", "last.vxc")})
            reports.append(json.loads((out / "report.json").read_text()))
            for key in ("threads", "seconds", "memory"):
                reports[-1].pop(key)
        frames = [self.folder / f"t1/frames/frame_{i:05d}.png" for i in range(21)]
        self.assertEqual(len(made[0]), len(frames) + 3)  # sheet, film, and the list of all
        self.assertEqual(made[0][Path("film.mp4")], b"".join(bytes(picture(f)[3]) for f in frames))
        self.assertGreater(len({f.read_bytes() for f in frames}), 10, "nothing moves: the test would prove nothing")
        for other in (1, 2):
            self.assertEqual(made[0], made[other])
            self.assertEqual(reports[0], reports[other])

    def test_times_are_those_of_the_work(self):
        self.run_scene("one", "--threads", 1, "--size", "400x300")
        seconds = json.loads((self.folder / "one/report.json").read_text())["seconds"]
        self.assertGreater(seconds["render"], 0)
        self.assertGreater(seconds["encode"], 0)
        parts = sum(value for key, value in seconds.items() if key not in ("total", "wait"))
        self.assertLessEqual(parts, seconds["total"], "one thread does all in turn")

    def test_a_film_that_fails_leaves_the_frames(self):
        for threads in (1, 2):
            for script, note in (("", "no film: ffmpeg cannot be started: No such file or directory (Debian's package `ffmpeg` has it)"),
                                 ("cat > /dev/null; exit 3", "no film: ffmpeg failed with exit status 3"),
                                 ('head -c 100 > "$film"; kill -9 $$', "no film: ffmpeg failed with exit status 128")):
                with self.subTest(note, threads=threads):
                    said = self.run_scene("out", "--size", "300x300", "--threads", threads, "--film", "mp4", script=script).stdout
                    self.assertIn(f"film           {note}\n", said)
                    self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                                     [".voxmelt-output", "contact_sheet.png", "frames", "last.vxc", "report.json"])
                    self.assertEqual(len(list((self.folder / "out/frames").iterdir())), 3)

    def test_a_film_has_as_many_frames_a_second_as_asked(self):
        keep = 'echo "$@" >> arguments.txt; cat > "$film"'
        for threads in (1, 2):
            for asked, wanted in (((), "12"), (("--fps", 30), "30")):
                with self.subTest(asked, threads=threads):
                    (self.folder / "arguments.txt").unlink(missing_ok=True)
                    self.run_scene("fps", "--threads", threads, *asked, script=keep)
                    words = (self.folder / "arguments.txt").read_text().split()
                    self.assertEqual(words[words.index("-framerate") + 1], wanted)
        for wrong in (0, 241, "fast"):
            self.assertEqual(voxmelt("run", self.scene, "--fps", wrong, cwd=self.folder).returncode, 2)

    # Seven frames stand in two rows of four, at half their size: 32 x 24, with gaps of 6.
    def test_a_sheet_of_seven_frames(self):
        self.run_scene("seven", "--steps", 6, "--frame-every", 1)
        width, height, _, sheet = picture(self.folder / "seven/contact_sheet.png")
        self.assertEqual((width, height), (4 * (32 + 6) + 6, 2 * (24 + 6) + 6))
        for i in range(8):
            left, top = 6 + i % 4 * 38, 6 + i // 4 * 30
            shown = [sheet[3 * ((top + y) * width + left + x) + c] for y in range(12, 24) for x in range(32) for c in range(3)]
            if i == 7:
                self.assertEqual(len({tuple(shown[k:k + 3]) for k in range(0, len(shown), 3)}), 1, "the eighth place is empty")
                continue
            frame = picture(self.folder / f"seven/frames/frame_{i:05}.png")[3]
            halved = [(sum(frame[3 * ((2 * y + dy) * 64 + 2 * x + dx) + c] for dy in (0, 1) for dx in (0, 1)) + 2) // 4
                      for y in range(12, 24) for x in range(32) for c in range(3)]
            self.assertEqual(shown, halved, f"frame {i}, below its label")

    # It ends after the steps it was asked for, not after those of the scene.
    def test_the_film_of_a_resumed_run_has_all_frames(self):
        process = subprocess.Popen([PROGRAM, "run", self.scene, "--out", "r", "--steps", "3000", "--frame-every", "500",
                                    "--checkpoint-every", "7"], cwd=self.folder, stderr=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, env=self.with_ffmpeg(CAT))
        deadline = time.monotonic() + 100
        while len(list(self.folder.glob("r.partial-*/frames/*.png"))) < 2 and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 4, "it was interrupted")
        result = voxmelt("run", "--resume", "r", cwd=self.folder, env=self.with_ffmpeg(CAT))
        self.assertEqual(result.returncode, 0, result.stderr)
        out = self.folder / "r"
        self.assertEqual(json.loads((out / "report.json").read_text())["steps"], 3000)
        frames = sorted((out / "frames").iterdir())
        self.assertEqual(len(frames), 7)
        self.assertEqual((out / "film.mp4").read_bytes(), b"".join(bytes(picture(f)[3]) for f in frames))

    # The terminal interrupts a whole group of processes. The film is finished all the same.
    def test_an_interrupt_keeps_frames_sheet_and_film(self):
        for threads in ("1", "2"):
            out = self.folder / f"i{threads}"
            process = subprocess.Popen([PROGRAM, "run", self.scene, "--out", out, "--steps", "4000000", "--frame-every", "2",
                                        "--threads", threads, "--quiet"], cwd=self.folder, start_new_session=True,
                                       env=self.with_ffmpeg(CAT))
            for _ in range(200):
                time.sleep(0.05)
                if len(list(self.folder.glob(f"i{threads}.partial*/frames/*.png"))) > 20:
                    break
            os.killpg(process.pid, signal.SIGINT)
            self.assertEqual(process.wait(60), 4)
            steps = json.loads((out / "report.json").read_text())["steps"]
            frames = sorted((out / "frames").iterdir())
            # A frame that is being drawn is given up, and no one begins after it.
            self.assertIn(steps // 2 + 1 - len(frames), (0, 1, 2))
            self.assertEqual([f.name for f in frames], [f"frame_{i:05}.png" for i in range(len(frames))])
            self.assertEqual((out / "film.mp4").read_bytes()[-64 * 48 * 3:], bytes(picture(frames[-1])[3]))
            self.assertEqual((out / "film.mp4").stat().st_size, len(frames) * 64 * 48 * 3)
            self.run_scene("again", "--steps", 2 * (len(frames) - 1), "--frame-every", 2, "--quiet")
            self.assertEqual((out / "contact_sheet.png").read_bytes(), (self.folder / "again/contact_sheet.png").read_bytes())

    # Even where no other frame comes for days.
    def test_a_file_that_may_not_grow_ends_the_run(self):
        for threads in (1, 2, 8):
            limited = (f"ulimit -f 1; trap '' XFSZ; exec '{PROGRAM}' run scene.toml --out o --steps 4000000000 --frame-every 0 "
                       f"--threads {threads}")
            result = subprocess.run(["bash", "-c", limited], cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertRegex(result.stderr, r"(?m)^/\S+/frames/frame_00000\.png: error: cannot be written: File too large\n$")
            self.assertEqual([p.name for p in self.folder.iterdir() if p.name not in ("scene.toml", "programs")], [])

    # 300 KB are full after some frames. What stood there before stays.
    def test_a_full_disk_ends_the_run_and_loses_nothing(self):
        small = self.folder / "small"
        small.mkdir()
        script = (f"mount -t tmpfs -o size=300k none '{small}' || exit 77; cd '{small}'; '{PROGRAM}' run ../scene.toml --out o "
                  "--steps 0 --quiet; echo kept $?; cksum < o/report.json; '{0}' run ../scene.toml --out o --frame-every 1 "
                  "--steps 4000000 --quiet --threads {1}; echo ended $?; cksum < o/report.json; ls").replace("{0}", PROGRAM)
        for threads in (1, 2):
            result = subprocess.run(["unshare", "-rm", "bash", "-c", script.replace("{1}", str(threads))], timeout=120,
                                    capture_output=True, text=True)
            if result.returncode == 77 or "unshare" in result.stderr:
                self.skipTest("no tmpfs here")
            kept, before, ended, after, *files = result.stdout.splitlines()
            self.assertEqual((kept, ended, before, files), ("kept 0", "ended 3", after, ["o", "o.incomplete"]),
                             result.stderr)
            self.assertRegex(result.stderr, r"frames/frame_000\d\d\.png: error: cannot be written: No space left on device; "
                                            r"the run ended after step \d+ of 4000000, and what was made is kept in o.incomplete/\n$")

    # A ball of radius 4 around (6, 6, 6), seen from 40 cells away along z.
    def test_depth_and_normals_of_a_ball(self):
        ball = ('[grid]\nsize = [12, 12, 12]\n[[solid]]\nshape = "sphere"\nradius = 4\nat = [6, 6, 6]\n[flow]\nlaw = "paper"\n'
                '[camera]\ntarget = [6, 6, 6]\ndistance = 40\nazimuth = 0\nelevation = 0\nfield_of_view = 20\n'
                "width = 65\nheight = 49\n")
        write(self.folder, ball, "ball.toml")
        result = voxmelt("render", "ball.toml", "--depth", "d.png", "--normals", "n.png", "--out", "c.png", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        plane = float(result.stdout.split("cells from ")[1].split()[0])
        width, height, channels, depth = picture(self.folder / "d.png")
        self.assertEqual((width, height, channels), (65, 49, 1))
        self.assertEqual(picture(self.folder / "n.png")[:3], (65, 49, 3))
        normals = picture(self.folder / "n.png")[3]
        middle = 24 * 65 + 32
        self.assertAlmostEqual(plane + depth[middle] / 32, 36, delta=0.5)
        pixel = 2 * math.tan(math.radians(10)) / 49  # at a distance of 1
        met = 0
        for i in range(65 * 49):
            x, y = (i % 65 - 32) * pixel, (24 - i // 65) * pixel
            # The ray (x, y, -1) t from (0, 0, 40) meets the ball at the smaller root of a t^2 - 80 t + 1584 = 0.
            a = x * x + y * y + 1
            root = 6400 - 4 * a * (1600 - 16)
            away = math.hypot(x, y) * 40  # from the ball's middle, about
            n = [(c - 32768) / 16384 for c in normals[3 * i:3 * i + 3]]
            if away > 4.6:
                self.assertEqual((depth[i], normals[3 * i:3 * i + 3]), (65535, [0, 0, 0]))
            elif away < 3:
                t = (80 - math.sqrt(root)) / (2 * a)
                self.assertAlmostEqual(plane + depth[i] / 32, t, delta=0.7)
                self.assertAlmostEqual(math.hypot(*n), 1, delta=0.001)
                truth = (x * t / 4, y * t / 4, (40 - t) / 4)
                self.assertGreater(sum(p * q for p, q in zip(n, truth)), 0.93)
                met += 1
        self.assertGreater(met, 150)

    def test_depth_and_normals_are_of_one_picture(self):
        result = voxmelt("render", self.scene, "--turntable", 2, "--depth", "d.png", "--out", "t", cwd=self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("--turntable: error: --depth and --normals are of one picture", result.stderr)
        result = voxmelt("render", self.scene, "--normals", "/nowhere/n.png", "--out", "c.png", cwd=self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("/nowhere/n.png: error: there is no folder /nowhere", result.stderr)

    def test_the_trace_ends_with_the_pixel_of_the_picture(self):
        self.assertEqual(voxmelt("render", self.scene, "--steps", 3, "--out", "p.png", cwd=self.folder).returncode, 0)
        width, _, _, bytes_of = picture(self.folder / "p.png")
        refined = 0
        for x, y in ((0, 0), (63, 47), (32, 20), (30, 28), (40, 30), (20, 25), (35, 12)):
            result = voxmelt("render", self.scene, "--steps", 3, "--trace", f"{x},{y}", cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            lines = [line.split() for line in result.stdout.splitlines()]
            self.assertIn(["pixel", "pixel", str(x), str(y)], lines)
            at = 3 * (y * width + x)
            self.assertEqual(lines[-1], ["pixel", "bytes", *map(str, bytes_of[at:at + 3])])
            refined += ["pixel", "samples", "8"] in lines
        self.assertGreater(refined, 0)
        self.assertLess(refined, 7)
        self.assertFalse((self.folder / "picture.png").exists())

    def test_a_trace_is_of_a_pixel_of_the_picture(self):
        for place in ("64,0", "0,48", "-1,0", "0,-1", "1", "1,", ",1", "1,2,3", "a,b", "1, 2", "99999999999,1", ""):
            result = voxmelt("render", self.scene, f"--trace={place}", cwd=self.folder)
            self.assertEqual((result.returncode, result.stdout), (2, ""), place)
            self.assertIn("--trace", result.stderr, place)
        result = voxmelt("render", self.scene, "--trace", "64,0", cwd=self.folder)
        self.assertEqual(result.stderr, "--trace 64,0: error: not a pixel X,Y from 0,0 to 63,47\n")
        for other in (["--out", "o.png"], ["--turntable", 2], ["--depth", "d.png"], ["--normals", "n.png"]):
            result = voxmelt("render", self.scene, "--trace", "1,1", *other, cwd=self.folder)
            self.assertEqual(result.returncode, 2, other)
            self.assertIn(str(other[0]), result.stderr)
        with open("/dev/full", "w") as full:
            self.assertEqual(subprocess.run([PROGRAM, "render", self.scene, "--trace", "32,20"], cwd=self.folder, stdout=full,
                                            stderr=subprocess.PIPE).returncode, 3)

    def test_a_camera_inside_something_is_warned_of(self):
        said = "the camera stands in matter or in the ground, and sees nothing else"
        inside = ["camera.distance=0.5", "camera.azimuth=0", "camera.elevation=0"]
        for target, expected in (("[6, 5, 6]", [said]),      # the box of solid
                                 ("[2, 1, 2]", [said]),      # the floor
                                 ("[2, 8, 2]", [])):         # the air of the grid
            sets = [part for key in [*inside, f"camera.target={target}"] for part in ("--set", key)]
            result = voxmelt("render", self.scene, *sets, "--out", "v.png", "--report", "w.json", cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            warnings = [line[len("warning: "):] for line in result.stderr.splitlines() if line.startswith("warning: ")]
            self.assertEqual([line.split(": ")[-1] for line in warnings], expected, target)
            self.assertEqual(json.loads((self.folder / "w.json").read_text())["warnings"], warnings)


if __name__ == "__main__":
    unittest.main(argv=["frames_test"], verbosity=1)
