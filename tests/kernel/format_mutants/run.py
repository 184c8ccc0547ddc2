#!/usr/bin/env python3
"""Bugs in readers of meshes and volumes, in writers of states and films, in the helper for OpenVDB,
in the package for Python and in the examples: does the test that each names find it?

    tests/kernel/format_mutants/run.py --check   every replacement applies: quick, and one of ./test.sh
    tests/kernel/format_mutants/run.py           builds and runs each; --only says which

It wants a standing build: cmake --build --preset release --target voxmelt voxmelt-vdb voxmelt_python example_melt ... (or all)
"""
import argparse
import pathlib
import re
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from overlay import ROOT, Build, Overlay, misfit, run

PROGRAM, HELPER = "app/voxmelt", "app/voxmelt-vdb"


def with_change(source, folder, mutant):
    """A folder that has what `source` has, by links, but for the file that changes."""
    folder.mkdir()
    for path in source.iterdir():
        (folder / path.name).symlink_to(path)
    changed = folder / pathlib.Path(mutant["file"]).name
    if changed.is_file():
        changed.unlink()
        changed.write_text((ROOT / mutant["file"]).read_text().replace(mutant["before"], mutant["after"]))
    return folder


def python_test(build, mutant, folder):
    """A test of tests/python, with a module, a file of the package or an example that has changed."""
    root, package, programs = folder / "root", folder / "package/voxmelt", build.folder / "examples"
    with_change(ROOT, root, {"file": ""})
    (root / "examples").unlink()
    with_change(ROOT / "examples", root / "examples", mutant)
    package.parent.mkdir()
    with_change(build.folder / "python/voxmelt", package, mutant)
    source = mutant["file"]
    if source.endswith(".cpp") and source.startswith("examples/"):
        name = pathlib.Path(source).stem
        programs = with_change(programs, folder / "programs", mutant)
        (programs / name).unlink()
        (programs / name).symlink_to(Overlay(build, mutant, folder, "-O1").link(f"examples/{name}"))
    elif source.endswith(".cpp"):
        module = next(package.glob("_voxmelt*.so"))
        module.unlink()
        module.symlink_to(Overlay(build, mutant, folder, "-O1").link(f"python/voxmelt/{module.name}"))
    interpreter = re.search(r"^VOXMELT_PYTHON:\w+=(.+)$", (build.folder / "CMakeCache.txt").read_text(), re.M)
    last = {"examples": [programs], "package": [build.folder / PROGRAM]}.get(mutant["test"].removeprefix("python."), [])
    return [interpreter[1] if interpreter else sys.executable, f"tests/python/{mutant['test'].removeprefix('python.')}_test.py",
            str(root), str(package.parent), *map(str, last)]


def found_by(build, mutant):
    """The first test that fails, or nothing."""
    with tempfile.TemporaryDirectory() as folder:
        if mutant["test"].startswith("python."):
            return first_failure(*run(python_test(build, mutant, pathlib.Path(folder)), 600))
        changed = HELPER if mutant["file"].startswith("app/vdb/") else PROGRAM
        programs = {name: build.folder / name for name in (PROGRAM, HELPER)}
        programs[changed] = Overlay(build, mutant, pathlib.Path(folder), "-O1").link(changed)
        code, text = run([sys.executable, f"tests/app/{mutant['test']}_test.py", str(programs[PROGRAM])], 600, {"VOXMELT_VDB": str(programs[HELPER])})
    return first_failure(code, text)


def first_failure(code, text):
    if code == 0:
        return ""
    first = re.search(r"^(?:FAIL|ERROR): (\w+)", text, re.M)
    return first[1] if first else f"ends with {code}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only see that every replacement applies")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="the standing build")
    parser.add_argument("--only", default="", help="mutants whose name holds this regular expression")
    options = parser.parse_args()
    mutants = [one for path in sorted(HERE.glob("*.toml")) for one in tomllib.loads(path.read_text())["mutant"]]
    problems = [f"{mutant['name']}: {problem}" for mutant in mutants if (problem := misfit(mutant))]
    print("\n".join(problems) if problems else f"{len(mutants)} mutants apply")
    if problems or options.check:
        return 1 if problems else 0
    build = Build(options.build, lambda source, *_: source.startswith(("kernel/scene/", "kernel/vdb/", "kernel/run/io/", "render/frames/", "library/")))
    missed = []
    for mutant in (one for one in mutants if re.search(options.only, one["name"])):
        found = found_by(build, mutant)
        missed += [] if found else [mutant["name"]]
        print(f"{mutant['name']:<48} {found or 'NOT FOUND'}", flush=True)
    print(f"not found: {', '.join(missed)}" if missed else "all found")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
