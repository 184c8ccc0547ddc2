#!/usr/bin/env python3
"""The kernels for NEON compile for aarch64 without a warning and, under an emulator, give the reference's bits.

  neon_test.py ROOT     builds in build/neon/

Runs tests/kernel/engine/cpu (single operations against kernel/automaton/rule; not the threads, of which each that ends costs the
emulator memory), tests/kernel/engine/parallel/hostile_test.cpp (random worlds of both laws, compared after every phase), the
picture's field against the plain one, and committed scenes, whose digests are those approved. Without a cross compiler:
skipped (77). Without an emulator, or the sources of GoogleTest: compiled only.
"""
import shutil
import sys
from pathlib import Path

from emulated import GTEST_SOURCES, HEADERS, Build

COMPILER = shutil.which("aarch64-linux-gnu-g++")
EMULATOR = shutil.which("qemu-aarch64")

if COMPILER is None or not (HEADERS / "xsimd").is_dir():
    print("no compiler for aarch64, or no xsimd")
    sys.exit(77)

root = Path(sys.argv[1])
build = Build(root, "neon", COMPILER, ["-O3"], [EMULATOR])
kernel = build.compiled_kernel()
print(f"{len(kernel)} sources of kernel/ compile for aarch64")
if EMULATOR is None or not GTEST_SOURCES[0].exists():
    print("no emulator, or no GoogleTest to compile: nothing was run")
    sys.exit(0)
build.link_programs(kernel, {"lanes": build.sources("tests/kernel/engine/cpu"),
                             "hostile": [root / "tests/kernel/engine/parallel/hostile_test.cpp"],
                             "picture": [*build.sources("render/density"),
                                         *sorted((root / "tests/render").glob("plain_*.cpp"))]})
sys.exit(build.differ([("lanes", "-Workers.*:Turns.*"), ("hostile", "*paper*"), ("hostile", "*viscous*"),
                       ("picture", "*")]))
