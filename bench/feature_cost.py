#!/usr/bin/env python3
"""What a feature costs the scenes that do not use it: instructions executed with it and without it.

  bench/feature_cost.py [--build FOLDER] [--out FILE] [--jobs N] [FEATURE ...]

Builds the program whole, then once per feature with AVX2 kernels that lack it (CMake option
VOXMELT_WITHOUT). Runs scenes that do not use it under callgrind, and writes a table. Only what
Simulation::step() executes on one thread counts. The digests of the two programs must agree.
Exit code 1: a feature costs a scene more than LIMIT.
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LIMIT = 0.01
STEP = "voxmelt::run::Simulation::step()"

# Scene: steps, long enough that every phase which it uses has work.
STEPS = {"lesson_spread": 60, "lesson_conduction": 60, "lesson_oven": 200, "lesson_tubes": 400, "paper_literal": 300,
         "bunny_small": 200}
# Feature (the names of kernel/engine/simd/features.h): what it is, and scenes that do not use it.
FEATURES = {
    "heat": ("heat as a whole", ["lesson_spread", "lesson_tubes"]),
    "latent": ("latent heat", ["lesson_conduction", "lesson_oven"]),
    "walls": ("isothermal walls", ["lesson_conduction", "lesson_oven"]),
    "radiation": ("radiation received", ["lesson_conduction", "lesson_oven"]),
    "air": ("exchange with air", ["lesson_conduction", "bunny_small"]),
    "convection": ("convection in liquid", ["lesson_conduction", "bunny_small"]),
    "edges": ("conduction along edges", ["lesson_oven", "bunny_small"]),
    "corners": ("conduction along corners", ["lesson_oven", "bunny_small"]),
    "viscous": ("the viscous law", ["lesson_spread", "lesson_oven"]),
    "guided": ("adhesion, drip, beta, slow fall", ["lesson_spread", "lesson_tubes"]),
    "thermal": ("thermal viscosity", ["lesson_oven", "lesson_tubes"]),
    "eight": ("diagonal neighbours", ["paper_literal"]),
    "general": ("shares by pattern, printed reading, uphill", ["lesson_spread", "lesson_oven"]),
    "support": ("support", ["lesson_spread", "paper_literal"]),
    "slump": ("slump", ["lesson_spread", "paper_literal"]),
    "reheat": ("reheat", ["lesson_oven", "paper_literal"]),
}


def build(folder, without, jobs):
    """Returns the program with `without` left out (empty: nothing)."""
    for command in (["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DVOXMELT_TESTS=OFF",
                     f"-DVOXMELT_WITHOUT={without}"],
                    ["cmake", "--build", folder, "--target", "voxmelt", "-j", str(jobs)]):
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{command[1]}: {done.stdout}{done.stderr}")
    return folder / "app" / "voxmelt"


def measure(program, scene):
    """Returns the digest and the instructions that the steps executed."""
    run = [program, "digest", ROOT / "scenes" / f"{scene}.toml", "--steps", STEPS[scene], "--implementation", "avx2",
           "--threads", 1]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([str(part) for part in ["valgrind", "--tool=callgrind", f"--toggle-collect={STEP}",
                                                      f"--callgrind-out-file={folder}/out", *run]],
                              capture_output=True, text=True)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or not found or int(found.group(1)) == 0:
        sys.exit(f"{scene}: {done.stdout}{done.stderr}")
    return done.stdout, int(found.group(1))


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--build", type=Path, default=ROOT / "build" / "features")
    arguments.add_argument("--out", type=Path, default=ROOT / "bench" / "performance_features.md")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("features", nargs="*", default=list(FEATURES), metavar="FEATURE")
    options = arguments.parse_args()

    program = build(options.build, "", options.jobs)
    whole = {scene: measure(program, scene)
             for scene in STEPS if any(scene in FEATURES[feature][1] for feature in options.features)}
    whole_program = program.read_bytes()
    lines = ["| Feature | A scene without it | Instructions a step, whole build | Feature left out | It costs |",
             "|---|---|---:|---:|---:|"]
    dear = []
    for feature in options.features:
        what, scenes = FEATURES[feature]
        program = build(options.build, feature, options.jobs)
        if program.read_bytes() == whole_program:
            sys.exit(f"leaving out {feature} changed nothing in the program")
        for scene in scenes:
            digest, count = measure(program, scene)
            if digest != whole[scene][0]:
                sys.exit(f"{scene} changes without {feature}: it uses it, or the build is wrong")
            cost = whole[scene][1] / count - 1
            if cost > LIMIT:
                dear.append(f"{feature} costs {scene} {cost:.2%}")
            lines.append(f"| {what} | `{scene}` | {whole[scene][1] / STEPS[scene]:,.0f} | {count / STEPS[scene]:,.0f} | "
                         f"{cost:+.3%} |")
            print(lines[-1], flush=True)
    lines += ["", "The figures are instructions executed in `Simulation::step()`, counted by callgrind with AVX2 on",
              "one thread. The digests of both programs agree. `bench/feature_cost.py` writes this table."]
    if dear:
        lines += ["", f"Above {LIMIT:.0%}: " + "; ".join(dear) + "."]
    if options.features == list(FEATURES):
        options.out.write_text("\n".join(lines) + "\n")
    print("\n".join(dear) if dear else f"no feature costs a scene that does not use it more than {LIMIT:.0%}")
    return 1 if dear else 0


if __name__ == "__main__":
    sys.exit(main())
