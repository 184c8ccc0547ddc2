#!/usr/bin/env python3
"""The world outside of `voxmelt run` and the like: mounts, tools that hang, signals of batch systems, programs that were
copied, memories of hardware that are slow or small.

  outside_test.py PROGRAM
"""
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from program import PROGRAM, SMALL, voxmelt, write

ROOT = Path(__file__).resolve().parents[2]
RUN = ["run", "scene.toml", "--steps", "12", "--frame-every", "3", "--size", "64x48", "--quiet"]
LONG = ["run", "scene.toml", "--steps", "4000000", "--frame-every", "0", "--size", "64x48", "--out", "long", "--quiet"]


def can_mount():
    try:
        return subprocess.run(["unshare", "--map-root-user", "--mount", "sh", "-c", "mount -t tmpfs tmpfs /mnt"], capture_output=True).returncode == 0
    except FileNotFoundError:
        return False


class Outside(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        write(self.folder, SMALL)

    def good(self, *arguments, **options):
        result = voxmelt(*arguments, cwd=self.folder, **options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    # --report is written when the output stands.
    def test_a_report_that_cannot_be_written_takes_nothing_away(self):
        result = voxmelt(*RUN, "--out", "o", "--report", "/dev/full", cwd=self.folder)
        self.assertEqual(result.returncode, 3)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIs(json.loads((self.folder / "o/report.json").read_text())["complete"], True)
        self.assertEqual(len(list((self.folder / "o/frames").iterdir())), 5)

    @unittest.skipUnless(can_mount(), "nothing can be mounted here")
    def test_a_mount_point_is_a_place_for_outputs(self):
        """In a name space of their own: a tmpfs, and a folder bound to itself."""
        self.good(*RUN, "--out", "wanted")
        wanted = {p.name: p.read_bytes() for p in (self.folder / "wanted/frames").iterdir()}
        for kind, mount in (("tmpfs", "mount -t tmpfs tmpfs v"), ("bind", "mount --bind v v")):
            shutil.rmtree(self.folder / "v", ignore_errors=True)
            (self.folder / "v").mkdir()
            script = f"""set -e
{mount}
run() {{ "{PROGRAM}" {' '.join(RUN)} --out v "$@"; }}
run --seed 2; run; ls -A v > listed; cp -r v copied
"{PROGRAM}" export scene.toml --out v --quiet || test $? = 2
rm -rf v/* v/.vox*
"{PROGRAM}" export scene.toml --out v --quiet; test -f v/solid.npy
"{PROGRAM}" render scene.toml --turntable 3 --size 32x32 --out v --quiet; test -f v/view_002.png; test ! -e v/solid.npy
"{PROGRAM}" {' '.join(LONG[:-3])} --out v --quiet & long=$!
until ls -d v/.voxmelt.partial-*/frames/frame_00000.png 2> /dev/null; do sleep 0.05; done
kill -TERM $long; wait $long && false || test $? = 4
test -f v/frames/frame_00000.png; ls v/checkpoints > checkpoints
"""
            with self.subTest(kind):
                result = subprocess.run(["unshare", "--map-root-user", "--mount", "sh", "-c", script], cwd=self.folder, capture_output=True, text=True, timeout=100)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                self.assertEqual({p.name: p.read_bytes() for p in (self.folder / "copied/frames").iterdir()}, wanted)
                self.assertNotIn("partial", (self.folder / "listed").read_text())
                self.assertIn(".vxc", (self.folder / "checkpoints").read_text())
                for name in ("copied", "listed", "checkpoints"):
                    shutil.rmtree(self.folder / name) if name == "copied" else (self.folder / name).unlink()

    def begin(self, *more, env=None):
        """A long run, once its first frame is whole."""
        process = subprocess.Popen([PROGRAM, *LONG, *more], cwd=self.folder, env=env, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while not list(self.folder.glob("long.partial-*/frames/frame_00000.png")):
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        return process

    # An ffmpeg that never reads, and one that reads and never ends.
    def test_an_ffmpeg_that_hangs_cannot_keep_a_run_from_ending(self):
        for script in ("exec sleep 600", 'cat > "$film"; exec sleep 600'):
            programs = self.folder / "programs"
            programs.mkdir(exist_ok=True)
            write(programs, f'#!/bin/sh\nPATH=/usr/bin:/bin\nfor film; do :; done\ncase "$*" in */dev/zero*) exit 0;; esac\n{script}\n',
                  "ffmpeg").chmod(0o755)
            for number in (signal.SIGINT, signal.SIGTERM):
                for threads in (1, 2):
                    with self.subTest(script, signal=number, threads=threads):
                        process = self.begin("--threads", str(threads), env={**os.environ, "PATH": str(programs)})
                        begin = time.monotonic()
                        process.send_signal(number)
                        _, said = process.communicate(timeout=30)
                        self.assertEqual(process.returncode, 4, said)
                        self.assertLess(time.monotonic() - begin, 10)
                        self.assertTrue((self.folder / "long/frames/frame_00000.png").exists())
                        shutil.rmtree(self.folder / "long")

    def test_children_die_with_us(self):
        programs = self.folder / "programs"
        programs.mkdir()
        write(programs, f'#!/bin/sh\nPATH=/usr/bin:/bin\ncase "$*" in */dev/zero*) exit 0;; esac\necho $$ > "{self.folder}/child"\nexec sleep 600\n',
              "ffmpeg").chmod(0o755)
        process = self.begin("--threads", "2", env={**os.environ, "PATH": str(programs)})
        until = time.monotonic() + 20
        while not (self.folder / "child").exists() or not (self.folder / "child").read_text().strip():
            self.assertLess(time.monotonic(), until)
        child = int((self.folder / "child").read_text())
        process.kill()
        process.communicate()
        for _ in range(500):
            if not Path(f"/proc/{child}").exists() or Path(f"/proc/{child}/stat").read_text().split(")")[1].split()[0] == "Z":
                return
            time.sleep(0.01)
        os.kill(child, signal.SIGKILL)
        self.fail("it lives on")

    def test_signals_of_batch_systems_leave_a_checkpoint(self):
        for number in (signal.SIGUSR1, signal.SIGXCPU):
            with self.subTest(number):
                process = self.begin()
                process.send_signal(number)
                _, said = process.communicate(timeout=30)
                self.assertEqual(process.returncode, 4)
                self.assertIn("`voxmelt run --resume long` goes on", said)
                self.assertEqual(len(list((self.folder / "long/checkpoints").iterdir())), 1)
                shutil.rmtree(self.folder / "long")

    def test_a_limit_of_processor_time(self):
        result = subprocess.run([PROGRAM, *LONG], cwd=self.folder, capture_output=True, text=True, timeout=60,
                                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 20)))
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertTrue(list((self.folder / "long/checkpoints").iterdir()))

    def test_the_time_on_the_wall(self):
        begin = time.monotonic()
        result = voxmelt(*LONG, "--wall-clock", "1s", cwd=self.folder)
        self.assertEqual(result.returncode, 4)
        self.assertGreater(time.monotonic() - begin, 0.9)
        self.assertRegex(result.stderr, r"^the time of --wall-clock is over after step \d+ of 4000000; what was made is kept; "
                                        r"`voxmelt run --resume long` goes on\n$")
        shutil.rmtree(self.folder / "long")
        for fine in ("3h55m", "1h2m3s", "45m", "2h1s"):
            self.good(*RUN, "--out", "o", "--wall-clock", fine)
        for wrong in ("", "5", "h", "0s", "5m3h", "3h3h", "-1s", "1.5h", "5d", "99999999999s"):
            result = voxmelt(*RUN, "--out", "o", "--wall-clock", wrong, cwd=self.folder)
            self.assertEqual(result.returncode, 2, wrong)
            self.assertIn("--wall-clock", result.stderr)

    def test_info_finds_what_a_killed_run_has_left(self):
        process = self.begin("--checkpoint-every", "5")
        while not [p for p in self.folder.glob("long.partial-*/checkpoints/step_*.vxc") if not p.name.endswith("0000.vxc")]:
            time.sleep(0.01)
        process.kill()
        process.communicate()
        self.assertRegex(self.good("info", "long"), r"checkpoint +.*long\.partial-\w{6}/checkpoints/step_\d+\.vxc\n")
        result = voxmelt("info", "nothing", cwd=self.folder)
        self.assertEqual((result.returncode, result.stderr), (2, "nothing: error: there is no such file\n"))

    def in_shell(self, script, timeout=60):
        return subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True, text=True, timeout=timeout, stdin=subprocess.DEVNULL)

    def test_other_programs_around_it(self):
        run = f"'{PROGRAM}' {' '.join(RUN)} --out o"
        for around in (f"nohup {run}", f"timeout 60 {run}", f'script -qec "{run}" /dev/null', f"nice -n 19 {run}", f"setsid -w {run}",
                       f"{run} | cat", f"cat /dev/null | {run}", f"({run}) 2>&1 | (sleep 1; cat)"):
            with self.subTest(around):
                result = self.in_shell(f"set -o pipefail; {around}")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(json.loads((self.folder / "o/report.json").read_text())["complete"])
                shutil.rmtree(self.folder / "o")

    # Little of something ends in one line and an exit code, never by a signal. What is whole stays.
    def test_limits(self):
        run = f"exec '{PROGRAM}' {' '.join(RUN)} --out o"
        result = self.in_shell(f"ulimit -f 2; {run.replace('64x48', '640x480')}")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("File too large", result.stderr)
        codes = set()
        for kibibytes in (60000, 100000, 200000, 400000, 800000):
            result = self.in_shell(f"ulimit -v {kibibytes}; {run}")
            self.assertIn(result.returncode, (0, 3, 127), (kibibytes, result.stderr))  # 127: it could not be loaded
            codes.add(result.returncode)
            self.assertLessEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for files in range(4, 40, 3):
            shutil.rmtree(self.folder / "o", ignore_errors=True)
            result = self.in_shell(f"ulimit -n {files}; {run}")
            self.assertIn(result.returncode, (0, 2, 3, 127), (files, result.stderr))
            self.assertTrue(result.returncode == 0 or result.stderr, files)
        if os.geteuid() == 0 and shutil.which("setpriv"):
            os.chmod(self.folder, 0o777)
            # The checks of the number of processes do not hold for the super-user.
            result = self.in_shell(f"ulimit -u 1; exec setpriv --reuid 65534 --clear-groups {run.removeprefix('exec ')} --threads 8")
            self.assertIn(result.returncode, (0, 3), result.stderr)

    @unittest.skipUnless(can_mount() and shutil.which("chroot"), "nothing can be mounted here")
    def test_a_bare_root(self):
        """Neither /proc nor /tmp nor a home; then everything but the output's place is read-only; then another user."""
        root = self.folder / "root"
        for line in subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout.splitlines():
            if library := re.search(r"(/\S+) \(0x", line):
                place = root / library[1].lstrip("/")
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(os.path.realpath(library[1]), place)
        (root / "place").mkdir()
        shutil.copy(PROGRAM, root / "voxmelt")
        shutil.copy(self.folder / "scene.toml", root / "place")
        command = f"/voxmelt {' '.join(RUN).replace('scene.toml', '/place/scene.toml')}"
        for how in (f"chroot root {command} --out /place/a",
                    f"mount --bind root root; mount --bind root/place root/place; mount -o remount,bind,ro root; chroot root {command} --out /place/b"):
            with self.subTest(how):
                result = subprocess.run(["unshare", "--map-root-user", "--mount", "bash", "-ec", how], cwd=self.folder, env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin"},
                                        capture_output=True, text=True)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
        frames = {p.name: p.read_bytes() for p in (root / "place/a/frames").iterdir()}
        self.assertEqual({p.name: p.read_bytes() for p in (root / "place/b/frames").iterdir()}, frames)
        if os.geteuid() == 0 and shutil.which("setpriv"):
            others = f"'{PROGRAM}' {' '.join(RUN)}"
            (self.folder / "mine").mkdir(mode=0o755)
            result = self.in_shell(f"chmod 755 . && setpriv --reuid 65534 --clear-groups {others} --out mine/o")
            self.assertEqual(result.returncode, 2)
            self.assertIn("Permission denied", result.stderr)
            os.chown(self.folder / "mine", 65534, 65534)
            result = self.in_shell(f"setpriv --reuid 65534 --clear-groups {others} --out mine; setpriv --reuid 65534 --clear-groups {others} --out mine")
            self.assertEqual((result.returncode, result.stderr), (0, ""), "a folder of theirs, in one that is not")
            self.assertEqual({p.name: p.read_bytes() for p in (self.folder / "mine/frames").iterdir()}, frames)

    def test_a_program_that_was_copied_says_what_it_lacks(self):
        (self.folder / "bin").mkdir()
        alone = shutil.copy(PROGRAM, self.folder / "bin/voxmelt")
        env = {key: value for key, value in os.environ.items() if key != "VOXMELT_SCENES"}
        for arguments in (["list", "scenes"], ["run", "cello"]):
            result = subprocess.run([alone, *arguments], cwd=self.folder, env=env, capture_output=True, text=True)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn("no scenes are in any of scenes, ", result.stderr)
            self.assertIn("VOXMELT_SCENES", result.stderr)
        result = subprocess.run([alone, "list", "scenes"], cwd=self.folder, env={**env, "VOXMELT_SCENES": str(ROOT / "scenes")}, capture_output=True, text=True)
        self.assertIn("\ncello ", result.stdout)

    def sheet(self, name, **changes):
        """ddr4-2400 with other numbers; None: without the key."""
        text = (ROOT / "hwmodel/memory/sheets/ddr4-2400.toml").read_text()
        for key, value in changes.items():
            text, found = re.subn(rf"^{key} = .*\n", "" if value is None else f"{key} = {value}\n", text, flags=re.M)
            self.assertEqual(found, 1)
        return write(self.folder, text, f"{name}.toml").name

    def cycles(self, *sets):
        result = voxmelt("verify", "scene.toml", "--steps", 2, "--quiet", *(a for s in sets for a in ("--set", s)), cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("no difference", result.stdout)
        return int(re.search(r": (\d+) cycles", result.stdout)[1])

    # At twice the clock the same memory takes twice the cycles, where it is what the machine waits for.
    def test_a_machine_that_waits_for_its_memory_does_not_hang(self):
        slow = self.sheet("slow", mhz=100)
        before = self.cycles(f"hw.memory={slow}", "hw.clock_mhz=2500")
        for clock in (5000, 10000):
            now = self.cycles(f"hw.memory={slow}", f"hw.clock_mhz={clock}")
            self.assertAlmostEqual(now / before, 2, delta=0.02)
            before = now
        late = self.sheet("late", interface_cycles=10000)
        self.assertGreater(self.cycles(f"hw.memory={late}", "hw.clock_mhz=6000"), 50000)
        result = voxmelt("verify", "scene.toml", "--picture", "--size", "16x16", "--set", f"hw.memory={late}", "--set", "hw.clock_mhz=6000", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_a_memory_that_is_too_small_is_refused(self):
        small = self.sheet("small", groups=1, banks=1, rows=16, columns=64)
        for kind, what in (([], "the pipeline's state and irradiance"), (["--picture", "--size", "64x64"], "the picture's volumes and the picture"),
                           (["--machine", "--size", "64x64"], "the picture's volumes and the picture")):
            result = voxmelt("verify", "scene.toml", *kind, "--steps", 2, "--set", f"hw.memory={small}", cwd=self.folder)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertRegex(result.stderr, rf"^hw.memory: error: small.toml has 8192 bytes; {what} take \d+\n$")

        result = voxmelt("explore", "scene.toml", "--device", "zu7ev", "--memory", small, "--points", 0, cwd=self.folder)
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertRegex(result.stderr, r"^error: --memory small.toml: has 8192 bytes; the pipeline's state and irradiance take up to \d+\n$")

    def test_a_key_that_is_missing_is_named(self):
        for key in ("rfc", "cl", "rp", "banks"):
            without = self.sheet("without", **{key: None})
            result = voxmelt("verify", "scene.toml", "--steps", 2, "--set", f"hw.memory={without}", cwd=self.folder)
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, rf"^without.toml:\d+:\d+: error: memory.{key} is missing\n$")


if __name__ == "__main__":
    unittest.main(argv=["outside_test"], verbosity=1)
