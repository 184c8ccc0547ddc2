#!/usr/bin/env python3
"""The kernels for AVX-512, on any x86-64 machine with AVX2, by emulated instructions, give the reference's bits.

  avx512_test.py ROOT     builds in build/avx512/

Runs tests/kernel/engine/cpu (single operations against kernel/automaton/rule), tests/kernel/engine/parallel but for its scenes (hostile and
sleeping worlds of both laws, compared after every phase), and committed scenes, whose digests are those approved.
The kernels are the real ones, with xsimd; each intrinsic they use is a plain loop of avx512_emulated.h. Without AVX2,
g++, xsimd or the sources of GoogleTest: skipped (77).
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

from emulated import GTEST_SOURCES, HEADERS, Build

COMPILER = shutil.which("g++")
CPU = Path("/proc/cpuinfo")
FLAGS = set(re.search(r"^flags.*$|\Z", CPU.read_text() if CPU.exists() else "", re.M)[0].split())

if not {"avx2", "fma", "bmi1", "bmi2"} <= FLAGS:
    print("no AVX2")
    sys.exit(77)
if COMPILER is None or not (HEADERS / "xsimd").is_dir() or not GTEST_SOURCES[0].exists():
    print("no g++, no xsimd, or no GoogleTest to compile")
    sys.exit(77)

root = Path(sys.argv[1])
house = root / "tests/house"
# -Wpsabi: how 64 bytes are passed, which is the same on both sides.
build = Build(root, "avx512", COMPILER, ["-O1", "-march=x86-64-v3", "-Wno-psabi", "-include", house / "avx512_emulated.h"],
              first=house / "avx512_only")
kernel = build.compiled_kernel()
build.link_programs(kernel, {"lanes": build.sources("tests/kernel/engine/cpu"),
                             "parallel": [root / f"tests/kernel/engine/parallel/{name}_test.cpp" for name in ("hostile", "sleep", "wake")]})

for emulated in build.own_objects:
    code = subprocess.run(["objdump", "-d", emulated], check=True, capture_output=True, text=True).stdout
    if found := re.search(r".*%(zmm|k[0-7]).*", code):
        sys.exit(f"real AVX-512 in {emulated.name}: {found[0].strip()}")

sys.exit(build.differ([("lanes", "*"), ("parallel", "*paper*"), ("parallel", "*viscous*"),
                       ("parallel", "-*paper*:*viscous*")]))
