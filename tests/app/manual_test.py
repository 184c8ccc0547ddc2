#!/usr/bin/env python3
"""The page of the manual and the completion of bash have what --help has.

  manual_test.py PROGRAM FOLDER     FOLDER: where the build has made them
"""
import gzip
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM

FOLDER = Path(sys.argv[2]).resolve()
# Runs the completion as bash does, and prints a word a line.
COMPLETE = """\
source "$1"; shift
compopt() { :; }
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=()
_voxmelt
printf '%s\\n' "${COMPREPLY[@]}"
"""


def said(*arguments):
    result = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return result.stdout


def commands():
    return re.findall(r"^  ([a-z]+)  ", said("--help").partition("Subcommands:")[2], re.M)


def options(command):
    return re.findall(r"^  (?:-\w,)?(--[a-z-]+)", said(command, "--help"), re.M)


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = gzip.decompress((FOLDER / "voxmelt.1.gz").read_bytes()).decode()

    @unittest.skipUnless(shutil.which("groff"), "there is no groff: apt-get install groff brings it")
    def test_the_page_is_set_without_a_warning(self):
        for width in ("78", "160"):
            result = subprocess.run(["groff", "-man", "-Kutf8", "-Tutf8", "-ww", f"-rLL={width}n", "-P-cbou"], input=self.source,
                                    capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
        words = " ".join(result.stdout.split())
        for command in commands():
            self.assertIn(f"voxmelt {command} ", words)
        self.assertIn("cello_viscous --steps 800", words)

    def test_the_page_has_every_option_and_its_text(self):
        sections = dict(re.findall(r"^\.SS voxmelt (\w+)(.*?)(?=^\.S[SH])", self.source, re.M | re.S))
        self.assertEqual(list(sections), commands())
        count = 0
        for command, text in sections.items():
            plain = re.sub(r"\\f.|\\&", "", text).replace("\\-", "-")
            shown = re.findall(r"^\.TP\n(--[a-z-]+)", plain, re.M)
            self.assertEqual(["--help", *shown], options(command), command)
            count += len(shown)
        self.assertGreater(count, 120)
        self.assertIn("steps between frames; 0: the first only\n", self.source)
        self.assertIn("frames of the film in a second (default: 12) (from 1 to 240)\n", self.source)
        self.assertRegex(self.source, r"one of fast, normal, best; by default normal\)\n")
        self.assertIn("a name of \\fBvoxmelt list scenes\\fP", self.source)


@unittest.skipUnless(shutil.which("bash"), "there is no bash")
class Completion(unittest.TestCase):
    def completed(self, *words):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("mine.toml", "model.stl"):
                (Path(folder) / name).touch()
            result = subprocess.run(["bash", "-c", COMPLETE, "bash", FOLDER / "voxmelt", PROGRAM, *words], cwd=folder,
                                    capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout.split()

    def test_commands(self):
        self.assertEqual(self.completed(""), [*commands(), "--help", "--version"])
        self.assertEqual(self.completed("re"), ["render"])

    def test_options(self):
        for command in commands():
            self.assertEqual(self.completed(command, "--"), options(command))
        self.assertEqual(self.completed("run", "cello", "--frame"), ["--frame-every"])

    def test_values(self):
        self.assertEqual(self.completed("run", "cello", "--setting", ""), ["fast", "normal", "best"])
        self.assertEqual(self.completed("run", "cello", "--setting", "=", "b"), ["best"])
        self.assertEqual(self.completed("run", "cello", "--setting", "="), ["fast", "normal", "best"])
        self.assertEqual(self.completed("run", "cello", "--threads", ""), [])
        self.assertEqual(self.completed("export", "cello", "--format", "n"), ["npy", "nrrd", "npz"])
        self.assertEqual(self.completed("run", "cello", "--implementation", "ref"), ["reference"])
        self.assertEqual(self.completed("verify", "cello", "--hw", "ti"), ["tiny"])
        self.assertEqual(self.completed("run", "cello", "--report", "mi"), ["mine.toml"])

    def test_places(self):
        self.assertEqual(self.completed("run", "cello_"), ["cello_viscous"])
        self.assertEqual(sorted(self.completed("run", "m")), ["mine.toml", "model.stl"])
        self.assertEqual(self.completed("list", "fe"), ["features"])
        self.assertEqual(self.completed("info", "mi"), ["mine.toml"])


if __name__ == "__main__":
    unittest.main(argv=["manual_test"], verbosity=1)
