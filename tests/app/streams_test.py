#!/usr/bin/env python3
"""Standard output and standard error that are full, closed, or whose reader has gone.

  streams_test.py PROGRAM

What is written to standard error is for people: where it is lost, nothing else may be. What is lost of standard
output is an error, exit code 3; files are written all the same.
"""
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM, SMALL, write

WARNS = re.sub(r"^power = .*$", "power = 900", SMALL, flags=re.M)  # more than a cell takes up: a warning


def gone():
    """The writing end of a pipe that nobody reads."""
    reads, writes = os.pipe()
    os.close(reads)
    return writes


class Streams(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.scene = write(self.folder, WARNS)

    def run_with(self, stream, kind, *arguments):
        """Exit code, and what came by the other stream."""
        other = "stderr" if stream == "stdout" else "stdout"
        if kind == "closed":
            redirect = {"stdout": ">&-", "stderr": "2>&-"}[stream]
            result = subprocess.run(["sh", "-c", f'exec "$0" "$@" {redirect}', PROGRAM, *map(str, arguments)], cwd=self.folder,
                                    text=True, **{other: subprocess.PIPE})
        else:
            place = gone() if kind == "gone" else os.open("/dev/full", os.O_WRONLY)
            try:
                result = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, text=True,
                                        **{stream: place, other: subprocess.PIPE})
            finally:
                os.close(place)
        return result.returncode, getattr(result, other)

    def commands(self, name):
        yield "run", (self.scene, "--steps", 8, "--frame-every", 4, "--size", "32x32", "--out", f"out/{name}")
        yield "export", (self.scene, "--steps", 4, "--out", f"fields/{name}")
        yield "digest", (self.scene, "--steps", 4, "--every", 1)
        yield "verify", (self.scene, "--steps", 2, "--report", f"{name}.json")
        yield "render", (self.scene, "--steps", 4, "--size", "32x32", "--out", f"{name}.png")

    def check_files(self, name):
        self.assertEqual(len(list((self.folder / f"out/{name}/frames").glob("*.png"))), 3, name)
        self.assertTrue(json.loads((self.folder / f"out/{name}/report.json").read_text())["complete"], name)
        for file in (f"fields/{name}/amount.npy", f"{name}.json", f"{name}.png"):
            self.assertGreater((self.folder / file).stat().st_size, 0, file)

    def test_without_standard_error_all_is_done(self):
        for kind in ("full", "closed", "gone"):
            for command, arguments in self.commands(kind):
                with self.subTest(kind=kind, command=command):
                    code, output = self.run_with("stderr", kind, command, *arguments)
                    self.assertEqual(code, 0)
                    self.assertNotEqual(output, "" if command in ("digest", "verify", "run") else None)
            self.check_files(kind)

    def test_without_standard_output_files_are_written_and_the_loss_is_said(self):
        reasons = {"full": "No space left on device", "closed": "it is closed", "gone": "Broken pipe"}
        for kind, reason in reasons.items():
            for command, arguments in self.commands(kind):
                if command in ("export", "render"):  # they have nothing to say
                    arguments = (*arguments, "--quiet")
                with self.subTest(kind=kind, command=command):
                    code, said = self.run_with("stdout", kind, command, *arguments)
                    if command in ("export", "render"):
                        self.assertIn(code, (0, 3))
                        continue
                    self.assertEqual(code, 3, said)
                    self.assertIn(reason, said)
                    self.assertEqual(len([line for line in said.splitlines() if "cannot write" in line]), 1, said)
            self.check_files(kind)

    def test_long_lists_end_like_short_ones(self):
        for what in ("faults", "features", "cases"):
            for kind, reason in (("full", "No space left on device"), ("closed", "it is closed"), ("gone", "Broken pipe")):
                with self.subTest(what=what, kind=kind):
                    code, said = self.run_with("stdout", kind, "list", what)
                    self.assertEqual(code, 3)
                    self.assertIn(reason, said)

    def test_an_error_that_nobody_can_read_has_its_exit_code(self):
        for kind in ("full", "closed", "gone"):
            code, output = self.run_with("stderr", kind, "digest", "no_such_scene")
            self.assertEqual((code, output), (2, ""), kind)


if __name__ == "__main__":
    unittest.main(argv=["streams_test"], verbosity=1)
