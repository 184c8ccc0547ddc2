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
    "bench": KERNEL + ["bench/measure", "hwmodel/stream"],
    "kernel/io": ["kernel/rule", "kernel/state", "kernel/scene"],
    "kernel/run": KERNEL,
    "render/image": ["kernel/rule", "kernel/state", "kernel/scene"],
    "render/density": ["kernel/rule", "kernel/state", "kernel/scene", "kernel/cpu", "render/image", "render/density/arch"],
    "render/density/arch": ["render/density"],
    "render/raycast": ["kernel/rule", "kernel/state", "kernel/scene", "render/image", "render/density"],
    # The model computes with its own arithmetic: of the kernel it sees data only.
    "hwmodel/channel": [],
    "hwmodel/stream": ["hwmodel/channel", "kernel/rule", "kernel/state"],
    "hwmodel/presets": ["hwmodel/stream", "kernel/scene"],
    "hwmodel/lockstep": KERNEL + ["hwmodel/channel", "hwmodel/stream", "hwmodel/presets"],
    "app": KERNEL + ["bench/measure", "bench/baseline", "render/image", "render/density", "render/raycast",
                     "hwmodel/stream", "hwmodel/lockstep", "hwmodel/presets"],
}
# What hwmodel may take from kernel/rule: numbers that describe a scene, no rule.
RULE_DATA = {"kernel/rule/parameters.h"}
RULE_CALL = re.compile(r"\brule::[a-z_0-9]+\(")
LONGEST = 500
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
SOURCES = {".h", ".cpp"}


def offences(root):
    found = []
    for path in sorted(p for top in ("kernel", "render", "hwmodel", "app", "bench") for p in (root / top).rglob("*") if p.suffix in SOURCES):
        folder = path.relative_to(root).parent.as_posix()
        lines = path.read_text().splitlines()
        name = path.relative_to(root).as_posix()
        if len(lines) > LONGEST:
            found.append(f"{name}: {len(lines)} lines; at most {LONGEST}")
        if folder not in ALLOWED:
            found.append(f"{name}: folder {folder} is not in the rules")
            continue
        for number, line in enumerate(lines, 1):
            if folder == "hwmodel/stream" and RULE_CALL.search(line):
                found.append(f"{name}:{number}: hwmodel/stream has its own arithmetic and calls no rule")
            match = INCLUDE.match(line)
            if not match:
                continue
            kind, target = match.groups()
            ours = target.split("/")[0] in ("kernel", "render", "app", "tests", "bench", "hwmodel")
            if folder == "kernel/rule" and kind == '"' and not target.startswith("kernel/rule/"):
                found.append(f"{name}:{number}: kernel/rule includes the standard library only, not {target}")
            elif folder == "kernel/rule" and kind == "<" and ("/" in target or target.endswith(".h")):
                found.append(f"{name}:{number}: kernel/rule includes the standard library only, not <{target}>")
            elif folder == "hwmodel/stream" and target.startswith("kernel/rule/") and target not in RULE_DATA:
                found.append(f"{name}:{number}: hwmodel/stream may include {', '.join(RULE_DATA)} only, not {target}")
            elif kind == "<" and target.startswith("systemc") and not folder.startswith("hwmodel"):
                found.append(f"{name}:{number}: SystemC appears only in hwmodel")
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
        "hwmodel/stream/i.cpp": '#include "kernel/rule/heat.h"\n',
        "hwmodel/stream/j.cpp": "const int f = rule::scaled(1, 2);\n",
        "hwmodel/stream/k.cpp": '#include "kernel/scalar/reference.h"\n',
        "hwmodel/channel/l.h": '#include "hwmodel/stream/cell.h"\n',
        "app/m.cpp": "#include <systemc>\n",
    }
    fine = {"kernel/scalar/ok.cpp": '#include "kernel/rule/heat.h"\n#include <vector>\n',
            "hwmodel/stream/ok.cpp": '#include "kernel/rule/parameters.h"\n#include <systemc>\n'}
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
