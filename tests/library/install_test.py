#!/usr/bin/env python3
"""What `cmake --install` leaves works anywhere: the program finds its files beside itself, and
projects outside the tree build against the library, with g++ and with clang++.

  install_test.py ROOT BUILD
"""
import ctypes
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

root, build = (Path(argument).resolve() for argument in sys.argv[1:3])
APPROVED = json.loads((root / "tests/app/digests.json").read_text())
# Nothing of the tree may help, neither a folder `scenes` nor a variable.
ELSEWHERE = {key: value for key, value in os.environ.items() if key != "VOXMELT_SCENES"}


def output(*command, cwd):
    result = subprocess.run([str(word) for word in command], cwd=cwd, env=ELSEWHERE, capture_output=True, text=True)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.stdout}{result.stderr}")
    return result.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        output("cmake", "--install", build, "--prefix", cls.folder / "first", cwd=cls.folder)
        shutil.move(cls.folder / "first", cls.folder / "moved")
        cls.prefix = cls.folder / "moved"

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def build(self, source, compiler):
        place = self.folder / f"{source.name}-{compiler}"
        output("cmake", "-S", source, "-B", place, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={compiler}",
               f"-DCMAKE_PREFIX_PATH={self.prefix}", cwd=self.folder)
        output("cmake", "--build", place, cwd=self.folder)
        return place

    def test_no_installed_file_knows_the_source_or_build_tree(self):
        files = [p for p in self.prefix.rglob("*") if p.is_file()]
        self.assertGreater(len(files), 30)
        for file in files:
            data = file.read_bytes()
            for tree in (root, build):
                self.assertFalse(os.fsencode(tree) + b"/" in data, f"{file} names {tree}")

    def test_the_moved_program_finds_scenes_and_presets(self):
        program = self.prefix / "bin/voxmelt"
        names = {line.split()[0] for line in output(program, "list", "scenes", cwd=self.folder).splitlines()}
        self.assertEqual(names, {p.stem for p in (root / "scenes").glob("*.toml")})
        presets = {line.split()[0] for line in output(program, "list", "presets", cwd=self.folder).splitlines()}
        self.assertEqual(presets, {p.stem for p in (root / "hwmodel/machine/presets").glob("*.toml")})
        for scene in ("bunny_small", "bunny_small_viscous"):  # one with a mesh, one that extends it
            line = output(program, "digest", scene, "--steps", 10, cwd=self.folder).strip()
            self.assertEqual(line, APPROVED[scene]["10"])
        (self.folder / "link").symlink_to(program)
        self.assertIn("cello", output(self.folder / "link", "list", "scenes", cwd=self.folder))

    def test_a_consumer_outside_the_tree_gets_the_approved_digests(self):
        for compiler in ("g++", "clang++"):
            if shutil.which(compiler) is None:
                continue
            place = self.build(root / "tests/consumer", compiler)
            consumer, plugin = place / "consumer", ctypes.CDLL(str(place / "libplugin.so"))
            plugin.digest_of.restype = ctypes.c_uint64
            scene = self.prefix / "share/voxmelt/scenes/bunny_small.toml"
            self.assertEqual(f"{plugin.digest_of(os.fsencode(scene), 10):016x}", APPROVED["bunny_small"]["10"].split()[3], "as a module")
            self.assertEqual(plugin.digest_of(b"nowhere.toml", 10), 0)
            for scene in ("bunny_small", "lesson_tubes"):
                line = output(consumer, scene, 10, cwd=self.folder).strip()
                self.assertEqual(line, APPROVED[scene]["10"], compiler)

    # It is configured, not built. Targets of the same names as ours in other rooms stand beside it.
    def test_a_project_that_takes_the_tree_in_gets_the_library_alone(self):
        source, place = self.folder / "outer", self.folder / "outer-build"
        source.mkdir()
        (source / "main.cpp").write_text("int main() {}\n")
        (source / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(outer LANGUAGES CXX)\nenable_testing()\n"
            "foreach(name voxmelt measure bench_measure accuracy library_test)\n  add_executable(${name} main.cpp)\nendforeach()\n"
            f'add_subdirectory("{root}" inner)\nadd_executable(outer main.cpp)\ntarget_link_libraries(outer PRIVATE voxmelt::voxmelt)\n')
        output("cmake", "-S", source, "-B", place, "-G", "Ninja", cwd=self.folder)
        self.assertIn("Total Tests: 0", output("ctest", "--test-dir", place, "-N", cwd=self.folder))
        targets = output("ninja", "-C", place, "-t", "targets", "all", cwd=self.folder)
        self.assertIn("inner/library/libvoxmelt.a: CXX_STATIC_LIBRARY_LINKER", targets)
        for room in ("hwmodel", "app", "bench", "tests", "measure", "accuracy", "report"):
            self.assertNotIn(f"inner/{room}/", targets)

    def test_the_examples_build_against_it(self):
        melt = self.build(root / "examples", "g++") / "melt"
        scene = self.prefix / "share/voxmelt/scenes/bunny_small.toml"
        self.assertIn(APPROVED["bunny_small"]["10"].split()[3], output(melt, scene, 10, cwd=self.folder))


if __name__ == "__main__":
    unittest.main(argv=["install_test"], verbosity=1)
