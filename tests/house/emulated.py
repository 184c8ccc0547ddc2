"""What neon_test.py and avx512_test.py share: kernel/ and its tests, built apart for one instruction set that this
machine lacks, and what they give, compared with the reference and the approved digests."""
import json
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HEADERS = Path("/usr/include")
GTEST = Path("/usr/src/googletest/googletest")
GTEST_SOURCES = [GTEST / "src/gtest-all.cc", GTEST / "src/gtest_main.cc"]
KERNEL = ["kernel/automaton/state", "kernel/run"] + [
    f"kernel/engine/{folder}" for folder in ("scalar", "simd", "parallel", "gpu", "cpu", "visibility")]
INSTANCE = "_instance.cpp"  # how sources end that are compiled once for each instruction set
# -ffp-contract as in cmake/VoxmeltTarget.cmake.
OPTIONS = ["-std=c++20", "-ffp-contract=off", "-DVOXMELT_PLAIN_THREADS", "-pthread"]
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wno-sign-conversion", "-Werror"]


class Build:
    """In build/NAME of `root`, for the instruction set NAME. `own`: options of the sources compiled for it; `runner`:
    what comes before a program that is run; `first`: a folder whose headers stand in place of those of `root`."""

    def __init__(self, root, name, compiler, own, runner=(), first=None):
        self.root, self.name, self.compiler, self.runner = root, name, compiler, list(runner)
        self.own = [*own, f"-DVOXMELT_INSTRUCTION_SET={name}", f'-DVOXMELT_LANES_HEADER="kernel/engine/cpu/lanes_{name}.h"']
        self.folders = [first, root] if first else [root]
        self.folder = root / "build" / name
        shutil.rmtree(self.folder, ignore_errors=True)
        self.include = self.folder / "include"  # the libraries' headers, without those of this machine's own system
        self.include.mkdir(parents=True)
        for library in ("xsimd", "gtest", "fmt", "toml++"):
            (self.include / library).symlink_to(HEADERS / library)
        self.own_objects = []

    def sources(self, *folders):
        """All but what wants a library of devices, which machines that are emulated do not have."""
        return [p for folder in folders for p in sorted((self.root / folder).glob("*.cpp")) if not p.name.startswith("open_cl")]

    def is_own(self, source):
        return source.name.endswith(INSTANCE)

    def compiled(self, source, *options):
        out = self.folder / (source.relative_to(source.anchor).as_posix().replace("/", "_") + ".o")
        level = self.own if self.is_own(source) else ["-O2"]
        include = [word for folder in self.folders for word in ("-I", folder)]
        subprocess.run([self.compiler, *OPTIONS, *level, *options, *include, "-isystem", self.include,
                        "-c", source, "-o", out], check=True)
        if self.is_own(source):
            self.own_objects.append(out)
        return out

    def all_compiled(self, files, *options):
        with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            return list(pool.map(lambda source: self.compiled(source, *options), files))

    def compiled_kernel(self, *more):
        slowest_first = sorted(self.sources(*KERNEL), key=lambda source: not self.is_own(source))
        return self.all_compiled([*slowest_first, *more], *WARNINGS)

    def link(self, program, objects):
        # Static, so that no emulated system is needed. getaddrinfo, in GoogleTest, is not called: the linker's
        # warning about it is left out.
        linker = subprocess.run([self.compiler, "-static", "-pthread", *objects, "-o", self.folder / program],
                                stderr=subprocess.PIPE, text=True)
        if linker.returncode != 0:
            sys.exit(linker.stderr)

    def link_programs(self, kernel, tests):
        """Program `digests`, and one for each of `tests`: name -> sources."""
        scene = self.sources("kernel/scene", "kernel/scene/text", "kernel/scene/shape")
        scene = self.all_compiled([*scene, self.root / "tests/house/digests_main.cpp"], *WARNINGS, "-DFMT_HEADER_ONLY")
        self.link("digests", [*scene, *kernel])
        gtest = self.all_compiled(GTEST_SOURCES, "-I", GTEST)
        for name, files in tests.items():
            self.link(name, [*self.all_compiled(files, *WARNINGS), *gtest, *kernel])

    def differ(self, runs):
        """What fails of the tests in `runs`, (program, filter), and of the committed scenes. All side by side: emulation
        is slow."""
        running = [subprocess.Popen([*self.runner, self.folder / name, "--gtest_brief=1", f"--gtest_filter={which}"])
                   for name, which in runs]
        digests = json.loads((self.root / "tests/app/digests.json").read_text())
        approved = {name: lines["10"].split()[3] for name, lines in digests.items()
                    if name.startswith(("lesson_", "paper_")) or "_small" in name}
        listing = subprocess.run([*self.runner, self.folder / "digests", self.root / "scenes", self.name, "10", *approved],
                                 check=True, capture_output=True, text=True).stdout
        failed = [f"scene {name}" for name, found in approved.items() if f"{name} {found}\n" not in listing]
        failed += [f"{name} {which}" for (name, which), process in zip(runs, running) if process.wait() != 0]
        print(f"differ: {failed}" if failed else f"{self.name} gives the reference's bits; {len(approved)} scenes have their digests")
        return bool(failed)
