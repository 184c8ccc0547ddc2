#!/usr/bin/env python3
"""The docs tell the truth where a program can see it: links and paths exist, the map names the folders."""
import re
import subprocess
import sys
from pathlib import Path

root = Path(sys.argv[1])
problems = []

for page in [root / "README.md", *sorted((root / "docs").glob("*.md")), *sorted((root / "scenes").rglob("*.md"))]:
    text = page.read_text()
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        if not target.startswith("http") and not (page.parent / target).exists():
            problems.append(f"{page.relative_to(root)}: link to {target}, which does not exist")
    for path in re.findall(r"`((?:kernel|render|hwmodel|app|tests|scenes|docs|cmake)/[\w./-]+\.\w+)`", text):
        if not (root / path).exists():
            problems.append(f"{page.relative_to(root)}: names {path}, which does not exist")

# Every folder with code is on the README's map.
readme = (root / "README.md").read_text()
for top in ("kernel", "render", "hwmodel"):
    for folder in sorted(p for p in (root / top).iterdir() if p.is_dir()):
        if f"{folder.name}/" not in readme:
            problems.append(f"README.md: the map leaves out {top}/{folder.name}/")

# The scripts that the README names run at all.
for script in ("run.sh", "test.sh", ".ci/run", "cmake/install-dependencies.sh"):
    if subprocess.run(["bash", "-n", str(root / script)]).returncode != 0:
        problems.append(f"{script}: does not parse")

print("\n".join(problems) if problems else "the docs hold")
sys.exit(1 if problems else 0)
