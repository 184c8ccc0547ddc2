#!/usr/bin/env python3
"""Holds the house's include rules (README, "The house"): which folder may include which, and how long a file may be.

  include_rules.py ROOT          check a tree
  include_rules.py --self-test   check that the checker catches planted offences

The tables below say what *is*: an allowance that no file uses is an offence, too.
"""
import re
import sys
import tempfile
from pathlib import Path

RULE, STATE, STEP = "kernel/automaton/rule", "kernel/automaton/state", "kernel/automaton/step"
PARAMETERS = f"{RULE}/parameters.h"  # numbers that describe a scene; no rule
PICTURE = "render/rule"
CPU, VISIBILITY = "kernel/engine/cpu", "kernel/engine/visibility"
FABRIC, PIPELINE, CASTER = "hwmodel/fabric", "hwmodel/pipeline/model", "hwmodel/caster/model"

# Folder -> folders, or single headers, of ours that it may include (besides itself).
ALLOWED = {
    RULE: [],
    STATE: [PARAMETERS],
    STEP: [PARAMETERS, STATE],
    "kernel/vdb": [],
    "kernel/scene/text": [RULE],
    "kernel/scene/shape": [STATE, "kernel/scene/text"],
    "kernel/scene/mesh_file": ["kernel/scene/text", "kernel/scene/shape"],
    "kernel/scene/voxel_file": ["kernel/scene/text", "kernel/vdb"],
    "kernel/scene": [RULE, STATE, "kernel/scene/text", "kernel/scene/shape", "kernel/scene/mesh_file", "kernel/scene/voxel_file"],
    CPU: [],
    "kernel/engine/scalar": [RULE, STATE, STEP],
    "kernel/engine/simd": [PARAMETERS, f"{STATE}/ledger_terms.h", CPU],
    "kernel/engine/parallel": [f"{RULE}/random.h", STATE, STEP, CPU, "kernel/engine/simd"],
    "kernel/engine/gpu": [RULE, STATE, STEP],
    VISIBILITY: [RULE, STATE, CPU],
    "kernel/run": [STATE, STEP, CPU, "kernel/engine/scalar", "kernel/engine/parallel", "kernel/engine/gpu", VISIBILITY],
    "kernel/run/io": [PARAMETERS, f"{RULE}/materials.h", STATE, "kernel/vdb"],
    "kernel/run/checkpoint": [STATE, CPU, "kernel/run/io"],
    "kernel/run/trial": [STATE, STEP, "kernel/run"],
    "kernel/run/opening": [STEP, VISIBILITY, "kernel/scene", "kernel/run", "kernel/run/checkpoint", "kernel/run/io", "kernel/run/trial"],
    PICTURE: [f"{RULE}/fixed_point.h"],
    "render/image": [],
    "report/svg": [],
    "render/cells": [RULE, STATE, STEP, CPU, PICTURE, "render/image"],
    "render/frames": ["render/image"],
    "render/density": [RULE, STATE, "kernel/scene/look.h", "kernel/scene/shape/terrain.h", CPU],
    "render/light": [PICTURE, CPU, "render/density"],
    "render/brick": [CPU],
    "render/ground": ["kernel/scene/look.h", "kernel/scene/shape/terrain.h", PICTURE],
    "render/packet": ["kernel/scene/look.h", "kernel/scene/shape/terrain.h", STATE, CPU, PICTURE, "render/image", "render/density",
                      "render/light", "render/ground", "render/brick"],
    "render/device": ["kernel/engine/gpu", f"{STATE}/grid.h", "kernel/scene/look.h", "kernel/scene/shape/terrain.h", PICTURE, "render/density", "render/ground", "render/image", "render/light", "render/packet"],
    "render/textures": [PICTURE, "render/density", "render/packet"],
    "render/reference": ["kernel/scene/look.h", "kernel/scene/shape/terrain.h", f"{STATE}/volume.h", PICTURE, "render/image", "render/density", "render/light",
                       "render/ground", "render/packet"],
    "render/visibility": [VISIBILITY],
    # A model computes with its own arithmetic: of the kernel the pipeline sees data only.
    FABRIC: [],
    "hwmodel/check": [FABRIC],
    "hwmodel/check/shrink": [STATE, "kernel/run/io", "kernel/scene", "kernel/scene/text"],
    "hwmodel/memory": [FABRIC, "kernel/scene/text"],
    PIPELINE: [FABRIC, "hwmodel/check/token_source.h", PARAMETERS, STATE, f"{STEP}/phase.h"],
    "hwmodel/rtl/host": [PIPELINE],
    "hwmodel/rtl/write": [PIPELINE, STATE, "hwmodel/rtl/host"],
    "hwmodel/pipeline/streams": [FABRIC, PIPELINE, "hwmodel/memory"],
    "hwmodel/pipeline/time": [PIPELINE],
    "hwmodel/pipeline/faults": [FABRIC, "hwmodel/check", PIPELINE],
    "hwmodel/pipeline/check": ["hwmodel/fabric/ring.h", "hwmodel/check", "hwmodel/check/shrink", PIPELINE, "hwmodel/pipeline/faults", "hwmodel/pipeline/time", STATE, STEP, "kernel/engine/scalar", "kernel/run", "kernel/run/io", "kernel/scene", "kernel/scene/text"],
    "hwmodel/pipeline/report": [PIPELINE, "hwmodel/pipeline/check", "hwmodel/memory/ratio.h"],
    # The ray caster sees nothing of the software at all: the host's part stands beside it.
    CASTER: [FABRIC, "hwmodel/check/token_source.h", "hwmodel/memory"],
    "hwmodel/caster/faults": ["hwmodel/check", CASTER],
    "hwmodel/caster/host": [CASTER, STATE, PICTURE, "render/ground", "render/packet"],
    "hwmodel/caster/check": ["hwmodel/check", "hwmodel/check/shrink", CASTER, "hwmodel/caster/faults", "hwmodel/caster/host", STATE, "kernel/scene", "kernel/scene/shape/terrain.h", PICTURE, "render/image",
                             "render/density", "render/ground", "render/packet", "render/reference"],
    "hwmodel/caster/report": ["hwmodel/caster/check", "hwmodel/memory"],
    "hwmodel/machine": [FABRIC, PIPELINE, "hwmodel/pipeline/streams", "hwmodel/pipeline/time", "hwmodel/pipeline/check", "hwmodel/caster/host", "hwmodel/caster/check", "hwmodel/caster/report", "hwmodel/memory", STATE, "render/image",
                        "render/density", "render/packet", "render/reference", f"{PICTURE}/camera.h"],
    "hwmodel/machine/presets": [FABRIC, PIPELINE, CASTER, "hwmodel/memory", "kernel/scene/text"],
    "hwmodel/explore": [PIPELINE, "hwmodel/pipeline/check", "hwmodel/pipeline/streams", "hwmodel/pipeline/time", "hwmodel/memory", STATE, STEP, "kernel/run", "kernel/scene/text"],
    "report/svg": [],
    "report/hardware": ["report/svg"],
    "report/accuracy": ["accuracy", "accuracy/front", "report/svg"],
    "report/bench": ["measure"],
    "report/runs": ["report/svg"],
    "bench": ["accuracy/picture", "measure", PIPELINE, PARAMETERS, STATE, "kernel/scene", CPU, VISIBILITY, "kernel/run",
              "render/density", "render/packet", "render/reference", "render/visibility"],
    "measure": ["kernel/engine/gpu", "measure/baseline", PARAMETERS, STATE, STEP, "kernel/scene", CPU, VISIBILITY,
                "kernel/run", "render/density", "render/device", "render/packet", "render/image", "render/frames"],
    "measure/baseline": [PARAMETERS, STATE],
    # The judge sees states and scenes, never a rule.
    "accuracy": [STATE, STEP, "kernel/scene", "kernel/run", "measure"],
    # The twin has rules of its own; with the automaton it shares its choices at random and who follows rays.
    "accuracy/formats": [RULE, STATE, VISIBILITY],
    "accuracy/front": ["accuracy", "accuracy/formats", STATE, "kernel/scene", "measure"],
    # The converged picture reads the picture's data, and computes with its own arithmetic.
    "accuracy/picture": ["kernel/scene", CPU, "kernel/run", PICTURE, "render/density", "render/image", "render/reference", "render/packet/scene_in_integers.h"],
    # What strangers include: the standard library only.
    "include/voxmelt": [],
    "library": ["include/voxmelt", "library/journal", PARAMETERS, STATE, "kernel/scene", "kernel/scene/text", "kernel/run", "kernel/run/trial", "kernel/run/checkpoint", "kernel/run/io", "kernel/run/opening",
                CPU, "render/cells", "render/device/picture_on_device.h", "render/image", "render/packet", "render/textures", f"{PICTURE}/camera.h"],
    "python": ["include/voxmelt"],
    "examples": ["include/voxmelt"],
    # The page's server: all work is done by the library.
    "app/view": ["app", "library/journal", "include/voxmelt", "render/frames", "render/image"],
    "library/journal": ["include/voxmelt", "kernel/scene/scene.h"],
    "app/vdb": ["kernel/vdb/stream.h"],
    "app/runs": ["app", "report/runs", "kernel/scene", "kernel/scene/text", "kernel/run/io", "kernel/run/checkpoint", "kernel/run/opening"],
    "app": ["library/journal", "render/density/density_field.h", "render/density/values.h", "include/voxmelt/errors.h", "library/by_hand.h", "kernel/scene/text/ascii.h", "kernel/scene/text/suggestion.h", CPU, VISIBILITY, "render/visibility", "accuracy", "accuracy/front", "measure", "report/accuracy", "report/bench", "report/hardware", PIPELINE, "hwmodel/pipeline/streams", "hwmodel/pipeline/check",
            "hwmodel/pipeline/faults", "hwmodel/pipeline/report", "hwmodel/caster/check", "hwmodel/caster/faults", "hwmodel/caster/report", "hwmodel/explore", "hwmodel/machine", "hwmodel/rtl/host", "hwmodel/rtl/write", "hwmodel/check/channel_trace.h",
            "hwmodel/machine/presets", "hwmodel/memory", STATE, f"{STEP}/stepper.h", "kernel/scene", "kernel/scene/shape/heightfield.h", "kernel/run", "kernel/run/checkpoint", "kernel/run/io", "kernel/run/opening", "kernel/run/trial", "render/device/picture_on_device.h", "render/image",
            "render/frames", "render/packet", f"{PICTURE}/camera.h", "render/reference/print_trace.h"],
}
# Header of a third party (its beginning) -> folders, or single files, that may include it. The rest is the standard library's.
THIRD_PARTY = {
    "systemc": [FABRIC],
    "xsimd/": [CPU],
    "tbb/": [CPU, "app/vdb"],
    "openvdb/": ["app/vdb"],
    "embree3/": ["render/visibility"],
    "toml++/": ["kernel/scene/text"],
    "png.h": ["render/image", "kernel/scene/shape/png_heights.cpp"],
    "tiffio.h": ["kernel/scene/shape/tiff_file.h"],
    "libdeflate": ["kernel/run/io/npz.cpp", "kernel/run/io/vti.cpp", "kernel/scene/voxel_file/unpack.cpp", "render/image"],
    "zstd.h": ["kernel/run/checkpoint"],
    "xxhash.h": ["kernel/run/checkpoint"],
    "CLI/": ["app/command_line.cpp"],
    "CL/": ["kernel/engine/gpu/open_cl_library.h"],
    "boost/": ["app/view/server.cpp"],
    "pybind11/": ["python"],
    "jpeglib.h": ["app/view/encode.cpp"],
    "webp/": ["render/frames/webp_bytes.cpp"],
    "benchmark/": ["bench"],
    "nlohmann/": ["kernel/scene/mesh_file", "kernel/run/checkpoint", "kernel/run/io", "hwmodel/memory", "hwmodel/pipeline/report", "hwmodel/caster/report", "hwmodel/explore", "hwmodel/machine", "report/accuracy",
                  "report/bench", "report/hardware", "app", "app/runs", "app/view"],
    "fmt/": ["hwmodel/rtl/write", "kernel/run/trial", "kernel/scene/text", "kernel/scene/shape", "kernel/scene/mesh_file", "kernel/scene/voxel_file", "kernel/scene", "hwmodel/check", "hwmodel/pipeline/check", "hwmodel/pipeline/report", "hwmodel/caster/check",
             "hwmodel/caster/report", "hwmodel/explore", "hwmodel/machine", "measure", "accuracy", "accuracy/front", "report/svg", "report/accuracy", "report/bench",
             "report/hardware", "report/runs", "app", "app/runs", "library/journal", "app/view"],
}
RULE_CALL = re.compile(r"\brule::[a-z_0-9]+\(")
LONGEST = 500
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
TOPS = ("kernel", "render", "hwmodel", "app", "bench", "measure", "accuracy", "report", "include", "library", "python", "examples")
STANDARD_ONLY = (RULE, PICTURE, "include/voxmelt")


def offence_of(folder, name, kind, target, used):
    """What is wrong with one include, or nothing; `used` collects the allowances it needed."""
    if target.startswith("voxmelt/"):
        target = f"include/{target}"
    if kind == '"' or target.split("/")[0] in (*TOPS, "tests"):
        into = Path(target).parent.as_posix()
        if into == folder:
            return None
        for allowance in (target, into):
            if allowance in ALLOWED[folder]:
                used.add((folder, allowance))
                return None
        return f"{folder} may not include {target}"
    for library, folders in THIRD_PARTY.items():
        if target.startswith(library):
            for allowance in (name, folder):
                if allowance in folders:
                    used.add((library, allowance))
                    return None
            return f"{folder} may not include <{target}>"
    if folder in STANDARD_ONLY and ("/" in target or target.endswith(".h")):
        return f"{folder} includes the standard library only, not <{target}>"
    return None


def offences(root):
    found, used, folders, files = [], set(), set(), set()
    for path in sorted(p for top in TOPS for p in (root / top).rglob("*") if p.suffix in (".h", ".cpp")):
        name, folder = path.relative_to(root).as_posix(), path.relative_to(root).parent.as_posix()
        lines = path.read_text().splitlines()
        folders.add(folder)
        files.add(name)
        if len(lines) > LONGEST:
            found.append(f"{name}: {len(lines)} lines; at most {LONGEST}")
        if folder not in ALLOWED:
            found.append(f"{name}: folder {folder} is not in the rules")
            continue
        for number, line in enumerate(lines, 1):
            if folder == PIPELINE and RULE_CALL.search(line):
                found.append(f"{name}:{number}: hwmodel/pipeline/model has its own arithmetic and calls no rule")
            match = INCLUDE.match(line)
            if match and (wrong := offence_of(folder, name, *match.groups(), used)):
                found.append(f"{name}:{number}: {wrong}")
    for folder in folders & set(ALLOWED):
        found += [f"{folder}: may include {into}, and never does" for into in ALLOWED[folder] if (folder, into) not in used]
    for library, allowed in THIRD_PARTY.items():
        found += [f"{place}: may include <{library}...>, and never does"
                  for place in (folders | files) & set(allowed) if (library, place) not in used]
    return found


def self_test():
    planted = {
        f"{RULE}/a.h": f'#include "{STATE}/grid.h"\n',
        f"{RULE}/b.h": "#include <fmt/format.h>\n",
        f"{RULE}/c.h": "#include <unistd.h>\n",
        f"{STATE}/d.h": '#include "kernel/scene/scene.h"\n',
        "kernel/scene/shape/e.h": '#include "kernel/scene/scene.h"\n',
        "kernel/engine/scalar/f.cpp": '#include "kernel/engine/simd/kernels.h"\n',
        "kernel/engine/simd/g.h": f'#include "{RULE}/heat.h"\n',
        "render/image/h.h": f'#include "{STEP}/phase.h"\n',
        "kernel/run/io/i.cpp": '#include "app/options.h"\n',
        "kernel/other/j.h": "\n",
        "app/k.cpp": "\n" * (LONGEST + 1),
        "hwmodel/pipeline/model/l.cpp": f'#include "{RULE}/heat.h"\n',
        "hwmodel/pipeline/model/m.cpp": "const int f = rule::scaled(1, 2);\n",
        "hwmodel/pipeline/model/n.cpp": '#include "kernel/engine/scalar/reference.h"\n',
        "hwmodel/caster/model/m2.h": f'#include "{PICTURE}/sample.h"\n',
        "hwmodel/fabric/o.h": '#include "hwmodel/pipeline/model/cell.h"\n',
        "app/p.cpp": "#include <systemc>\n",
        "app/p2.cpp": "#include <CLI/CLI.hpp>\n",
        "kernel/engine/parallel/q.cpp": "#include <tbb/parallel_for.h>\n",
        "include/voxmelt/s.h": "#include <fmt/format.h>\n",
        "include/voxmelt/t.h": f'#include "{STATE}/grid.h"\n',
        "library/u.cpp": f'#include "{RULE}/heat.h"\n',
        "examples/v.cpp": '#include "kernel/scene/scene.h"\n',
        "kernel/scene/w.cpp": '#include <voxmelt/voxmelt.h>\n',
        "kernel/run/r.cpp": '#include "tests/kernel/worlds.h"\n',
    }
    fine = {"kernel/engine/scalar/ok.cpp": f'#include "{RULE}/heat.h"\n#include <vector>\n',
            "examples/ok.cpp": '#include <voxmelt/voxmelt.h>\n',
            "hwmodel/pipeline/model/ok.cpp": f'#include "{PARAMETERS}"\n',
            "hwmodel/fabric/ok.cpp": "#include <systemc>\n",
            "app/command_line.cpp": "#include <CLI/CLI.hpp>\n"}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in {**planted, **fine}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        found = offences(root)
    caught = {offence.split(":")[0] for offence in found if "never does" not in offence}
    unused = {offence for offence in found if "never does" in offence}
    missed = set(planted) - caught
    wrong = caught - set(planted)
    if missed or wrong:
        sys.exit(f"missed: {sorted(missed)}; wrongly reported: {sorted(wrong)}")
    for expected in (f"kernel/engine/scalar: may include {STEP}, and never does",
                     "hwmodel/pipeline/model: may include hwmodel/fabric, and never does",
                     "app: may include <nlohmann/...>, and never does"):
        if expected not in unused:
            sys.exit(f"missed: {expected}")
    for used in (f"kernel/engine/scalar: may include {RULE}, ", f"hwmodel/pipeline/model: may include {PARAMETERS}, ",
                 "hwmodel/fabric: may include <systemc", "app/command_line.cpp: may include <CLI/"):
        if any(offence.startswith(used) for offence in unused):
            sys.exit(f"wrongly reported: {used}")
    print(f"all {len(planted)} planted offences caught, and allowances that nobody uses")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = offences(Path(sys.argv[1]))
    print("\n".join(problems) if problems else "the include rules hold")
    sys.exit(1 if problems else 0)
