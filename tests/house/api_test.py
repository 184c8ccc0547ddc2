#!/usr/bin/env python3
"""Doxygen reads include/ without a warning, and finds a planted member that nobody explains.

  api_test.py ROOT DOXYGEN
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

root, doxygen = Path(sys.argv[1]), sys.argv[2]
problems = []


def pages(tree):
    """Doxygen's complaints about TREE/include; it writes to TREE/build/api."""
    (tree / "build").mkdir(exist_ok=True)
    result = subprocess.run([doxygen, "docs/Doxyfile"], cwd=tree, capture_output=True, text=True)
    return (result.stderr or f"exit code {result.returncode}") if result.returncode != 0 else ""


with tempfile.TemporaryDirectory() as folder:
    tree = Path(folder)
    for name in ("include", "docs/Doxyfile", "docs/api_main_page.md"):
        copy = shutil.copytree if (root / name).is_dir() else shutil.copy
        (tree / name).parent.mkdir(exist_ok=True)
        copy(root / name, tree / name)
    complaints = pages(tree)
    if complaints:
        problems.append(complaints)
    if not (tree / "build/api/html/classvoxmelt_1_1Simulation.html").exists():
        problems.append("there is no page of voxmelt::Simulation")
    if "classvoxmelt_1_1Simulation.html" not in (tree / "build/api/html/index.html").read_text().split("<body>")[1]:
        problems.append("the first page does not lead to voxmelt::Simulation")

    for header in sorted((tree / "include/voxmelt").glob("*.h")):
        kept = header.read_text()
        header.write_text(kept + "\nnamespace voxmelt {\n/// A planted class.\nclass Planted {\n public:\n  int unexplained();\n};\n}\n")
        if "unexplained" not in pages(tree):
            problems.append(f"{header.name}: a planted member without a comment is not found")
        header.write_text(kept)

print("\n".join(problems) if problems else "everything public is explained")
sys.exit(1 if problems else 0)
