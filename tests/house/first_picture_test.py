#!/usr/bin/env python3
"""A first picture stays cheap: what the program `voxmelt` needs is counted in lines that a compiler reads.

  first_picture_test.py ROOT BUILD    BUILD: a folder that ninja has built
  first_picture_test.py --self-test

It counts the tree's own lines in each object, headers again in each, for one instruction set; and the objects that
include CLI11 or nlohmann/json, which take seconds each. Time itself is never a test: bench/first_picture.sh measures it.
"""
import subprocess
import sys
from functools import cache
from pathlib import Path

LINES = 334300  # as counted last; more by a twentieth fails
HEAVY = {"CLI/": 1, "nlohmann/json.hpp": 6}
OTHER_SETS = ("_sse42.dir/", "_avx512.dir/")  # of preset `first` on most machines: AVX2 alone, or NEON


def tool(build, *arguments):
    return subprocess.run(["ninja", "-C", str(build), "-t", *arguments], check=True, capture_output=True, text=True).stdout


def needed(build):
    """Objects of the program."""
    inputs = tool(build, "inputs", "app/voxmelt").split()
    return {name for name in inputs if name.endswith(".o") and not any(other in name for other in OTHER_SETS)}


def depends(build, objects):
    """The files that each object was compiled from."""
    files, reading = {}, None
    for line in tool(build, "deps").splitlines():
        if line.startswith("    "):
            if reading:
                files[reading].append(line.strip())
        else:
            name = line.split(":")[0]
            reading = name if name in objects else None
            if reading:
                files[reading] = []
    return files


@cache
def lines_of(path):
    return sum(1 for _ in open(path, errors="replace"))


def count(root, build, files):
    lines, heavy = 0, dict.fromkeys(HEAVY, 0)
    for all_files in files.values():
        paths = [(Path(build) / name).resolve() for name in all_files]
        own = [path for path in paths if path.is_relative_to(root) and not path.is_relative_to(build)]
        lines += sum(lines_of(path) for path in own)
        for header in HEAVY:
            heavy[header] += any(header in path.as_posix() for path in paths)
    return lines, heavy


def offences(lines, heavy):
    found = []
    if lines > 1.05 * LINES:
        found.append(f"a first picture compiles {lines} lines of this tree; {LINES} were counted last")
    found += [f"{is_} objects of a first picture include {header}; {HEAVY[header]} were counted last"
              for header, is_ in heavy.items() if is_ > HEAVY[header]]
    return found


def self_test():
    assert not offences(LINES, dict(HEAVY))
    assert len(offences(int(1.06 * LINES), dict(HEAVY))) == 1
    for header in HEAVY:
        assert len(offences(LINES, {**HEAVY, header: HEAVY[header] + 1})) == 1
    print("all planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    root, build = (Path(argument).resolve() for argument in sys.argv[1:3])
    files = depends(build, needed(build))
    if not files:
        sys.exit("no object of the program was found: wrong folder, or it is not built")
    lines, heavy = count(root, build, files)
    print(f"{len(files)} objects, {lines} lines of this tree; " + ", ".join(f"{n} with {h}" for h, n in heavy.items()))
    problems = offences(lines, heavy)
    print("\n".join(problems))
    sys.exit(bool(problems))
