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
KERNEL = ["kernel/automaton/rule", "kernel/automaton/state", "kernel/scene", "kernel/scene/text", "kernel/scene/shape",
          "kernel/engine/visibility", "kernel/automaton/step", "kernel/engine/scalar",
          "kernel/engine/cpu", "kernel/engine/simd", "kernel/engine/parallel", "kernel/run/io", "kernel/run"]
ALLOWED = {
    "kernel/automaton/rule": [],
    "kernel/automaton/state": ["kernel/automaton/rule"],
    "kernel/scene": ["kernel/automaton/rule", "kernel/automaton/state", "kernel/scene/text", "kernel/scene/shape"],
    "kernel/scene/text": ["kernel/scene"],
    "kernel/scene/shape": ["kernel/automaton/state", "kernel/scene", "kernel/scene/text"],
    "kernel/engine/visibility": ["kernel/automaton/rule", "kernel/automaton/state", "kernel/scene", "kernel/engine/cpu"],
    "kernel/automaton/step": ["kernel/automaton/rule", "kernel/automaton/state"],
    "kernel/engine/scalar": ["kernel/automaton/rule", "kernel/automaton/state", "kernel/automaton/step"],
    "kernel/engine/cpu": [],
    "kernel/engine/simd": ["kernel/automaton/rule", "kernel/engine/cpu", "kernel/engine/simd/arch"],
    "kernel/engine/simd/arch": ["kernel/automaton/rule", "kernel/engine/cpu", "kernel/engine/simd"],
    "kernel/engine/parallel": ["kernel/automaton/rule", "kernel/automaton/state", "kernel/automaton/step", "kernel/engine/cpu", "kernel/engine/simd"],
    "bench/baseline": ["kernel/automaton/rule", "kernel/automaton/state"],
    "bench/measure": KERNEL + ["bench/baseline", "bench/measure/arch", "render/density"],
    "bench/measure/arch": ["kernel/engine/cpu"],
    "bench": KERNEL + ["bench/measure", "hwmodel/stream"],
    "kernel/run/io": ["kernel/automaton/rule", "kernel/automaton/state", "kernel/scene"],
    "kernel/run": KERNEL,
    "render/image": ["kernel/automaton/rule", "kernel/automaton/state", "kernel/scene"],
    "render/density": ["kernel/automaton/rule", "kernel/automaton/state", "kernel/scene", "kernel/engine/cpu", "render/image", "render/density/arch"],
    "render/density/arch": ["render/density"],
    "render/raycast": ["kernel/automaton/rule", "kernel/automaton/state", "kernel/scene", "render/image", "render/density"],
    # The model computes with its own arithmetic: of the kernel it sees data only.
    "hwmodel/channel": [],
    "hwmodel/stream": ["hwmodel/channel", "kernel/automaton/rule", "kernel/automaton/state"],
    "hwmodel/presets": ["hwmodel/stream", "kernel/scene", "kernel/scene/text"],
    "hwmodel/lockstep": KERNEL + ["hwmodel/channel", "hwmodel/stream", "hwmodel/presets"],
    "app": KERNEL + ["bench/measure", "bench/baseline", "render/image", "render/density", "render/raycast",
                     "hwmodel/stream", "hwmodel/lockstep", "hwmodel/presets"],
}
# What hwmodel may take from kernel/automaton/rule: numbers that describe a scene, no rule.
RULE_DATA = {"kernel/automaton/rule/parameters.h"}
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
            if folder == "kernel/automaton/rule" and kind == '"' and not target.startswith("kernel/automaton/rule/"):
                found.append(f"{name}:{number}: kernel/automaton/rule includes the standard library only, not {target}")
            elif folder == "kernel/automaton/rule" and kind == "<" and ("/" in target or target.endswith(".h")):
                found.append(f"{name}:{number}: kernel/automaton/rule includes the standard library only, not <{target}>")
            elif folder == "hwmodel/stream" and target.startswith("kernel/automaton/rule/") and target not in RULE_DATA:
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
        "kernel/automaton/rule/a.h": '#include "kernel/automaton/state/grid.h"\n',
        "kernel/automaton/rule/b.h": "#include <fmt/format.h>\n",
        "kernel/automaton/state/c.h": '#include "kernel/scene/scene.h"\n',
        "kernel/engine/scalar/d.cpp": '#include "kernel/run/simulation.h"\n',
        "render/image/e.h": '#include "kernel/automaton/step/phase.h"\n',
        "kernel/run/io/f.cpp": '#include "app/options.h"\n',
        "kernel/other/g.h": "\n",
        "app/h.cpp": "\n" * (LONGEST + 1),
        "hwmodel/stream/i.cpp": '#include "kernel/automaton/rule/heat.h"\n',
        "hwmodel/stream/j.cpp": "const int f = rule::scaled(1, 2);\n",
        "hwmodel/stream/k.cpp": '#include "kernel/engine/scalar/reference.h"\n',
        "hwmodel/channel/l.h": '#include "hwmodel/stream/cell.h"\n',
        "app/m.cpp": "#include <systemc>\n",
    }
    fine = {"kernel/engine/scalar/ok.cpp": '#include "kernel/automaton/rule/heat.h"\n#include <vector>\n',
            "hwmodel/stream/ok.cpp": '#include "kernel/automaton/rule/parameters.h"\n#include <systemc>\n'}
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
