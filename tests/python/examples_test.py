#!/usr/bin/env python3
"""Each example stands in both languages, and both say and write the same, byte for byte.

  examples_test.py ROOT FOLDER_OF_PACKAGE FOLDER_OF_PROGRAMS
"""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, PACKAGE, PROGRAMS = (Path(word).resolve() for word in sys.argv[1:4])
sys.path.insert(0, str(PACKAGE))
import voxmelt  # noqa: E402

SCENE = ROOT / "scenes/bunny_small.toml"
LONGEST = 40
# Of each example: its arguments, the files that it leaves, and where it speaks.
EXAMPLES = {
    "cello": ([], ["cello.png"], ""),
    "melt": ([SCENE, 500], [], "stdout"),
    "picture": ([SCENE, 3, 20], ["picture_0.png", "picture_1.png", "picture_2.png"], ""),
    "heights": ([SCENE, 300], [], "stdout"),
    "torch": ([SCENE, 2], [], "stdout"),
    "viewer": ([SCENE, 3], ["viewer.vxc"], "stdout stderr"),
}


def digest(checkpoint):
    simulation = voxmelt.Simulation(checkpoint)
    return simulation.step_number(), simulation.digest()


def said_and_left(folder, command):
    """What a program says and writes, in a folder with the scenes. A checkpoint has the time in it: its state is compared."""
    Path(folder, "scenes").symlink_to(ROOT / "scenes")
    env = dict(os.environ, PYTHONPATH=str(PACKAGE), PYTHONDONTWRITEBYTECODE="1")
    result = subprocess.run([str(word) for word in command], cwd=folder, env=env, capture_output=True)
    files = {p.name: digest(p) if p.suffix == ".vxc" else p.read_bytes() for p in Path(folder).iterdir() if p.name != "scenes"}
    return {"code": result.returncode, "stdout": result.stdout, "stderr": result.stderr, "files": files}


def both(name, *arguments):
    with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
        return (said_and_left(first, [PROGRAMS / name, *arguments]),
                said_and_left(second, [sys.executable, ROOT / f"examples/{name}.py", *arguments]))


class Examples(unittest.TestCase):
    def test_each_stands_in_both_languages_and_is_short(self):
        for suffix in (".cpp", ".py"):
            files = [p for p in (ROOT / "examples").glob(f"*{suffix}") if p.name != "tutorial.py"]
            self.assertEqual(sorted(p.stem for p in files), sorted(EXAMPLES))
            for file in files:
                self.assertLessEqual(len(file.read_text().splitlines()), LONGEST, file.name)

    def test_both_do_the_same(self):
        for name, (arguments, files, speaks) in EXAMPLES.items():
            with self.subTest(name):
                in_cpp, in_python = both(name, *arguments)
                self.assertEqual(in_cpp["code"], 0, in_cpp["stderr"])
                self.assertEqual(sorted(in_cpp["files"]), files)
                self.assertEqual([where for where in ("stdout", "stderr") if in_cpp[where]], speaks.split())
                for what, value in in_cpp.items():
                    self.assertTrue(value == in_python[what], f"{name}: {what} differs; Python says {in_python['stderr'].decode()}")

    def test_both_say_the_same_of_mistakes(self):
        for name, (arguments, _, _) in EXAMPLES.items():
            if not arguments:
                continue
            for wrong in ([], ["missing.toml", *arguments[1:]]):
                with self.subTest(f"{name} {wrong}"):
                    in_cpp, in_python = both(name, *wrong)
                    self.assertEqual(in_cpp, in_python)
                    self.assertEqual((in_cpp["code"], in_cpp["stdout"], len(in_cpp["stderr"].splitlines())), (2, b"", 1))


if __name__ == "__main__":
    unittest.main(argv=["examples_test"], verbosity=1)
