#!/usr/bin/env python3
"""The library as a shared one: it shows what include/ offers and nothing else, and programs work with it.

  shared_test.py ROOT LIBRARY OBJECTS...   LIBRARY: the shared library; OBJECTS: of a test that calls all that it offers
  shared_test.py ROOT --fetch              a project takes the tree in by FetchContent, static and shared, and installs it
"""
import ctypes
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
FETCH = sys.argv[2] == "--fetch"
LIBRARY = Path(sys.argv[2]).resolve()
OBJECTS = [name for argument in sys.argv[3:] for name in argument.split(";")]
APPROVED = json.loads((ROOT / "tests/app/digests.json").read_text())
SCENE = "bunny_small"
# Public names are in the namespace itself; those of the rooms are in namespaces of their own.
PUBLIC = re.compile(r"voxmelt::(Simulation::(~?\w+|operator=)|[a-z]\w*)(\[abi:cxx11\])?\(")
OF_ERRORS = re.compile(r"(vtable|typeinfo|typeinfo name) for voxmelt::(\w*Error|Stopped)$")


def output(*command, cwd):
    result = subprocess.run([str(word) for word in command], cwd=cwd, capture_output=True, text=True)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.stdout}{result.stderr}")
    return result.stdout


def names(text):
    """Of lines of nm: "0123 T name" or "    U name"."""
    return {line[19:].removesuffix("@@VOXMELT") for line in text.splitlines() if len(line) > 19}


class Consumers(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def check(self, consumer, plugin):
        line = output(consumer, SCENE, 10, cwd=self.folder).strip()
        self.assertEqual(line, APPROVED[SCENE]["10"])
        module = ctypes.CDLL(str(plugin))
        module.digest_of.restype = ctypes.c_uint64
        self.assertEqual(f"{module.digest_of(os.fsencode(ROOT / f'scenes/{SCENE}.toml'), 10):016x}", APPROVED[SCENE]["10"].split()[3])
        self.assertEqual(module.digest_of(b"nowhere.toml", 10), 0)  # what it throws is caught on this side


@unittest.skipIf(FETCH, "only what fetches")
class Shared(Consumers):
    def test_it_shows_what_include_offers(self):
        shown = names(output("nm", "-DC", "--defined-only", LIBRARY, cwd="/"))
        more = {name for name in shown if not PUBLIC.match(name) and not OF_ERRORS.match(name)}
        self.assertLessEqual(more, {"VOXMELT"})
        wanted = {name for name in names(output("nm", "-C", "--undefined-only", *OBJECTS, cwd="/")) if PUBLIC.match(name)}
        self.assertGreater(len(wanted), 40)
        self.assertEqual(wanted - shown, set())

    def test_it_has_the_version_in_its_name(self):
        version = re.search(r"project\(voxmelt VERSION (\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
        self.assertIn(f"[libvoxmelt.so.{version}]", output("readelf", "-d", LIBRARY, cwd="/"))

    def test_programs_and_modules_link_it(self):
        for compiler in filter(shutil.which, ("g++", "clang++")):
            common = [compiler, "-std=c++20", "-O1", f"-I{ROOT}/include", f'-DSCENES="{ROOT}/scenes"']
            link = [f"-L{LIBRARY.parent}", "-lvoxmelt", f"-Wl,-rpath,{LIBRARY.parent}"]
            output(*common, ROOT / "tests/consumer/main.cpp", "-o", "consumer", *link, cwd=self.folder)
            output(*common, "-fPIC", "-shared", ROOT / "tests/consumer/plugin.cpp", "-o", f"plugin-{compiler}.so", *link, cwd=self.folder)
            self.assertNotIn("libfmt", output("readelf", "-d", "consumer", cwd=self.folder))
            self.check(self.folder / "consumer", self.folder / f"plugin-{compiler}.so")


@unittest.skipUnless(FETCH, "takes minutes: --fetch")
class Fetched(Consumers):
    def project(self, shared, name):
        source, place = self.folder / f"{name}-source", self.folder / name
        source.mkdir()
        (source / "CMakeLists.txt").write_text(f"""cmake_minimum_required(VERSION 3.25)
project(outer LANGUAGES CXX)
include(FetchContent)
FetchContent_Declare(voxmelt SOURCE_DIR "{ROOT}")
FetchContent_MakeAvailable(voxmelt)
add_executable(consumer "{ROOT}/tests/consumer/main.cpp")
target_link_libraries(consumer PRIVATE voxmelt::voxmelt)
target_compile_definitions(consumer PRIVATE SCENES="{ROOT}/scenes")
add_library(plugin MODULE "{ROOT}/tests/consumer/plugin.cpp")
target_link_libraries(plugin PRIVATE voxmelt::voxmelt)
""")
        output("cmake", "-S", source, "-B", place, "-G", "Ninja", f"-DBUILD_SHARED_LIBS={shared}", "-DCMAKE_BUILD_TYPE=Release",
               "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DVOXMELT_ONE_INSTRUCTION_SET=ON", "-DVOXMELT_WARNINGS=OFF", cwd=self.folder)
        output("cmake", "--build", place, "--parallel", os.cpu_count(), cwd=self.folder)
        self.check(place / "consumer", place / "libplugin.so")
        return place

    def installed(self, place, library):
        prefix = self.folder / f"prefix-{place.name}"
        output("cmake", "--install", place, "--prefix", place / "first", cwd=self.folder)
        shutil.move(place / "first", prefix)
        shutil.copytree(ROOT / "scenes", prefix / "share/voxmelt/scenes", dirs_exist_ok=True)
        self.assertTrue((next(prefix.glob("lib*")) / library).exists())
        build = self.folder / f"found-{place.name}"
        output("cmake", "-S", ROOT / "tests/consumer", "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}", cwd=self.folder)
        output("cmake", "--build", build, cwd=self.folder)
        self.check(build / "consumer", build / "libplugin.so")
        return build

    def test_shared(self):
        build = self.installed(self.project("ON", "shared"), "libvoxmelt.so")
        self.assertIn("libvoxmelt.so", output("readelf", "-d", build / "consumer", cwd="/"))

    def test_static(self):
        build = self.installed(self.project("OFF", "static"), "libvoxmelt.a")
        self.assertNotIn("libvoxmelt.so", output("readelf", "-d", build / "consumer", cwd="/"))


unittest.main(argv=["shared_test"])
