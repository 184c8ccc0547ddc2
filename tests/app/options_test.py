#!/usr/bin/env python3
"""Every option of every subcommand, as --help lists them, refuses bad values: exit code 2 (3 where the disk is at
fault), one line that names the option, in little memory, and nothing is written."""
import os
import re
import shutil
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from program import PROGRAM, SMALL, write

COMMANDS = ("run", "digest", "export", "render", "bench", "accuracy", "verify", "rtl", "explore", "list", "info", "sweep", "plot")
# What a value of each kind must not be.
BAD = {
    "UINT": ["", "x", "-1", "1.5", "99999999999999999999", "0x", "1 2", "nan", "\u0661"],
    "INT": ["", "x", "1.5", "99999999999999999999", "1,2", "inf"],
    "FLOAT": ["", "x", "nan", "inf", "1e999", "1,5"],
    "TEXT": [""],
    "FILE": ["", "/nowhere/file.toml"],
    "KEY=VALUE": ["", "=", "x", "x=", "no.such.key=1", "\x1b[31m=1"],
    "NAME": ["", "no such case"],
    "SCENE": ["", "no such scene", "no/such.toml"],
}
MEGABYTES = 200


def options(command):
    """(option, kind of its value or None) from the help text."""
    text = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True).stdout
    found = []
    for line in text.splitlines():
        match = re.match(r"  (?:-\w,)?(--[a-z-]+)(\{\w+\})?(?:[ ](KEY=VALUE|[A-Z]+\b|\[[A-Z]+))?", line)
        if match and match[1] not in ("--help", "--version"):
            found.append((match[1], None if match[2] else match[3] and match[3].strip("[")))
    return found


class Options(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.scene = write(self.folder, SMALL).name
        write(self.folder, f'scene = "{self.scene}"\n[axes]\nheat.gamma = [0.1]\n', "plan.toml")
        write(self.folder, "step,liquid_cells\n0,0\n1,5\n", "steps.csv")

    def tearDown(self):
        self.temporary.cleanup()

    def first(self, command):
        return {"bench": [], "accuracy": [], "list": ["scenes"], "export": [self.scene, "--out", "o"],
                "explore": [self.scene, "--device", "zu7ev"], "rtl": [self.scene, "--out", "o"], "sweep": ["plan.toml"], "plot": ["steps.csv"]}.get(command, [self.scene])

    def refused(self, *arguments):
        begin = time.monotonic()
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL, text=True)
        try:
            said, _ = process.communicate(timeout=30)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            self.fail("is not refused within 30 seconds")
        code = process.returncode
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertTrue(said.endswith("\n") and said[:-1].isprintable(), repr(said))
        left = [p for p in self.folder.iterdir() if p.name not in (self.scene, "plan.toml", "steps.csv")]
        for path in left:
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        self.assertEqual(left, [], "left something behind")
        self.assertIn(code, (2, 3), said)
        return said, time.monotonic() - begin

    def test_every_option_refuses_bad_values(self):
        count, slowest = 0, 0
        for command in COMMANDS:
            for option, kind in options(command):
                bad = [] if kind is None else [[option, value] for value in BAD[kind]]
                cases = [[f"{option}=x"]] if kind is None else bad + [[option]] * (kind != "SCENE")
                for case in cases:
                    with self.subTest(f"{command} {case}"):
                        said, seconds = self.refused(command, *self.first(command), *case)
                        self.assertIn(option, said)
                        count, slowest = count + 1, max(slowest, seconds)
        self.assertGreaterEqual(count, 250)
        print(f"{count} bad values, the slowest took {slowest:.2f} s")

    def test_misspelt_options(self):
        for command in COMMANDS:
            for option, _ in options(command):
                with self.subTest(f"{command} {option}"):
                    self.refused(command, *self.first(command), option + "z")

    # Of all children so far: none took much memory.
    def test_memory(self):
        self.refused("run", self.scene, "--set", "grid.size=[4096, 4096, 4096]")
        import resource
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, MEGABYTES * 1024)


if __name__ == "__main__":
    unittest.main(argv=["options_test"], verbosity=1)
