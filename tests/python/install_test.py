#!/usr/bin/env python3
"""`pip install .` works in a clean environment without a network, and what it installs works anywhere.

  install_test.py ROOT BUILD [--compile]

It installs what the build has compiled; with --compile it compiles as users do.
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, BUILD = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
APPROVED = json.loads((ROOT / "tests/app/digests.json").read_text())
CLEAN = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "VOXMELT", "PIP"))}
USE = ("import voxmelt, sys\n"
       "s = voxmelt.Simulation(sys.argv[1]); s.step(10)\n"
       "print(f'{voxmelt.__version__} {voxmelt.__file__} {s.digest():016x} {s.state().amount.shape}')\n")


def output(*command, **options):
    result = subprocess.run([str(word) for word in command], env=CLEAN, capture_output=True, text=True, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.stdout}{result.stderr}")
    return result.stdout


class Install(unittest.TestCase):
    def test_pip(self):
        with tempfile.TemporaryDirectory() as folder:
            # NumPy comes from the system, because tests have no network.
            output(sys.executable, "-m", "venv", "--system-site-packages", f"{folder}/venv")
            python = f"{folder}/venv/bin/python"
            settings = [] if "--compile" in sys.argv else ["--config-settings", f"build={BUILD}"]
            output(python, "-m", "pip", "install", "--no-index", ROOT, *settings, cwd=folder)
            said = output(python, "-c", USE, ROOT / "scenes/bunny_small.toml", cwd=folder).split(maxsplit=3)
            version = output(python, "-c", "import importlib.metadata as m; print(m.version('voxmelt'))", cwd=folder)
            self.assertEqual(said[0], version.strip())
            self.assertTrue(said[1].startswith(f"{os.path.realpath(folder)}/venv/"), said[1])
            self.assertEqual(said[2], APPROVED["bunny_small"]["10"].split()[3])
            self.assertEqual(said[3].strip(), "(38, 28, 35)")
            files = output(python, "-m", "pip", "show", "-f", "voxmelt", cwd=folder)
            for name in ("voxmelt/py.typed", "voxmelt/_voxmelt.pyi", "LICENSE"):
                self.assertIn(name, files)
            output(python, "-m", "pip", "uninstall", "-y", "voxmelt", cwd=folder)
            self.assertEqual([p for p in Path(folder).rglob("*voxmelt*") if p.is_file()], [])

    def test_a_missing_module_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            result = subprocess.run([sys.executable, "-c", "import backend; backend.build_wheel('.', {'build': '.'})"],
                                    env={**CLEAN, "PYTHONPATH": str(ROOT / "python")}, cwd=folder, capture_output=True, text=True)
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, "does not exist: no build for this interpreter")


if __name__ == "__main__":
    unittest.main(argv=["install_test"], verbosity=1)
