#!/usr/bin/env python3
"""What run.sh gives to `voxmelt run`. Nothing is installed or built: programs that do nothing stand in for it."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()

GIVEN = {
    "": "run cello",
    "goblet": "run goblet",
    "my_model.stl": "run my_model.stl",
    "goblet --steps 500": "run goblet --steps 500",
    "--steps 120": "run cello --steps 120",
    "--steps=120": "run cello --steps=120",
    "--steps 120 goblet": "run --steps 120 goblet",
    "--steps=120 goblet": "run --steps=120 goblet",
    "--quiet": "run cello --quiet",
    "--quiet goblet": "run --quiet goblet",
    "--steps 120 --quiet --size 64x64": "run cello --steps 120 --quiet --size 64x64",
    "--set run.seed=3 --threads 2": "run cello --set run.seed=3 --threads 2",
    "--checkpoint-every 60s": "run cello --checkpoint-every 60s",
    "--resume out/cello": "run --resume out/cello",
    "--resume=out/cello --quiet": "run --resume=out/cello --quiet",
    "--help": "run --help",
    "-h": "run -h",
}


def script(folder, text):
    folder.parent.mkdir(parents=True, exist_ok=True)
    folder.write_text("#!/bin/sh\n" + text)
    folder.chmod(0o755)


class RunSh(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        shutil.copy(ROOT / "run.sh", self.folder)
        script(self.folder / "cmake/install-dependencies.sh", "")
        script(self.folder / "bin/cmake", "mkdir -p build")
        script(self.folder / "build/first/app/voxmelt", 'echo "$@"; exit 7')
        script(self.folder / "bin/ffmpeg", "")
        self.env = dict(os.environ, PATH=f"{self.folder}/bin:{os.environ['PATH']}")

    def tearDown(self):
        self.temporary.cleanup()

    def test_options_alone_take_the_cello(self):
        for given, expected in GIVEN.items():
            with self.subTest(given=given):
                result = subprocess.run([self.folder / "run.sh", *given.split()], cwd="/", env=self.env,
                                        capture_output=True, text=True)
                self.assertEqual((result.stdout, result.stderr), (expected + "\n", ""))
                self.assertEqual(result.returncode, 7, "the program's own exit code")

    def test_a_film_that_is_not_mp4_is_said(self):
        (self.folder / "bin/ffmpeg").unlink()
        for tool in ("bash", "dirname", "mkdir"):
            (self.folder / "bin" / tool).symlink_to(shutil.which(tool))
        result = subprocess.run([self.folder / "run.sh"], env=dict(os.environ, PATH=f"{self.folder}/bin"), capture_output=True, text=True)
        self.assertEqual((result.stdout, result.stderr), ("run cello\n", "Without ffmpeg the film is WebP, not MP4: apt-get install ffmpeg\n"))

    def test_what_fails_before_ends_it(self):
        script(self.folder / "bin/cmake", "echo no compiler; exit 1")
        result = subprocess.run([self.folder / "run.sh"], env=self.env, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stdout), (1, "no compiler\n"))

    def test_who_builds_for_the_first_time_is_told_how_long_it_takes(self):
        program = self.folder / "build/first/app/voxmelt"
        program.rename(self.folder / "later")
        script(self.folder / "bin/cmake", f"mkdir -p build/first/app; cp {self.folder}/later {program}")
        for expected in ("Building voxmelt takes some two minutes on two cores, once.\nThen look at out/cello/contact_sheet.png.\n", ""):
            result = subprocess.run([self.folder / "run.sh"], env=self.env, capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (7, "run cello\n", expected))


if __name__ == "__main__":
    unittest.main(argv=["run_sh_test"], verbosity=1)
