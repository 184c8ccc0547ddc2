#!/usr/bin/env python3
"""The tutorial runs, with and without matplotlib, and says what the program says.

  tutorial_test.py ROOT FOLDER_OF_PACKAGE VOXMELT
"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, PACKAGE, PROGRAM = (Path(word).resolve() for word in sys.argv[1:4])
WITHOUT = "import sys; sys.modules['matplotlib'] = None; sys.argv[0:1] = []; exec(open(sys.argv[0]).read())"
WITH = subprocess.run([sys.executable, "-c", "import matplotlib"], capture_output=True).returncode == 0


class Tutorial(unittest.TestCase):
    def run_it(self, folder, *how):
        env = dict(os.environ, PYTHONPATH=str(PACKAGE))
        result = subprocess.run([sys.executable, *how, ROOT / "examples/tutorial.py", ROOT / "scenes"], cwd=folder,
                                env=env, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_without_matplotlib(self):
        with tempfile.TemporaryDirectory() as folder:
            said = self.run_it(folder, "-c", WITHOUT)
            self.assertIn("no matplotlib", said)
            heights = [int(word) for word in re.search(r"solid: \[(.*)\]", said)[1].split(", ")]
            self.assertEqual((len(heights), heights), (20, sorted(heights, reverse=True)))
            self.assertGreater(heights[0], heights[-1] + 5)
            line = subprocess.run([PROGRAM, "digest", "bunny.vxc", "--steps", "150"], cwd=folder, capture_output=True,
                                  text=True, check=True).stdout
            self.assertIn(" ".join(line.split()[:4]), said)
            self.assertGreater(Path(folder, "bunny.png").stat().st_size, 10000)
            self.assertFalse(Path(folder, "front.png").exists())

    @unittest.skipUnless(WITH, "no matplotlib here: apt-get install python3-matplotlib")
    def test_with_matplotlib(self):
        with tempfile.TemporaryDirectory() as folder:
            self.run_it(folder)
            self.assertGreater(Path(folder, "front.png").stat().st_size, 10000)


if __name__ == "__main__":
    unittest.main(argv=["tutorial_test"], verbosity=1)
