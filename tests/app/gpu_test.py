#!/usr/bin/env python3
"""`--implementation gpu` as a user meets it: the same bits, runs that change between processor and device, refusals.

Where there is no device of OpenCL, only the refusals are tested, and the test ends with 77: skipped.
"""
import csv
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from program import PROGRAM, SMALL, voxmelt, write

ROOT = Path(__file__).resolve().parents[2]
NO_DEVICES = {"OCL_ICD_VENDORS": "/nonexistent", "CUDA_VISIBLE_DEVICES": ""}
SLOW_DRIVER = {"OPENCL_LAYERS": sys.argv[2]} if len(sys.argv) > 2 else {}
VISCOUS = SMALL.replace('law = "paper"', 'law = "viscous"\n[flow.viscous]\nkappa = 0.02')

VENT = """[grid]
size = [9, 16, 9]
[run]
frame_every = 20
[[vent]]
at = [4.5, 1.5, 4.5]
radius = 2
rate = 1
[flow]
law = "viscous"
[flow.viscous]
kappa = 20
[camera]
width = 32
height = 32
"""


def with_environment(**more):
    return os.environ | more


def devices():
    listed = voxmelt("list", "implementations").stdout
    return re.findall(r"^(gpu:\d+) ", listed, re.M)


class Refusals(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        self.scene = write(self.folder, SMALL)

    def refused(self, *arguments, names, code, **more):
        result = voxmelt(*arguments, cwd=self.folder, env=with_environment(**more))
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (code, 1), result.stderr)
        self.assertIn(names, result.stderr)
        self.assertEqual(list(self.folder.iterdir()), [self.scene], "nothing is left behind")

    def test_no_device(self):
        self.assertNotIn("gpu:", voxmelt("list", "implementations", env=with_environment(**NO_DEVICES)).stdout)
        for name in ("gpu", "gpu:0"):
            self.refused("run", self.scene, "--implementation", name, code=2,
                         names=f"--implementation {name}: error: this machine has no device of OpenCL", **NO_DEVICES)
        self.refused("run", self.scene, "--implementation", "gpu:cuda", code=2, names=" of CUDA", **NO_DEVICES)
        result = voxmelt("digest", self.scene, "--implementation", "auto", env=with_environment(**NO_DEVICES))
        self.assertEqual(result.returncode, 0, "auto takes a processor")
        self.refused("bench", "--parts", "device", code=2, names="error: this machine has no device of OpenCL", **NO_DEVICES)

    @unittest.skipUnless(devices(), "no device of OpenCL")
    def test_no_such_device(self):
        self.refused("run", self.scene, "--implementation", "gpu:77", code=2, names="error: this machine has gpu:0")
        self.refused("run", self.scene, "--implementation", "gpux", code=2, names="unknown; this build has auto")

    @unittest.skipUnless(devices(), "no device of OpenCL")
    def test_commands_that_look_at_phases(self):
        for words in (["verify", self.scene], ["bench", "--quick", "--parts", "automaton"], ["bench", "--quick", "--parts", "device,picture"]):
            self.refused(*words, "--implementation", "gpu", code=2, names="a device runs whole steps")

    @unittest.skipUnless(devices(), "no device of OpenCL")
    def test_too_little_memory(self):
        self.refused("digest", self.scene, "--implementation", "gpu", "--set", "grid.size=[200,100,200]", code=3,
                     names="error: the scene's grid is too large for the device: it has 2 MiB", VOXMELT_DEVICE_MEMORY="2")
        self.refused("digest", self.scene, "--implementation", "gpu", code=3,
                     names="error: VOXMELT_DEVICE_MEMORY is much, which is no whole number", VOXMELT_DEVICE_MEMORY="much")

    # Its kernels have not been compiled before, so the first step takes longer than a second.
    @unittest.skipUnless(devices(), "no device of OpenCL")
    def test_a_device_that_does_not_answer(self):
        with tempfile.TemporaryDirectory() as cache:
            self.refused("digest", self.scene, "--implementation", "gpu", code=3, names="does not answer for 1 s",
                         VOXMELT_DEVICE_PATIENCE="1", POCL_CACHE_DIR=cache)


@unittest.skipUnless(devices() and SLOW_DRIVER, "no device of OpenCL")
class SlowCompilers(unittest.TestCase):
    """A driver that builds a program for long, or for ever."""
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        self.scene = write(self.folder, SMALL.replace("power = 30", "power = 3"))

    def steps(self, name, seconds, patience):
        return voxmelt("digest", self.scene, "--steps", "4", "--implementation", name, cwd=self.folder,
                       env=with_environment(SLOW_BUILD=str(seconds), VOXMELT_DEVICE_PATIENCE=str(patience), **SLOW_DRIVER))

    def test_one_that_hangs_is_lost(self):
        begin = time.monotonic()
        result = self.steps("gpu", 1000, 1)
        self.assertEqual((result.returncode, result.stdout), (3, ""))
        self.assertRegex(result.stderr, r"^error: OpenCL: .* does not answer for 1 s while it builds a program\n$")
        self.assertLess(time.monotonic() - begin, 60, "nobody waits for it at the end")
        self.assertEqual(list(self.folder.iterdir()), [self.scene], "nothing is left behind")

    def test_one_that_ends_in_time_is_waited_for(self):
        result = self.steps("gpu", 2, 100)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout, self.steps("reference", 0, 1).stdout)


@unittest.skipUnless(devices(), "no device of OpenCL")
class Runs(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)

    def run_to(self, *arguments, code=0):
        result = voxmelt("run", *arguments, "--quiet", cwd=self.folder)
        self.assertEqual((result.returncode, result.stderr), (code, ""))

    def outcome(self, name):
        folder = self.folder / name
        files = {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*")
                 if p.is_file() and p.name not in ("last.vxc", "report.json")}
        report = json.loads((folder / "report.json").read_text())
        for who_and_how_long in ("seconds", "memory", "implementation", "implementation_reason", "threads", "visibility"):
            del report[who_and_how_long]
        return files, report

    def test_a_run_goes_from_the_processor_to_the_device_and_back(self):
        for law, text in (("paper", SMALL), ("viscous", VISCOUS)):
            with self.subTest(law=law):
                scene = write(self.folder, text, f"{law}.toml")
                self.run_to(scene, "--out", "straight", "--steps", "9", "--implementation", "reference")
                self.run_to(scene, "--out", "mixed", "--steps", "3", "--implementation", "reference")
                self.run_to("--resume", "mixed", "--steps", "6", "--implementation", "gpu")
                self.run_to("--resume", "mixed", "--steps", "9", "--implementation", "reference")
                self.assertEqual(self.outcome("mixed"), self.outcome("straight"))

    def test_a_killed_run_goes_on(self):
        scene = write(self.folder, SMALL.replace("steps = 6", "steps = 4000").replace("frame_every = 3", "frame_every = 1000"))
        self.run_to(scene, "--out", "straight")
        words = [PROGRAM, "run", str(scene), "--out", "killed", "--implementation", "gpu", "--checkpoint-every", "20"]
        process = subprocess.Popen(words, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 300
        while not list(self.folder.glob("killed.partial-*/checkpoints/*.vxc")):
            self.assertTrue(process.poll() is None and time.monotonic() < deadline)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.run_to("--resume", "killed", "--implementation", "gpu")
        self.assertEqual(self.outcome("killed"), self.outcome("straight"))

    def on_device(self, report):
        return json.loads((self.folder / report).read_text())["seconds"]["on_device"]

    # The first frame is that of a state which the device does not have yet.
    def test_frames_are_drawn_where_the_state_is(self):
        scene = write(self.folder, SMALL)
        for name, look, by_device in (("usual", "look.glow=false", True), ("glowing", "look.glow=true", True),
                                      ("clear", "look.clear=[4,4,4]", True)):
            with self.subTest(look=look):
                self.run_to(scene, "--set", look, "--out", f"{name}_host", "--implementation", "reference")
                self.run_to(scene, "--set", look, "--out", f"{name}_device", "--implementation", "gpu")
                self.assertEqual(self.outcome(f"{name}_device"), self.outcome(f"{name}_host"))
                self.assertEqual(self.on_device(f"{name}_host/report.json"), 0)
                self.assertEqual(self.on_device(f"{name}_device/report.json") > 0, by_device)
        frames = [(self.folder / f"usual_device/frames/frame_{step:05}.png").read_bytes() for step in (0, 2)]
        self.assertNotEqual(*frames, "a picture of what does not change shows little")

    # Liquid that presses against the top is found without the state, and described with it.
    def test_a_needle_over_a_vent_is_warned_of(self):
        vent = VENT.replace("rate = 1\n", "rate = {}\n")
        for rate, count in ((1, 1), (0.01, 0)):
            scene = write(self.folder, vent.format(rate), "vent.toml")
            said = []
            for who in ("reference", "gpu"):
                self.run_to(scene, "--steps", "120", "--implementation", who, "--out", f"{who}_{count}")
                report = json.loads((self.folder / f"{who}_{count}/report.json").read_text())
                said.append([line for line in report["warnings"] if "presses against the top" in line])
            self.assertEqual(said[0], said[1])
            self.assertEqual(len(said[0]), count)
        self.assertGreater(self.on_device("gpu_1/report.json"), 0)

    def rendered(self, *arguments, **more):
        result = voxmelt("render", self.folder / "scene.toml", "--steps", "3", "--quiet", *arguments, cwd=self.folder,
                         env=with_environment(**more))
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_pictures_of_render(self):
        write(self.folder, SMALL)
        for setting, more, by_device in (("fast", [], True), ("normal", [], True), ("best", [], True),
                                         ("normal", ["--normals", "normals.png"], False),
                                         ("normal", ["--set", "camera.distance=2"], False)):
            with self.subTest(setting=setting, more=more):
                for who in ("reference", "gpu"):
                    self.rendered("--setting", setting, *more, "--implementation", who, "--out", f"{who}.png", "--report", f"{who}.json")
                self.assertEqual((self.folder / "gpu.png").read_bytes(), (self.folder / "reference.png").read_bytes())
                self.assertEqual(self.on_device("gpu.json") > 0, by_device)
        for who in ("reference", "gpu"):
            self.rendered("--turntable", "3", "--implementation", who, "--out", who)
        for view in range(3):
            name = f"view_{view:03}.png"
            self.assertEqual((self.folder / "gpu" / name).read_bytes(), (self.folder / "reference" / name).read_bytes())

    # The state has its room, and the picture beside it has none.
    def test_too_little_memory_for_a_picture(self):
        write(self.folder, SMALL)
        larger = ["--set", "grid.size=[100,40,100]"]
        self.rendered(*larger, "--implementation", "reference", "--out", "host.png")
        self.rendered(*larger, "--implementation", "gpu", "--out", "device.png", "--report", "report.json", VOXMELT_DEVICE_MEMORY="10")
        self.assertEqual((self.folder / "device.png").read_bytes(), (self.folder / "host.png").read_bytes())
        self.assertEqual(self.on_device("report.json"), 0)

    def test_bench(self):
        scene = write(self.folder, SMALL)
        result = voxmelt("bench", "--quick", "--scenes", scene, "--from", "2", "--implementation", "gpu", "--threads", "1",
                         "--out", "out", cwd=self.folder, timeout=600)
        self.assertEqual(result.returncode, 0, result.stderr)
        report = json.loads((self.folder / "out/bench.json").read_text())
        self.assertEqual((report["cases"], report["pictures"]), ([], []))
        device = report["device"]
        self.assertEqual(device["implementation"], "gpu:0")
        self.assertGreater(device["copy_bytes_per_second"], 1e8)
        self.assertTrue(0 < device["launch_seconds"] < 0.1)
        case, = device["cases"]
        self.assertEqual((case["workload"], case["checked_against"]), ("scene:scene/step:2", "reference"))
        seconds = 1e-3 * case["milliseconds"]
        copied = case["bytes_per_cell"] * case["active_cells"] / seconds
        self.assertAlmostEqual(case["percent_of_copy"], 100 * copied / device["copy_bytes_per_second"])
        self.assertAlmostEqual(case["percent_of_launches"], 100 * case["launches"] * device["launch_seconds"] / seconds)
        self.assertAlmostEqual(case["processor"]["times_as_long"], case["processor"]["milliseconds"] / case["milliseconds"])
        # Which kernels a step of the paper's law has, and how often.
        kernels = {kernel["name"]: kernel["calls"] for kernel in case["kernels"]}
        self.assertEqual({name: kernels.get(name) for name in ("list_awake", "list_givers", "melt", "gravity", "find_patterns", "apply_patterns")},
                         {"list_awake": 1, "list_givers": 1, "melt": 1, "gravity": 1, "find_patterns": 1, "apply_patterns": 1})
        self.assertEqual(case["launches"], sum(kernels.values()))
        self.assertEqual([k["name"] for k in sorted(case["kernels"], key=lambda k: -k["milliseconds"])],
                         [k["name"] for k in case["kernels"]], "the longest is first")
        # A byte a cell says what is solid and inert. Rows of words and a border are around the grid.
        x, y, z = case["grid"]
        row = (x + 32) // 32 * 32
        cells = row * (y + 1) * (z + 2) + 2 * row + 32
        self.assertEqual(case["masks"]["bytes"], cells)
        self.assertGreater(case["upload"]["bytes"], case["download"]["bytes"] + cells)
        self.assertGreater(case["visibility"]["rays"], 0)
        self.assertGreater(case["visibility"]["milliseconds"], 0)
        picture = case["picture"]
        self.assertEqual((picture["width"], picture["height"]), (64, 48))
        self.assertGreater(picture["launches"], 40)
        self.assertTrue(0 < picture["draw_milliseconds"] < picture["milliseconds"])
        self.assertGreater(picture["processor_milliseconds"], 0)
        # The bytes of the image, and a number for each column of the ground.
        self.assertEqual(picture["fetched_bytes"], 3 * 64 * 48 + 4 * x * z)
        for line in ("state there", "masks back", "state back", "visibility", "picture", "gravity"):
            self.assertRegex(result.stdout, rf"(?m)^  {line} +[0-9.]+ ms")
        with open(self.folder / "out/bench.csv", newline="") as file:
            written, = csv.DictReader(file)
        self.assertEqual((written["subject"], written["implementation"], written["gravity_milliseconds"]), ("step", "gpu:0", ""))
        self.assertAlmostEqual(float(written["milliseconds"]), case["milliseconds"])
        self.assertAlmostEqual(float(written["percent_of_roof"]), case["percent_of_copy"])
        self.page(self.folder / "out")

    def page(self, out):
        """The page of docs comes from what `bench` writes."""
        stub = self.folder / "voxmelt"  # bench --implementation gpu --out FOLDER
        stub.write_text(f'#!/bin/sh\ncp -r "{out}" "$5"\n')
        stub.chmod(0o755)
        result = subprocess.run([ROOT / "bench/write_gpu.sh", stub], capture_output=True, text=True,
                                env=with_environment(WRITE_TO=str(self.folder / "docs")))
        self.assertEqual(result.returncode, 0, result.stderr)
        page = (self.folder / "docs/results/gpu.md").read_text()
        self.assertNotIn("<!-- table", page)
        for heading in ("| device | driver |", "| workload | grid | ms a step |", "| workload | state there, ms |", "| workload | pixels |"):
            self.assertIn(heading, page)
        for block in re.findall(r"(?:^\|.*\n)+", page, re.M):
            self.assertEqual(len({row.count("|") for row in block.splitlines()}), 1, block)


if __name__ == "__main__":
    del sys.argv[1:]
    program = unittest.main(exit=False, verbosity=2)
    sys.exit(1 if not program.result.wasSuccessful() else 0 if devices() else 77)
