#!/usr/bin/env python3
"""Holds the house's include rules (README, "The house"): who may include whom, and how long a file may be.

  include_rules.py ROOT       check a tree
  include_rules.py --self-test  check that the checker catches planted offences
"""
import re
import sys
import tempfile
from pathlib import Path

# Folder -> folders of ours that it may include (besides itself).
KERNEL = ["kernel/rule", "kernel/state", "kernel/scene", "kernel/visibility", "kernel/step", "kernel/scalar",
          "kernel/cpu", "kernel/simd", "kernel/parallel", "kernel/io", "kernel/run"]
ALLOWED = {
    "kernel/rule": [],
    "kernel/state": ["kernel/rule"],
    "kernel/scene": ["kernel/rule", "kernel/state"],
    "kernel/visibility": ["kernel/rule", "kernel/state", "kernel/scene", "kernel/cpu"],
    "kernel/step": ["kernel/rule", "kernel/state"],
    "kernel/scalar": ["kernel/rule", "kernel/state", "kernel/step"],
    "kernel/cpu": [],
    "kernel/simd": ["kernel/rule", "kernel/cpu", "kernel/simd/arch"],
    "kernel/simd/arch": ["kernel/rule", "kernel/cpu", "kernel/simd"],
    "kernel/parallel": ["kernel/rule", "kernel/state", "kernel/step", "kernel/cpu", "kernel/simd"],
    "bench/baseline": ["kernel/rule", "kernel/state"],
    "bench/measure": KERNEL + ["bench/baseline", "bench/measure/arch", "render/density"],
    "bench/measure/arch": ["kernel/cpu"],
    "bench": KERNEL + ["bench/measure"],
    "kernel/io": ["kernel/rule", "kernel/state", "kernel/scene"],
    "kernel/run": KERNEL,
    "render/image": ["kernel/rule", "kernel/state", "kernel/scene"],
    "render/density": ["kernel/rule", "kernel/state", "kernel/scene", "render/image"],
    "render/raycast": ["kernel/rule", "kernel/state", "kernel/scene", "render/image", "render/density"],
    "app": KERNEL + ["bench/measure", "bench/baseline", "render/image", "render/density", "render/raycast"],
}
LONGEST = 500
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
SOURCES = {".h", ".cpp"}


def offences(root):
    found = []
    for path in sorted(p for top in ("kernel", "render", "app", "bench") for p in (root / top).rglob("*") if p.suffix in SOURCES):
        folder = path.relative_to(root).parent.as_posix()
        lines = path.read_text().splitlines()
        name = path.relative_to(root).as_posix()
        if len(lines) > LONGEST:
            found.append(f"{name}: {len(lines)} lines; at most {LONGEST}")
        if folder not in ALLOWED:
            found.append(f"{name}: folder {folder} is not in the rules")
            continue
        for number, line in enumerate(lines, 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            kind, target = match.groups()
            ours = target.split("/")[0] in ("kernel", "render", "app", "tests", "bench", "hwmodel")
            if folder == "kernel/rule" and kind == '"' and not target.startswith("kernel/rule/"):
                found.append(f"{name}:{number}: kernel/rule includes the standard library only, not {target}")
            elif folder == "kernel/rule" and kind == "<" and ("/" in target or target.endswith(".h")):
                found.append(f"{name}:{number}: kernel/rule includes the standard library only, not <{target}>")
            elif ours:
                into = Path(target).parent.as_posix()
                if into != folder and into not in ALLOWED[folder]:
                    found.append(f"{name}:{number}: {folder} may not include {into} ({target})")
    return found


def self_test():
    planted = {
        "kernel/rule/a.h": '#include "kernel/state/grid.h"\n',
        "kernel/rule/b.h": "#include <fmt/format.h>\n",
        "kernel/state/c.h": '#include "kernel/scene/scene.h"\n',
        "kernel/scalar/d.cpp": '#include "kernel/run/simulation.h"\n',
        "render/image/e.h": '#include "kernel/step/phase.h"\n',
        "kernel/io/f.cpp": '#include "app/options.h"\n',
        "kernel/other/g.h": "\n",
        "app/h.cpp": "\n" * (LONGEST + 1),
    }
    fine = {"kernel/scalar/ok.cpp": '#include "kernel/rule/heat.h"\n#include <vector>\n'}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in {**planted, **fine}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        caught = {offence.split(":")[0] for offence in offences(root)}
    missed = set(planted) - caught
    wrong = caught - set(planted)
    if missed or wrong:
        sys.exit(f"missed: {sorted(missed)}; wrongly reported: {sorted(wrong)}")
    print(f"all {len(planted)} planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = offences(Path(sys.argv[1]))
    print("\n".join(problems) if problems else "the include rules hold")
    sys.exit(1 if problems else 0)
