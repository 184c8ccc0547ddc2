#!/usr/bin/env python3
"""The kernels for NEON compile for aarch64 without a warning and, under an emulator, give the reference's bits.

  neon_test.py ROOT     builds in build/neon/

Runs tests/kernel/cpu (single operations against kernel/rule), tests/kernel/parallel/hostile_test.cpp (random
worlds of both laws, compared after every phase), and committed scenes, whose digests are those approved. Without a cross compiler: skipped (77). Without an emulator, or
the sources of GoogleTest: compiled only.
"""
import json
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

COMPILER = shutil.which("aarch64-linux-gnu-g++")
EMULATOR = shutil.which("qemu-aarch64")
HEADERS = Path("/usr/include")
GTEST = Path("/usr/src/googletest/googletest")
KERNEL = [f"kernel/{folder}" for folder in ("state", "scalar", "simd", "simd/arch", "parallel", "cpu", "visibility", "run")]
OTHER_SETS = {"sse.cpp", "avx2.cpp", "avx512.cpp", "arch_sse.cpp", "arch_avx2.cpp", "arch_avx512.cpp"}
# -ffp-contract as in cmake/VoxmeltTarget.cmake; static, so that no emulated system is needed.
OPTIONS = ["-std=c++20", "-ffp-contract=off", "-DVOXMELT_PLAIN_THREADS", "-pthread"]
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wno-sign-conversion", "-Werror"]

if COMPILER is None or not (HEADERS / "xsimd").is_dir():
    print("no compiler for aarch64, or no xsimd")
    sys.exit(77)

root = Path(sys.argv[1])
build = root / "build/neon"
shutil.rmtree(build, ignore_errors=True)
include = build / "include"  # the libraries' headers, without those of this machine's own system
include.mkdir(parents=True)
for library in ("xsimd", "gtest", "fmt", "toml++", "tiny_obj_loader.h"):
    (include / library).symlink_to(HEADERS / library)


def sources(*folders):
    return [p for folder in folders for p in sorted((root / folder).glob("*.cpp")) if p.name not in OTHER_SETS]


def compiled(source, *options):
    out = build / (source.relative_to(source.anchor).as_posix().replace("/", "_") + ".o")
    level = "-O3" if "arch" in source.as_posix() else "-O2"
    subprocess.run([COMPILER, *OPTIONS, level, *options, "-I", root, "-isystem", include, "-c", source, "-o", out],
                   check=True)
    return out


with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
    def all_compiled(files, *options):
        return list(pool.map(lambda source: compiled(source, *options), files))

    slowest_first = sorted(sources(*KERNEL), key=lambda source: source.name != "neon.cpp")
    kernel = all_compiled(slowest_first, *WARNINGS)
    print(f"{len(kernel)} sources of kernel/ compile for aarch64")
    if EMULATOR is None or not (GTEST / "src/gtest-all.cc").exists():
        print("no emulator, or no GoogleTest to compile: nothing was run")
        sys.exit(0)
    gtest = all_compiled([GTEST / "src/gtest-all.cc", GTEST / "src/gtest_main.cc"], "-I", GTEST)
    scene = all_compiled([*sources("kernel/scene"), root / "tests/house/digests_main.cpp"], *WARNINGS, "-DFMT_HEADER_ONLY")
    subprocess.run([COMPILER, "-static", "-pthread", *scene, *kernel, "-o", build / "digests"], check=True)
    programs = {"lanes": sources("tests/kernel/cpu"), "hostile": [root / "tests/kernel/parallel/hostile_test.cpp"]}
    for name, files in programs.items():
        objects = all_compiled(files, *WARNINGS)
        # getaddrinfo, in GoogleTest, is not called: the linker's warning about it is left out.
        subprocess.run([COMPILER, "-static", "-pthread", *objects, *gtest, *kernel, "-o", build / name], check=True,
                       stderr=subprocess.DEVNULL)

# Side by side: emulation is slow.
running = [subprocess.Popen([EMULATOR, build / name, "--gtest_brief=1", f"--gtest_filter={which}"])
           for name, which in (("lanes", "*"), ("hostile", "*paper*"), ("hostile", "*viscous*"))]
approved = {name: lines["10"].split()[3] for name, lines in json.loads((root / "tests/app/digests.json").read_text()).items()
            if name.startswith(("lesson_", "paper_")) or "_small" in name}
listing = subprocess.run([EMULATOR, build / "digests", root / "scenes", "neon", "10", *approved], check=True,
                         capture_output=True, text=True).stdout
failed = [f"scene {name}" for name, found in approved.items() if f"{name} {found}\n" not in listing]
failed += [process.args[1].name + " " + process.args[3] for process in running if process.wait() != 0]
print(f"differ: {failed}" if failed else f"neon gives the reference's bits; {len(approved)} scenes have their digests")
sys.exit(1 if failed else 0)
