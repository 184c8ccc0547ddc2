#!/usr/bin/env python3
"""What the README and --help promise of each command, on a small scene.

  commands_test.py PROGRAM              one planted fault of nine
  commands_test.py PROGRAM --faults     each planted fault, and nothing else (slow)
"""
import json
import os
import re
import shlex
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
from pathlib import Path

from program import PROGRAM, SMALL, voxmelt, write

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import vti

ROOT = Path(__file__).resolve().parents[2]
EVERY_FAULT = 1 if "--faults" in sys.argv else 9
LINE = re.compile(r"^step (\d+) digest ([0-9a-f]{16}) mass (\d+) solid (\d+) liquid (\d+)$")


class Commands(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.scene = write(self.folder, SMALL)

    def tearDown(self):
        self.temporary.cleanup()

    def good(self, *arguments):
        result = voxmelt(*arguments, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_run_writes_frames_sheet_and_report(self):
        self.good("run", self.scene)
        out = self.folder / "out/scene"
        self.assertEqual(sorted(p.name for p in (out / "frames").iterdir()),
                         ["frame_00000.png", "frame_00001.png", "frame_00002.png"])
        for picture in [out / "contact_sheet.png", *(out / "frames").iterdir()]:
            data = picture.read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", (out / "frames/frame_00000.png").read_bytes()[16:24]), (64, 48))
        report = json.loads((out / "report.json").read_text())
        for key in ("scene", "seed", "steps", "digest", "implementation", "threads"):
            self.assertIn(key, report)
        self.assertEqual(set(report["mass"]) & {"solid", "liquid", "added", "removed", "drift"},
                         {"solid", "liquid", "added", "removed", "drift"})
        self.assertEqual((report["mass"]["drift"], report["energy"]["drift"], report["heat"]["drift"]), (0, 0, 0))
        self.assertLessEqual({"solid", "liquid", "inert", "detached"}, set(report["cells"]))
        self.assertLessEqual({"source", "heat", "melt", "gravity", "spread", "excess", "visibility", "update", "render",
                              "on_device", "total"}, set(report["seconds"]))
        self.assertGreater(report["memory"]["peak_bytes"], 0)
        self.assertGreater(report["mass"]["liquid"], 0, "nothing melted: the test would prove nothing")
        self.assertEqual([p.name for p in (self.folder / "out").iterdir()], ["scene"], "no partial folder is left")

    # A box of 4-cubed full cells, of 4096 each. Before the first step nothing has melted.
    def test_the_report_says_what_is_solid(self):
        self.good("run", self.scene, "--steps", 0)
        mass = json.loads((self.folder / "out/scene/report.json").read_text())["mass"]
        self.assertEqual((mass["solid"], mass["liquid"]), (64 * 4096, 0))

    def test_the_report_repeats_the_run(self):
        self.good("run", self.scene, "--set", "heat.gamma=0.1", "--seed", "7", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        arguments = [a for s in report["set"] for a in ("--set", s)]
        line = self.good("digest", self.scene, "--steps", report["steps"], "--seed", report["seed"], *arguments)
        self.assertEqual(LINE.match(line.strip()).group(2), report["digest"])

    def test_the_report_counts_what_a_limit_cuts(self):
        (self.folder / "tank.toml").write_text('[grid]\nsize = [4, 10, 4]\n[[liquid]]\nshape = "box"\nsize = [4, 8, 4]\n'
                                               'at = [2, 4, 2]\n[flow]\nlaw = "viscous"\nviscous = { kappa = 1 }\n')
        cells = 4 * 8 * 4 * 5  # full ones, in five steps
        # Depth 8: mobility 2/9 x 64 kappa, limit 1/45.
        for sets, times, limited in (([], 64, True), (["flow.viscous.substeps=3"], 3, True),
                                     (["flow.viscous.kappa=0.001"], 1, False),
                                     (["flow.viscous.kappa=0.01", 'flow.viscous.substeps="auto"'], 7, False)):
            arguments = [a for s in sets for a in ("--set", s)]
            said = self.good("run", "tank.toml", "--steps", 5, "--frame-every", 0, "--report", "tank.json", *arguments)
            count = json.loads((self.folder / "tank.json").read_text())["limit"]
            self.assertEqual((count["cells"], count["mass"]), (times * cells, times * cells * 4096), sets)
            self.assertEqual((count["limited_cells"], count["limited_mass"]),
                             (count["cells"], count["mass"]) if limited else (0, 0), sets)
            self.assertEqual("100 % of the liquid" in said, limited, sets)
        says = "100 % of the liquid flows more slowly than its viscosity asks; flow.viscous.substeps_max above 64"
        for command in (["digest"], ["export", "--out", "tank_out"], ["render", "--out", "tank.png"]):
            done = voxmelt(*command, "tank.toml", "--steps", 5, cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(says, done.stderr, command)

    # One column of depth 2, which is cut, behind a wall; beside it columns of depth 1, which are not: 2 of 40 or 39.
    def test_a_line_says_so_above_a_twentieth(self):
        for shallow, said in ((38, False), (37, True)):
            (self.folder / "pools.toml").write_text(
                f'[grid]\nsize = [{shallow + 2}, 4, 1]\n[flow]\nlaw = "viscous"\nviscous = {{ kappa = 0.2, substeps = 1 }}\n'
                f'[[liquid]]\nshape = "box"\nsize = [{shallow}, 1, 1]\nat = [{shallow / 2}, 0.5, 0.5]\n'
                f'[[inert]]\nshape = "box"\nsize = [1, 4, 1]\nat = [{shallow + 0.5}, 2, 0.5]\n'
                f'[[liquid]]\nshape = "box"\nsize = [1, 2, 1]\nat = [{shallow + 1.5}, 1, 0.5]\n')
            lines = self.good("run", "pools.toml", "--steps", 3, "--frame-every", 0, "--report", "pools.json")
            count = json.loads((self.folder / "pools.json").read_text())["limit"]
            self.assertEqual((count["limited_mass"], count["mass"]), (3 * 2 * 4096, 3 * (shallow + 2) * 4096))
            self.assertEqual("5 % of the liquid flows more slowly" in lines, said, shallow)

    # What was remembered is believed, and a folder that cannot be written is no error.
    def test_auto_says_what_it_chose_and_why(self):
        folder = self.folder / "caches"
        supported = [line.split()[0] for line in self.good("list", "implementations").splitlines()
                     if "(not on this processor)" not in line and not line.startswith("gpu:")][1:-1]
        with unittest.mock.patch.dict(os.environ, XDG_CACHE_HOME=str(folder)):
            reports = []
            for asked in ([], ["--implementation", supported[0]]):
                self.good("digest", self.scene, "--report", "why.json", *asked)
                reports.append(json.loads((self.folder / "why.json").read_text()))
            on_card = reports[0]["implementation"].startswith("gpu:")  # then the best processor stands in the file alone
            self.assertTrue(on_card or reports[0]["implementation"] in supported)
            self.assertEqual(reports[1]["implementation"], supported[0])
            self.assertEqual(reports[1]["implementation_reason"], "asked for")
            if len(supported) == 1:
                return
            file = folder / "voxmelt" / "fastest"
            lines = [line.split(" ", 2) for line in file.read_text().splitlines()]
            (machine, chosen, reason), = [line for line in lines if "-" not in line[0]]  # the others are of cards
            self.assertRegex(machine, "^[0-9a-f]{16}$")
            if not on_card:
                self.assertEqual((chosen, reason), (reports[0]["implementation"], reports[0]["implementation_reason"]))
            self.assertRegex(reason, r"^([0-9.]+ times as fast as \S+, ){%d}in a trial on this processor$"
                             % (len(supported) - 1))
            for name in supported:
                file.write_text(f"{machine} {name} by hand\n")
                self.assertRegex(self.good("list", "implementations"), rf"\nauto         {re.escape(name)}: by hand[;\n]")
            file.unlink(), file.mkdir()
            self.assertIn("times as fast as", self.good("list", "implementations"))

    def test_the_report_says_how_many_threads_worked(self):
        here = len(os.sched_getaffinity(0))
        for asked, used in ((["--threads", 1], 1), (["--threads", 2], min(2, here)), ([], here)):
            self.good("digest", self.scene, "--report", "t.json", *asked)
            self.assertEqual(json.loads((self.folder / "t.json").read_text())["threads"], used, asked)

    # A block melts beside a wall. Whoever follows the rays, the bits are the same.
    def test_visibility_is_chosen_and_named(self):
        lines, seen = set(), {}
        for name in ("auto", "walk", "two-level", "embree"):
            result = voxmelt("digest", "lesson_shadow", "--steps", 100, "--visibility", name, "--report", "v.json",
                             cwd=self.folder)
            if name == "embree" and result.returncode == 2:
                self.assertIn("this build has no Embree", result.stderr)
                continue
            self.assertEqual(result.returncode, 0, result.stderr)
            lines.add(result.stdout)
            seen[name] = json.loads((self.folder / "v.json").read_text())["visibility"]
        self.assertEqual(len(lines), 1)
        self.assertEqual(seen["auto"]["provider"], "two-level", "a small grid")
        self.assertEqual({n: s["provider"] for n, s in seen.items() if n != "auto"}, {n: n for n in seen if n != "auto"})
        self.assertTrue(all(s["reason"] for s in seen.values()))
        self.assertGreater(seen["two-level"]["rays"], seen["two-level"]["rays_cast"])
        self.assertEqual(voxmelt("digest", "lesson_shadow", "--visibility", "mirror", cwd=self.folder).returncode, 2)

    def test_run_replaces_only_its_own_folder(self):
        self.good("run", self.scene, "--out", "mine", "--steps", "0")
        self.good("run", self.scene, "--out", "mine", "--steps", "1")
        self.assertEqual(json.loads((self.folder / "mine/report.json").read_text())["steps"], 1)
        (self.folder / "yours").mkdir()
        (self.folder / "yours/letter.txt").write_text("dear")
        result = voxmelt("run", self.scene, "--out", "yours", cwd=self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertEqual([p.name for p in (self.folder / "yours").iterdir()], ["letter.txt"])

    def test_an_output_folder_with_foreign_files_is_kept(self):
        self.good("run", self.scene, "--out", "mine", "--steps", "0")
        write(self.folder / "mine", "precious", "notes.txt")
        result = voxmelt("run", self.scene, "--out", "mine", cwd=self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("notes.txt", result.stderr)
        self.assertTrue((self.folder / "mine/notes.txt").exists())

    def test_links_and_devices_are_written_not_replaced(self):
        (self.folder / "target.json").write_text("old")
        (self.folder / "link.json").symlink_to("target.json")
        self.good("digest", self.scene, "--steps", "0", "--report", "link.json")
        self.assertTrue((self.folder / "link.json").is_symlink())
        self.assertIn("digest", json.loads((self.folder / "target.json").read_text()))
        (self.folder / "elsewhere").mkdir()
        (self.folder / "out").symlink_to("elsewhere")
        self.good("run", self.scene, "--steps", "0")
        self.assertTrue((self.folder / "elsewhere/scene/report.json").exists())

    def test_lost_output_is_an_error(self):
        for redirect in ("> /dev/full", ">&-"):
            result = subprocess.run(["bash", "-c", f"'{PROGRAM}' digest '{self.scene}' --steps 0 {redirect}"],
                                    capture_output=True, text=True)
            self.assertEqual(result.returncode, 3, redirect)
            said = "No space left on device" if "full" in redirect else "it is closed"
            self.assertEqual(result.stderr, f"standard output: error: cannot write: {said}\n")
        piped = f"'{PROGRAM}' digest '{self.scene}' --steps 1000000 --every 1 | head -1; exit ${{PIPESTATUS[0]}}"
        result = subprocess.run(["bash", "-c", piped], capture_output=True, text=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr),
                         (3, "standard output: error: cannot write: Broken pipe\n"))

    def test_a_signal_while_a_mesh_is_read_ends_at_once(self):
        os.mkfifo(self.folder / "mesh.obj")
        held = os.open(self.folder / "mesh.obj", os.O_RDWR)  # somebody may yet write
        text = SMALL.replace('shape = "box"\nsize = [4, 4, 4]', 'shape = "mesh"\nfile = "mesh.obj"\nheight = 4')
        scene = write(self.folder, text, "mesh.toml")
        before = sorted(self.folder.iterdir())
        for arguments in (["run"], ["export", "--out", "e"], ["render", "--out", "p.png"], ["verify"],
                          ["digest"]):
            with self.subTest(arguments[0]):
                process = subprocess.Popen([PROGRAM, arguments[0], scene, *arguments[1:]], cwd=self.folder,
                                           stderr=subprocess.PIPE, text=True)
                time.sleep(0.7)
                begin = time.monotonic()
                process.terminate()
                said = process.communicate(timeout=60)[1]
                self.assertLess(time.monotonic() - begin, 2)
                self.assertEqual((process.returncode, said), (4, "interrupted; nothing was written\n"))
                self.assertEqual(sorted(self.folder.iterdir()), before)
        os.close(held)

    def test_an_interrupted_export_leaves_nothing(self):
        process = subprocess.Popen([PROGRAM, "export", self.scene, "--steps", "4000000", "--out", "e"],
                                   cwd=self.folder, stderr=subprocess.DEVNULL)
        for _ in range(100):
            time.sleep(0.05)
            if len(list(self.folder.iterdir())) > 1:
                break
        time.sleep(0.2)
        process.terminate()
        self.assertEqual(process.wait(60), 4)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["scene.toml"])

    # A file of the export has begun to grow. An image is packed first.
    def test_an_export_is_left_while_it_is_written(self):
        for form, name in (("npy", "amount.npy.partial-*"), ("vti", "")):
            with self.subTest(form):
                process = subprocess.Popen([PROGRAM, "export", self.scene, "--format", form, "--out", "e",
                                            "--set", "grid.size=[256, 256, 256]"],
                                           cwd=self.folder, stderr=subprocess.PIPE, text=True)
                for _ in range(3000):
                    if list(self.folder.glob(f"e.partial-*/{name}")):
                        break
                    time.sleep(0.01)
                begin = time.monotonic()
                process.terminate()
                said = process.communicate(timeout=60)[1]
                self.assertLess(time.monotonic() - begin, 5)
                self.assertEqual((process.returncode, said), (4, "interrupted; nothing was written\n"))
                self.assertEqual([p.name for p in self.folder.iterdir()], ["scene.toml"])

    # Neither asks for the signal in the middle of what it does here for minutes.
    def test_who_does_not_listen_is_ended(self):
        for arguments in (["bench", "--scenes", self.scene, "--from", "2000000", "--out", "b", "--parts", "picture"],
                          ["verify", self.scene, "--set", "grid.size=[384, 384, 384]", "--report", "r.json"]):
            with self.subTest(arguments[0]):
                process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder,
                                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                time.sleep(1.5)
                begin = time.monotonic()
                process.terminate()
                said = process.communicate(timeout=60)[1].splitlines()
                self.assertLess(time.monotonic() - begin, 5)
                self.assertEqual((process.returncode, said[-1]), (4, "interrupted; nothing was written"))
                self.assertEqual([p.name for p in self.folder.iterdir()], ["scene.toml"])

    def test_more_threads_than_the_machine_has_say_nothing(self):
        for command in (["digest", self.scene], ["render", self.scene, "--out", "p.png"]):
            result = voxmelt(*command, "--threads", 16, "--quiet", cwd=self.folder)
            self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_a_large_picture_is_left_soon(self):
        process = subprocess.Popen([PROGRAM, "render", self.scene, "--size", "8192x8192", "--setting", "best", "--set",
                                    "camera.distance=20", "--out", "p.png"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        time.sleep(1)
        process.terminate()
        _, said = process.communicate(timeout=60)
        self.assertEqual((process.returncode, said), (4, "interrupted; nothing was written\n"))
        self.assertEqual([p.name for p in self.folder.iterdir()], ["scene.toml"])

    def test_digest_lines(self):
        lines = self.good("digest", self.scene, "--steps", "5", "--every", "2").splitlines()
        self.assertEqual([int(LINE.match(line).group(1)) for line in lines], [0, 2, 4, 5])
        self.assertEqual(len({LINE.match(line).group(3) for line in lines}), 1, "mass is conserved")
        self.assertGreater(len({LINE.match(line).group(2) for line in lines}), 1)
        self.assertEqual(self.good("digest", self.scene, "--steps", "5"), lines[-1] + "\n")

    def test_the_seed_matters_where_randomness_is_used(self):
        at = ["--steps", "40", "--set", "solid.0.temperature=0.6"]
        one = self.good("digest", self.scene, "--seed", "1", *at)
        two = self.good("digest", self.scene, "--seed", "2", *at)
        self.assertNotEqual(one, two)
        law = ["--set", "flow={law = \"viscous\", viscous = {kappa = 0.1}}"]
        self.assertEqual(self.good("digest", self.scene, "--seed", "1", *at, *law),
                         self.good("digest", self.scene, "--seed", "2", *at, *law))

    def test_the_seed_matters_in_committed_scenes(self):
        for name, steps in (("bunny_small", 250), ("lava", 30), ("lesson_spread", 20), ("paper_literal", 200)):
            lines = {voxmelt("digest", name, "--steps", steps, "--seed", seed).stdout for seed in (1, 2)}
            self.assertEqual(len(lines), 2, name)

    def test_export_and_start_from_it(self):
        self.good("export", self.scene, "--steps", "4", "--out", "at4")
        names = {p.name for p in (self.folder / "at4").iterdir()} - {".voxmelt-output"}
        fields = {f"{f}.npy" for f in ("solid", "liquid", "inert", "amount", "energy", "heat")}
        self.assertEqual(names, fields | {"parameters.json", "fields.json", "scene.toml"})
        amount = (self.folder / "at4/amount.npy").read_bytes()
        self.assertEqual(amount[:6], b"\x93NUMPY")
        self.assertIn(b"'<u2'", amount[:128])
        self.assertIn(b"(12, 10, 12)", amount[:128])
        self.assertEqual(len(amount) % 64, (2 * 12 * 10 * 12) % 64)
        write(self.folder, SMALL + '[start]\nfields = "at4"\n', "again.toml")
        start = self.good("digest", "again.toml", "--steps", "0").split()[3]
        there = self.good("digest", self.scene, "--steps", "4").split()[3]
        self.assertEqual(start, there)

    def test_an_export_says_what_its_fields_hold(self):
        self.good("export", self.scene, "--out", "e")
        said = json.loads((self.folder / "e/fields.json").read_text())
        units = {f["name"]: (f["bits"], f.get("unit")) for f in said["fields"]}
        self.assertEqual(units, {"solid": (1, None), "liquid": (1, None), "inert": (1, None),
                                 "amount": (16, "1/4096 of a full cell"), "energy": (16, "1/4096 of a full cell"),
                                 "heat": (16, "1/65535 of the scene's range")})
        self.assertIn("[z][y][x]", said["axes"])

    # The keys of --set are in it; without radiation every step is one to go on from.
    def test_an_export_is_a_scene_that_goes_on(self):
        changes = ("--set", "flow.paper.neighbours=4", "--set", "heat_source=[]")
        self.good("export", self.scene, "--steps", "5", "--out", "at5", *changes)
        self.assertIn("neighbours = 4", (self.folder / "at5/scene.toml").read_text())
        there = self.good("digest", self.scene, "--steps", "9", *changes).split()[3]
        self.assertEqual(self.good("digest", "at5/scene.toml", "--steps", "4").split()[3], there)
        self.good("export", "at5/scene.toml", "--steps", "2", "--out", "at7")
        self.assertEqual(self.good("digest", "at7/scene.toml", "--steps", "2").split()[3], there)
        self.good("export", self.scene, "--out", "v", "--format", "vti")
        self.assertNotIn("[start]", (self.folder / "v/scene.toml").read_text())

    # A default is the value that it says, and differs from the one beside it.
    def test_defaults_of_steps(self):
        def digest(*more):
            return self.good("digest", "from.toml", "--steps", "24", *(a for m in more for a in ("--set", m))).split()[3]
        self.good("export", self.scene, "--steps", "0", "--out", "at0")
        plain = SMALL.replace("visibility_every = 8\n", "")
        for key, scene, default, other in (("heat.visibility_every", plain, 1, 16), ("start.step", SMALL, 0, 8)):
            write(self.folder, scene + '[start]\nfields = "at0"\n', "from.toml")
            self.assertEqual(digest(), digest(f"{key}={default}"))
            self.assertNotEqual(digest(), digest(f"{key}={other}"), f"{key} does nothing here: the test would prove nothing")

    # A row has 16 words, and a plane is more than what is written at once.
    def test_an_export_of_wide_planes(self):
        cubes = [f'[[solid]]\nshape = "box"\nsize = [1, 1, 1]\nat = [{x}.5, 700.5, {z}.5]\n' for x, z in ((100, 0), (1023, 1))]
        scene = write(self.folder, "[grid]\nsize = [1024, 1024, 2]\n" + "".join(cubes), "wide.toml")
        self.good("export", scene, "--steps", "0", "--out", "wide")
        cells = 2 << 20
        for name, size, full in (("solid", 1, b"\1"), ("amount", 2, struct.pack("<H", 4096))):
            data = (self.folder / f"wide/{name}.npy").read_bytes()
            self.assertTrue(0 < len(data) - cells * size <= 128, len(data))
            expected = bytearray(cells * size)
            for at in (700 * 1024 + 100, (1024 + 700) * 1024 + 1023):
                expected[at * size:(at + 1) * size] = full
            self.assertTrue(data.endswith(expected), name)

    def test_export_vti_is_one_vtk_image(self):
        self.good("export", self.scene, "--steps", "2", "--out", "v", "--format", "vti")
        data = (self.folder / "v/volume.vti").read_bytes()
        self.assertIn(b'WholeExtent="0 12 0 10 0 12"', data)
        cells = 12 * 10 * 12
        self.assertEqual([len(array) for array in vti.arrays_of(data).values()], [cells] * 3 + [2 * cells] * 3)

    def test_export_writes_every_format_that_its_help_names(self):
        help_text = re.sub(r"\s+", " ", self.good("export", "--help"))
        formats = re.search(r"--format TEXT:\{([\w,]+)\}", help_text)[1].split(",")
        self.assertEqual(formats[:2], ["npy", "vti"])
        for name in formats:
            if name == "vdb" and "OpenVDB: found" not in self.good("--version"):
                continue
            self.good("export", self.scene, "--out", f"all_{name}", "--format", name)
            written = {path.name for path in (self.folder / f"all_{name}").iterdir()}
            self.assertGreater(len(written - {"parameters.json", "fields.json", "scene.toml"}), 0, name)
            self.assertIn("parameters.json", written, name)

    def test_render_one_picture_and_a_turntable(self):
        self.good("render", self.scene, "--steps", "1", "--out", "p.png", "--size", "80x60", "--setting", "fast")
        self.assertEqual(struct.unpack(">II", (self.folder / "p.png").read_bytes()[16:24]), (80, 60))
        self.good("render", self.scene, "--turntable", "3", "--out", "t", "--setting", "fast")
        pictures = [p.read_bytes() for p in sorted((self.folder / "t").glob("*.png"))]
        self.assertEqual(len(pictures), 3)
        self.assertEqual(len(set(pictures)), 3)

    def test_pictures_do_not_depend_on_threads(self):
        for n in (1, 3):
            self.good("render", self.scene, "--steps", "3", "--out", f"{n}.png", "--threads", str(n))
        self.assertEqual((self.folder / "1.png").read_bytes(), (self.folder / "3.png").read_bytes())

    def test_lists_help_and_version(self):
        self.assertIn("reference", self.good("list", "implementations"))
        self.assertIn("slump", self.good("list", "features"))
        scenes = voxmelt("list", "scenes")
        for name in ("cello", "goblet", "lava", "bunny", "paper_literal"):
            self.assertRegex(scenes.stdout, rf"(?m)^{name} +\S")
        self.assertIn("compiler:", self.good("--version"))
        told = self.good("--help")
        self.assertIn("voxmelt run cello", told)
        view = ["view"] if Path(PROGRAM).with_name("voxmelt-view").exists() else []  # where its libraries are
        commands = ["run", "digest", "export", "render", *view, "sweep", "plot", "bench", "accuracy", "verify", "rtl", "explore", "info", "new", "list"]
        self.assertEqual(re.findall(r"(?m)^  ([a-z]\w*) +\S", told.split("Subcommands:")[1]), commands)
        for command in commands:
            self.assertIn("--", self.good(command, "--help"))

    def warnings(self, *arguments):
        """Of a digest: those on stderr, which are those of the report; and the report."""
        result = voxmelt("digest", *arguments, "--report", "w.json", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        report = json.loads((self.folder / "w.json").read_text())
        said = [line[len("warning: "):] for line in result.stderr.splitlines() if line.startswith("warning: ")]
        self.assertEqual(report["warnings"], said)
        return said, report

    # The box is [4, 8] x [2, 6] x [4, 8] on a floor below y = 2.
    def test_a_buried_source_is_warned_of(self):
        for at, buried in (([6, 4, 6], True), ([5.3, 3.7, 4.1], True), ([6, 2, 6], True), ([6, 1, 6], True),
                           ([6, 6, 6], False), ([4, 4, 6], False), ([4, 2, 4], False), ([6, -1, 6], False),
                           ([6, -0.3, 6], False), ([14, 12, 14], False)):
            result = voxmelt("digest", self.scene, "--set", f"heat_source.0.at={at}", cwd=self.folder)
            self.assertEqual("warning: heat_source.0 stands inside matter at first: there it lights nothing\n"
                             in result.stderr, buried, at)

    # Without heat the box stays solid.
    def test_a_run_in_which_nothing_can_happen_says_so(self):
        still = SMALL.replace('[[heat_source]]\nkind = "point"\nat = [14, 12, 14]\npower = 30\n', "")
        scene = write(self.folder, still.replace("[heat]\ngamma = 0.15\nvisibility_every = 8\n", ""), "still.toml")
        for steps in (1, 6):
            result = voxmelt("run", scene, "--steps", steps, cwd=self.folder)
            self.assertEqual(result.returncode, 0)
            self.assertIn(f"warning: nothing has changed in {steps} step{'s' * (steps > 1)}: no liquid can move, and no "
                          "heat comes to a solid\n", result.stderr)
        result = voxmelt("run", self.scene, cwd=self.folder)
        self.assertNotIn("nothing has changed", result.stderr)

    # A vent brings more than flows away. Its column fills to the top of the grid, and then each cell of it. Under
    # a lid the same is a conduit under pressure.
    def test_a_needle_over_a_vent_is_warned_of(self):
        vent = """[grid]
size = [9, 16, 9]
[[vent]]
at = [4.5, 1.5, 4.5]
radius = 2
rate = 1
[flow]
law = "viscous"
[flow.viscous]
kappa = 20
"""
        lid = "[[inert]]\nshape = \"box\"\nsize = [9, 1, 9]\nat = [4.5, 15.5, 4.5]\n"
        for more, expected in (("", 1), (lid.replace("inert", "solid"), 0), (lid, 0)):
            scene = write(self.folder, vent + more, "vent.toml")
            said = [line for line in self.warnings(scene, "--steps", 120)[0] if "flows more slowly" not in line]
            self.assertEqual(len(said), expected, said)
        pressed = [line for line in self.warnings(write(self.folder, vent, "vent.toml"), "--steps", 120)[0]
                   if "flows more slowly" not in line]
        for line in pressed:
            self.assertRegex(line, r"^liquid presses against the top of the grid: cell \(\d, \d+, \d\) held \d+\.\d+ ")
        self.assertEqual(self.warnings(scene, "--set", "vent.0.rate=0.01", "--steps", 20)[0], [])

    # Power 4000 at 10 cells is 40 ranges per step, 640 times what a cell takes up. The number of cuts is that of the
    # lit cells and the steps of visibility, whoever computes it.
    def test_irradiance_that_is_cut_is_counted_and_warned_of(self):
        counts = set()
        for more in (["--implementation", "reference"], ["--threads", 2], ["--threads", 1]):
            said, report = self.warnings(self.scene, "--steps", 1, "--set", "heat_source.0.power=4000", *more)
            counts.add(report["irradiance_capped"])
            self.assertEqual(len(said), 1, said)
            self.assertTrue(said[0].startswith(f"irradiance was cut {report['irradiance_capped']} times"), said)
        self.assertEqual(len(counts), 1)
        self.assertGreater(counts.pop(), 10)
        said, report = self.warnings(self.scene, "--steps", 1, "--set", "heat_source.0.power=1")
        self.assertEqual((said, report["irradiance_capped"]), ([], 0))

    def test_an_interrupted_run_keeps_what_it_made(self):
        process = subprocess.Popen([PROGRAM, "run", self.scene, "--steps", "4000000", "--quiet", "--frame-every", "0"],
                                   cwd=self.folder)
        for _ in range(100):
            time.sleep(0.1)
            if list(self.folder.glob("out/*/frames/*.png")):
                break
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 4)
        report = json.loads((self.folder / "out/scene/report.json").read_text())
        self.assertIs(report["complete"], False)
        self.assertLess(report["steps"], 4000000)
        self.assertEqual(report["mass"]["drift"], 0)

    def test_a_killed_run_leaves_no_finished_looking_folder(self):
        process = subprocess.Popen([PROGRAM, "run", self.scene, "--steps", "4000000", "--quiet"], cwd=self.folder)
        time.sleep(0.5)
        process.send_signal(signal.SIGKILL)
        process.wait(60)
        self.assertFalse((self.folder / "out/scene").exists())
        self.good("run", self.scene, "--steps", "1")
        self.assertEqual([p.name for p in (self.folder / "out").iterdir()], ["scene"], "leavings are removed")
        self.assertIs(json.loads((self.folder / "out/scene/report.json").read_text())["complete"], True)

    def test_verify_finds_no_difference_and_accounts_for_every_cycle(self):
        out = self.good("verify", self.scene, "--from", 4, "--steps", 5, "--report", "v.json",
                        "--set", "hw.lanes=4", "--set", "hw.cascade=2", "--set", "hw.stall_seed=7")
        self.assertIn("no difference", out)
        report = json.loads((self.folder / "v.json").read_text())
        self.assertEqual(report["mismatches"], 0)
        self.assertIsNone(report["first_mismatch"])
        stages = [s for s in report["stages"] if s["phase"] and s["cascade"] == 0]
        self.assertGreaterEqual(len(stages), 5)
        self.assertEqual(report["compared_cells"], 12 * 10 * 12 * 5 * len(stages))
        for stage in report["stages"]:
            self.assertEqual(sum(stage["cycles"].values()), report["cycles"], stage["name"])
        self.assertGreater(report["cycles"], report["predicted_cycles"], "nothing stalled")
        self.good("verify", self.scene, "--from", 4, "--steps", 5, "--hw", "mid", "--report", "s.json")
        smooth = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(smooth["cycles"], smooth["predicted_cycles"])
        digest = self.good("digest", self.scene, "--steps", smooth["first_step"] + smooth["steps"])
        self.assertEqual(LINE.match(digest.strip()).group(2), smooth["digest"])

    def test_every_planted_fault_is_found_where_it_was_planted_and_replays(self):
        of_pipeline, _ = self.good("list", "faults").split("\n\n")
        names = [line.split()[0] for line in of_pipeline.splitlines()]
        of_materials = {line.split()[0] for line in of_pipeline.splitlines() if "several materials" in line}
        self.assertGreaterEqual(len(names), 45)
        self.assertGreaterEqual(len(of_materials), 8)
        # The unit tests plant each in many worlds; a few show that the command does as they do.
        for name in names[::EVERY_FAULT]:
            found = 0
            grounds = [ROOT / f"tests/hwmodel/mutants/scenes/{ground}.toml" for ground in ("materials", "materials_viscous")]
            for scene in grounds if name in of_materials else ("proving_ground", "proving_ground_viscous"):
                command = ["verify", scene, "--steps", 8, "--hw", "stalls", "--plant", name]
                if name.startswith("tile-"):  # in a grid that is cut
                    for key in ("lanes=1", "cascade=1", "tile=16"):
                        command += ["--set", "hw." + key]
                if name.startswith(("fall-", "feed-falls-")):
                    command += ["--set", "pieces.fall=true"]
                if name.startswith("code-"):
                    command += ["--set", "hw.coded=1"]
                result = voxmelt(*command, "--report", "p.json", cwd=self.folder)
                if result.returncode == 2:
                    self.assertIn("nothing that this fault could change", result.stderr)
                    continue
                self.assertEqual(result.returncode, 1, name + result.stderr)
                self.assertIn("found there", result.stdout, name)
                report = json.loads((self.folder / "p.json").read_text())
                self.assertTrue(report["planted"]["found_there"])
                again = [line.strip() for line in result.stdout.splitlines() if line.startswith("  voxmelt verify")]
                self.assertEqual(len(again), 1, result.stdout)
                repeated = voxmelt(*shlex.split(again[0])[1:], "--report", "again.json", cwd=self.folder)
                self.assertEqual(repeated.returncode, 1, repeated.stderr)
                replay = json.loads((self.folder / "again.json").read_text())
                # A replay begins with one state: the copy that a stale halo comes from is another one.
                for key in ("where", "step", "cell", "field", "expected", "actual") if name != "tile-halo-stale" else ("where", "step"):
                    self.assertEqual(report["first_mismatch"][key], replay["first_mismatch"][key], name)
                found += 1
            self.assertGreater(found, 0, name + " strikes nowhere")

    def test_a_replay_survives_odd_names_and_can_be_replayed(self):
        odd = self.folder / "it's a \"scene\" $x;"
        odd.mkdir()
        scene = write(odd, SMALL)
        command = ["verify", scene, "--steps", 6, "--plant", "gravity-one-more", "--set", "title=\"a 'b'\"",
                   "--set", "look.liquid=[0.2, 0.3, 0.4]", "--from", 8, "--seed", 3]
        result = voxmelt(*command, cwd=self.folder)
        for _ in range(3):  # a replay of a replay is the same
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("found there", result.stdout)
            typed = [line.strip() for line in result.stdout.splitlines() if line.startswith("  voxmelt verify")]
            self.assertEqual(len(typed), 1, result.stdout)
            result = subprocess.run(["bash", "-c", typed[0].replace("voxmelt", f"'{PROGRAM}'", 1)], cwd=self.folder,
                                    capture_output=True, text=True)

    def test_a_difference_is_not_hidden_by_what_cannot_be_written(self):
        full = voxmelt("verify", self.scene, "--steps", 6, "--plant", "gravity-one-more", "--report", "/dev/full",
                       cwd=self.folder)
        self.assertEqual(full.returncode, 1, full.stderr)
        self.assertIn("first mismatch", full.stdout)
        self.assertIn("found there", full.stdout)
        (self.folder / "foreign").mkdir()
        write(self.folder / "foreign", "mine", "x")
        self.assertEqual(voxmelt("verify", self.scene, "--out", "foreign", cwd=self.folder).returncode, 2)
        self.assertEqual(voxmelt("verify", self.scene, "--out", ".", cwd=self.folder).returncode, 2)

    def test_the_machine_is_the_one_asked_for(self):
        asked = {"lanes": 8, "cascade": 3, "substeps": 2, "fifo_depth": 5, "stall_seed": 77}
        sets = [a for key, value in asked.items() for a in ("--set", f"hw.{key}={value}")]
        write(self.folder, "title = \"mine\"\n[hw]\n" + "".join(f"{k} = {v}\n" for k, v in asked.items()), "mine.toml")
        for machine in (sets, ["--hw", "mine.toml"]):
            self.good("verify", self.scene, "--steps", 6, "--report", "m.json", *machine)
            report = json.loads((self.folder / "m.json").read_text())
            self.assertEqual(report["hw"], {**asked, "overlap": 1, "tile": 0, "coded": 0, "registers": 0, "memory": None, "clock_mhz": None})
            self.assertEqual(report["passes"], 2)
            self.assertEqual({c["depth"] for c in report["channels"]}, {5})
            self.assertEqual({len(c["occupancy"]) for c in report["channels"]}, {6})
            for channel in report["channels"]:
                self.assertEqual(sum(channel["occupancy"]), report["cycles"], channel["name"])
            self.assertEqual(report["buffer_bits"], sum(b["total_bits"] for s in report["stages"] for b in s["buffers"]))
            self.assertEqual(report["channel_bits"], sum(8 * 5 * c["bits"] for c in report["channels"]))
        for wrong in ("[hw]\nlane = 4\n", "[hw]\nlanes = 4\n[wh]\n"):
            write(self.folder, wrong, "wrong.toml")
            self.assertEqual(voxmelt("verify", self.scene, "--hw", "wrong.toml", cwd=self.folder).returncode, 2, wrong)

    def test_every_fault_planted_in_the_ray_caster_is_found_where_it_was_planted(self):
        _, of_caster = self.good("list", "faults").split("\n\n")
        rows = of_caster.splitlines()[1:]
        self.assertGreaterEqual(len(rows), 75)
        never = set()
        # As above: a few, and those that strike in no scene.
        nowhere = {"cache-tag-bits", "crossing-stale", "ground-face", "passed-obstacle", "walk-box", "walk-first-sample"}
        for row in [row for i, row in enumerate(rows) if i % EVERY_FAULT == 0 or row.split()[0] in nowhere]:
            name = row.split()[0]
            found = 0
            grounds = [["proving_ground"], ["lava", "--from", 40], ["ice", "--from", 40]]
            for scene, *more in [["chocolate_nuts"]] if name == "material-tone" else grounds:
                result = voxmelt("verify", scene, *more, "--picture", "--size", "32x32", "--plant", name,
                                 "--set", "hw.pipes=2", "--set", "hw.stall_seed=1", "--report", "p.json", cwd=self.folder)
                if result.returncode == 2:
                    self.assertIn("nothing that this fault could change", result.stderr)
                    continue
                self.assertEqual(result.returncode, 1, name + result.stderr)
                self.assertIn("found there", result.stdout, name)
                planted = json.loads((self.folder / "p.json").read_text())["planted"]
                self.assertTrue(planted["found_there"], name)
                self.assertIn(f" {planted['stage']} ", row)
                found += 1
                break
            if found == 0:
                never.add(name)
        # Pictures that are made for these: tests/hwmodel/caster/faults/caster_faults_test.cpp.
        self.assertEqual(never, nowhere)

    def test_verify_does_what_its_options_say(self):
        base = self.good("verify", self.scene, "--steps", 6, "--report", "all.json", "--implementation", "reference")
        self.assertIn("(the reference itself): no difference", base)
        self.good("verify", self.scene, "--steps", 6, "--report", "some.json", "--every", 4)
        every, some = (json.loads((self.folder / f"{name}.json").read_text()) for name in ("all", "some"))
        self.assertEqual(some["compared_cells"] * 3, every["compared_cells"], "steps 4 and 6")
        self.good("verify", self.scene, "--steps", 1, "--from", 19, "--report", "from.json")
        self.assertEqual(json.loads((self.folder / "from.json").read_text())["first_step"], 16, "a step of visibility")

    def test_a_fault_strikes_from_its_step_on_and_the_command_repeats_everything(self):
        folder = self.folder / 'a "quoted" \\ folder'
        folder.mkdir()
        scene = write(folder, SMALL)
        typed = ["--hw", "tiny", "--set", "hw.lanes=2", "--set", "heat.gamma=0.2", "--seed", 5]
        for step, at in ((2, ["--plant-step", 2]), (10, ["--plant-step", 10]), (8, [])):
            result = voxmelt("verify", scene, "--steps", 16, "--plant", "conduction-sign", "--report", "p.json", *at,
                             *typed, cwd=self.folder)
            self.assertEqual(result.returncode, 1, result.stderr)
            report = json.loads((self.folder / "p.json").read_text())
            self.assertEqual(report["planted"]["step"], step)
            self.assertEqual(report["mismatches"], 1)
            line, = [line for line in result.stdout.splitlines() if line.startswith("  voxmelt verify")]
            for part in ("--hw tiny", "--set hw.lanes=2", "--set heat.gamma=0.2", "--seed 5", f"--plant-step {step}",
                         f"--steps {step % 8 + 1} "):
                self.assertIn(part, line + " ")
            repeated = voxmelt(*shlex.split(line)[1:], "--report", "again.json", cwd=self.folder)
            self.assertEqual(repeated.returncode, 1, repeated.stderr)
            again = json.loads((self.folder / "again.json").read_text())
            for key in ("where", "step", "cell", "lane", "field", "expected", "actual", "neighbourhood"):
                self.assertEqual(report["first_mismatch"][key], again["first_mismatch"][key], key)
            self.assertEqual(again["first_step"], step - step % 8)

    def test_presets_verify(self):
        names = [line.split()[0] for line in self.good("list", "presets").splitlines()]
        self.assertEqual(names, ["mid", "stalls", "tiny", "wide"])
        machines = []
        for name in names:
            self.assertIn("no difference", self.good("verify", self.scene, "--steps", 3, "--hw", name, "--quiet"))
            self.assertIn("no difference", self.good("verify", self.scene, "--from", 24, "--picture", "--size", "24x16", "--hw",
                                                     name, "--quiet", "--report", "p.json"))
            machines.append(json.loads((self.folder / "p.json").read_text())["configuration"])
        self.assertEqual([m["pipes"] for m in machines], [2, 2, 1, 4])
        self.assertEqual([m["stall_seed"] for m in machines], [0, 1, 0, 0])
        self.assertEqual(len({json.dumps(m) for m in machines}), 4, "each of them is another ray caster")

    def test_a_key_of_what_does_not_run_is_unknown(self):
        for key, value, right, wrong in (("lanes", 2, [], ["--picture"]), ("pipes", 2, ["--picture"], []),
                                         ("rays", 32, ["--picture"], [])):
            arguments = ["verify", self.scene, "--steps", 1, "--size", "16x16", "--quiet", "--set", f"hw.{key}={value}"]
            self.good(*arguments, *right)
            result = voxmelt(*arguments, *wrong, cwd=self.folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn(f"--set hw.{key}={value}: error: unknown key hw.{key}", result.stderr)
            self.good(*arguments, "--machine")

    def test_uploads_are_reported(self):
        text = self.good("verify", self.scene, "--from", 24, "--picture", "--size", "16x16", "--frames", 3, "--report", "p.json")
        report = json.loads((self.folder / "p.json").read_text())
        whole, *later = report["uploads"]
        self.assertTrue(whole["whole"])
        self.assertEqual(whole["bytes"], 64 * whole["bursts"])
        self.assertEqual(whole["bytes"], sum(whole["volumes"].values()))
        self.assertEqual(whole["cycles"], whole["words"] + whole["bursts"] + 1, "docs/hardware/ray-caster.md, p = 1")
        self.assertEqual(sum(whole["stage"].values()), whole["cycles"])
        self.assertEqual([u["bytes"] for u in later], [0, 0], "the same picture")
        self.assertIn(f"upload of everything: {whole['bytes']} bytes in {whole['bursts']} bursts", text)

    def test_the_whole_machine_is_verified(self):
        text = self.good("verify", self.scene, "--machine", "--from", 16, "--steps", 6, "--frames", 3, "--size", "24x16", "--hw",
                         "mid", "--set", "hw.clock_mhz=250", "--report", "m.json", "--png", "m.png")
        report = json.loads((self.folder / "m.json").read_text())
        self.assertTrue(report["good"])
        self.assertEqual((report["clock_mhz"], report["steps"], report["frames"]), (250, 6, 3))
        self.assertEqual([p["step"] for p in report["periods"]], [18, 20, 22])
        digests = self.good("digest", self.scene, "--steps", 22).splitlines()
        self.assertEqual(LINE.match(digests[-1]).group(2), report["digest"])
        self.good("render", self.scene, "--steps", 22, "--size", "24x16", "--setting", "normal", "--out", "r.png")
        self.assertEqual((self.folder / "m.png").read_bytes(), (self.folder / "r.png").read_bytes())
        in_turn = overlapped = 0
        for period in report["periods"]:
            steps, upload, frame = period["steps"], period["upload"], period["frame"]
            self.assertEqual(period["cycles_in_turn"], steps["cycles_on_memory"] + upload["cycles"] + frame["cycles"])
            self.assertEqual(period["cycles_overlapped"], period["together"]["cycles"] + upload["cycles"])
            self.assertEqual(period["together"]["cycles"], max(period["together"]["steps"], period["together"]["frame"]))
            self.assertGreaterEqual(steps["cycles_on_memory"], steps["cycles"])
            self.assertEqual(frame["written_bytes"], 2 * 6 * 192)
            self.assertEqual(upload["bytes"], sum(upload["volumes"].values()))
            in_turn += period["cycles_in_turn"]
            overlapped += period["cycles_overlapped"]
        self.assertAlmostEqual(report["a_second"]["in_turn"]["frames"], 3 * 250e6 / in_turn)
        self.assertAlmostEqual(report["a_second"]["overlapped"]["steps"], 6 * 250e6 / overlapped)
        self.assertIn(f"bound by {report['bounds'][0]['name']}", text)
        self.assertGreater(report["software"]["pictures_a_second"], 0)
        self.assertNotIn("software", self.good("verify", self.scene, "--machine", "--steps", 1, "--size", "16x16", "--quiet"))

    def test_the_one_verdict_of_a_quiet_machine_is_that_of_what_differs(self):
        for fault, verdict in (("met-depth", "DIFFERENCE behind stage met"), ("melt-stuck", "first mismatch (stage): melt")):
            result = voxmelt("verify", self.scene, "--machine", "--steps", 6, "--frames", 2, "--size", "16x16", "--plant", fault,
                             "--out", "replay", "--quiet", cwd=self.folder)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(verdict, result.stdout)
            self.assertNotIn("no difference", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=["commands_test", *(["-k", "test_every*fault*"] if EVERY_FAULT == 1 else [])], verbosity=1)
