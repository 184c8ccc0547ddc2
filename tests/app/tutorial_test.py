#!/usr/bin/env python3
"""docs/tutorial.md as its reader follows it: every scene is written, and every command is run.

  tutorial_test.py PROGRAM ROOT
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, ROOT = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
# An octahedron stands for the reader's model.
MODEL = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n" + "".join(
    f"f {x} {y} {z}\n" if (x + y + z) % 2 == 1 else f"f {x} {z} {y}\n" for x in (1, 2) for y in (3, 4) for z in (5, 6))
LEFT_OUT = ("alias ", "cmake --build")


def blocks(page):
    """Scenes, each with the name that the text before it says; and commands."""
    for text, kind, body in re.findall(r"(.*?)^```(\w+)\n(.*?)^```$", page, re.M | re.S):
        if kind == "toml":
            yield re.findall(r"`(\w+\.toml)`", text)[-1], body
        else:
            yield None, body


class Tutorial(unittest.TestCase):
    def test_it_can_be_followed(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            (folder / "bin").mkdir()
            (folder / "bin/voxmelt").symlink_to(PROGRAM)
            (folder / "model.obj").write_text(MODEL)
            env = dict(os.environ, PATH=f"{folder / 'bin'}:{os.environ['PATH']}")
            scenes = commands = 0
            for name, body in blocks((ROOT / "docs/tutorial.md").read_text()):
                if name:
                    (folder / name).write_text(body)
                    scenes += 1
                    continue
                for line in body.splitlines():
                    if line.startswith(LEFT_OUT):
                        continue
                    result = subprocess.run(["bash", "-c", line], cwd=folder, env=env, capture_output=True, text=True)
                    self.assertEqual(result.returncode, 0, f"{line}\n{result.stdout}{result.stderr}")
                    self.assertNotIn("warning", result.stderr, line)
                    commands += 1
            self.assertGreaterEqual((scenes, commands), (2, 9))
            self.assertEqual(len(list((folder / "out/ball/frames").glob("*.png"))), 11)
            self.assertTrue((folder / "out/ball/contact_sheet.png").is_file() and (folder / "verify.html").is_file())
            self.assertTrue(json.loads((folder / "out/mine/report.json").read_text())["complete"])


if __name__ == "__main__":
    unittest.main(argv=["tutorial_test"], verbosity=1)
