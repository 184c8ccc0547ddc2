#!/usr/bin/env python3
"""Bugs in the kernels for devices, in their host and in the run loop: does kernel_gpu_test find each of them? And
those in the picture's kernels: does render_device_test?

    tests/kernel/engine/gpu/mutants/run.py --check   every replacement applies: quick, and one of ./test.sh
    tests/kernel/engine/gpu/mutants/run.py           builds and runs each; --only says which

It wants a standing build: cmake --build --preset release --target kernel_gpu_test --target render_device_test
"""
import argparse
import pathlib
import re
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[3]))

from overlay import ROOT, Build, Overlay, misfit, run


def program_of(mutant):
    picture = mutant["file"].startswith("render/device/")
    return "tests/render/render_device_test" if picture else "tests/kernel/kernel_gpu_test"


def found_by(build, mutant):
    """The first test that fails, or nothing."""
    with tempfile.TemporaryDirectory() as folder:
        program = Overlay(build, mutant, pathlib.Path(folder), "-O1").link(program_of(mutant))
        code, text = run([str(program), "--gtest_brief=1", "--gtest_fail_fast", "--gtest_filter=*Kernels*:*Spare*:PictureOnDevice*:CudaHost*"], 300)
    if code == 0:
        return ""
    first = re.search(r"\[  FAILED  \] (\S+?),? ", text + " ")
    said = re.search(r"step \d+: .*", text)
    return (first[1] if first else f"ends with {code}") + (f": {said[0][:90]}" if said else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only see that every replacement applies")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="the standing build")
    parser.add_argument("--only", default="", help="mutants whose name holds this regular expression")
    options = parser.parse_args()
    mutants = tomllib.loads((HERE / "mutants.toml").read_text())["mutant"]
    problems = [f"{mutant['name']}: {problem}" for mutant in mutants if (problem := misfit(mutant))]
    print("\n".join(problems) if problems else f"{len(mutants)} mutants apply")
    if problems or options.check:
        return 1 if problems else 0
    anew = ("kernel/engine/gpu/", "kernel/run/simulation", "render/device/", "tests/kernel/engine/gpu/plain_device")
    build = Build(options.build, lambda source, *_: source.startswith(anew))
    missed = []
    for mutant in (one for one in mutants if re.search(options.only, one["name"])):
        found = found_by(build, mutant)
        missed += [] if found else [mutant["name"]]
        print(f"{mutant['name']:<32} {found or 'NOT FOUND'}", flush=True)
    print(f"not found: {', '.join(missed)}" if missed else "all found")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
