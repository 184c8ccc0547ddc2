#!/usr/bin/env python3
"""Bugs planted in the stages in SystemVerilog: is each found, and where it is?

  tests/rtl/mutants/run.py --check       every bug applies: this is quick, and one of ./test.sh
  tests/rtl/mutants/run.py               plants each, and runs the tests of its stage (an hour of processor time)
  tests/rtl/mutants/run.py --only NAME   those whose name holds this expression

It wants a standing build: `cmake --build --preset release --target rtl_stages_test`. A bug is one exact replacement in
a source of hwmodel/rtl. Verilator compiles the stage anew, and the test program is linked with that in front of its own.
The first difference must be in the stage that was changed.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
RTL = ROOT / "hwmodel/rtl"
BUILD = ROOT / "build/release"
VERILATOR = "/usr/share/verilator"
KEYS = {"name", "file", "before", "after", "stage"}


def read_bugs():
    return [bug for path in sorted(HERE.glob("*.toml")) for bug in tomllib.loads(path.read_text())["bug"]]


def problems_of(bug, names):
    if set(bug) != KEYS:
        return f"has the keys {', '.join(sorted(bug))}"
    if names.count(bug["name"]) != 1:
        return "is not the only one of its name"
    if not (RTL / f"{bug['stage']}_stage.sv").exists():
        return f"is of no stage: {bug['stage']}"
    text = (RTL / bug["file"]).read_text()
    if text.count(bug["before"]) != 1 or bug["before"] == bug["after"]:
        return f"does not apply: its text stands {text.count(bug['before'])} times in {bug['file']}"
    return ""


def check(bugs):
    names = [bug.get("name") for bug in bugs]
    found = [f"{bug.get('name')}: {problem}" for bug in bugs if (problem := problems_of(bug, names))]
    print("\n".join(found) or f"{len(bugs)} bugs apply")
    return 1 if found or not bugs else 0


def commands_of(target):
    told = subprocess.run(["ninja", "-C", BUILD, "-t", "commands", target], capture_output=True, text=True, check=True)
    return told.stdout.splitlines()


def link_command():
    """How the test program is linked. Its archives of stages come after what is put in front of them."""
    line = next(line for line in reversed(commands_of("rtl_stages_test")) if " -o tests/rtl/rtl_stages_test " in line)
    return line.removeprefix(": && ").split(" && ")[0]


def sources_of(stage):
    text = (RTL / "CMakeLists.txt").read_text()
    parts = re.search(r"set\(rtl_parts (.*?)\)", text, re.S)[1].split()
    return [f"{part}.sv" for part in parts] + [f"{stage}_stage.sv"]


def parameters_of(stage):
    """What a stage is compiled with beside its lanes."""
    those, what = re.search(r'stage MATCHES "(.*?)"\)\s*set\(materials (.*?)\)', (RTL / "CMakeLists.txt").read_text()).groups()
    return what.split() if re.match(those, stage) else []


def lanes_of():
    """One lane and several differ little, so only the most lanes are compiled anew."""
    cache = (BUILD / "CMakeCache.txt").read_text()
    return [max(re.search(r"VOXMELT_RTL_LANES:\w+=(.*)", cache)[1].split(";"), key=int)]


def run(command, folder):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True)


def compile_stage(folder, stage):
    """The object of the stage for each number of lanes, of its changed sources in `folder`; and what went wrong."""
    objects = []
    for lanes in lanes_of():
        prefix, made = f"rtl_{stage}_p{lanes}", folder / f"p{lanes}"
        done = run(["verilator", "--cc", "-Wno-fatal", "-Wno-lint", "-O3", "--flatten", f"-GP={lanes}", *parameters_of(stage), "--x-assign", "unique", "--x-initial",
                    "unique", "--prefix", prefix, "--top-module", f"{stage}_stage", "--Mdir", made, *sources_of(stage)],
                   folder)
        if done.returncode == 0:
            whole = "".join(f'#include "{source.name}"\n' for source in sorted(made.glob("*.cpp")))
            (made / "whole.cc").write_text(whole)
            objects.append(made / "whole.o")
            done = run(["g++", "-std=c++20", "-O1", "-fPIC", "-w", "-I", made, "-I", f"{VERILATOR}/include", "-I",
                        f"{VERILATOR}/include/vltstd", "-c", made / "whole.cc", "-o", objects[-1]], made)
        if done.returncode != 0:
            return None, done.stdout + done.stderr
    return objects, ""


def verdict_of(bug, folder):
    """Returns what became of a bug, and whether it was found in its stage."""
    for name in sources_of(bug["stage"]):
        text = (RTL / name).read_text()
        (folder / name).write_text(text.replace(bug["before"], bug["after"]) if name == bug["file"] else text)
    objects, said = compile_stage(folder, bug["stage"])
    if objects is None:
        return "does not compile: " + said.strip().splitlines()[0], False
    program = folder / "rtl_stages_test"
    # An object of the library holds several stages. What comes first counts.
    command = link_command().replace(" -o tests/rtl/rtl_stages_test ", f" -Wl,--allow-multiple-definition {' '.join(map(str, objects))} -o {program} ")
    subprocess.run(command, shell=True, cwd=BUILD, check=True, capture_output=True)
    test = "".join(part.capitalize() for part in bug["stage"].split("_"))
    try:
        done = subprocess.run([program, f"--gtest_filter=StagesInRtl.{test}*"], cwd=ROOT, capture_output=True, text=True,
                              env=os.environ | {"VOXMELT_ROUNDS": "all"}, timeout=300)
    except subprocess.TimeoutExpired:
        return "HANGS", False
    if done.returncode == 0:
        return "NOT FOUND", False
    named = re.search(r"first mismatch \((\w+)\): ([\w ]+)|(hang)s?\b", done.stdout)
    where = named[2] or named[3] if named else ""
    other_cycle = re.search(r"cycle (\d+), channel (\d+)", done.stdout)  # no other stage is a circuit then
    if not named and other_cycle:
        return f"found: {other_cycle[0]}", True
    right = where == bug["stage"] or "hang" in done.stdout
    return f"found: {named[1] if named and named[1] else where or done.stdout.strip().splitlines()[-1]}, {where}", right


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--check", action="store_true")
    options.add_argument("--only", default="")
    asked = options.parse_args()
    bugs = read_bugs()
    if asked.check:
        return check(bugs)
    bugs = [bug for bug in bugs if re.search(asked.only, bug["name"])]
    wrong = 0
    for bug in bugs:
        with tempfile.TemporaryDirectory() as folder:
            text, right = verdict_of(bug, Path(folder))
        wrong += not right
        print(f"{bug['name']}: {text}{'' if right else '   <--'}", flush=True)
    print(f"{len(bugs) - wrong} of {len(bugs)} bugs are found in their stage")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
