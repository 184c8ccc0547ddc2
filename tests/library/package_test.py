#!/usr/bin/env python3
"""Debian's package works in a bare Debian 12, and what is in it works elsewhere.

  package_test.py ROOT BUILD [SYSTEM]     skipped (77) without root, mmdebstrap, or Debian's packages

SYSTEM: a folder that mmdebstrap has made before. It is copied.
"""
import atexit
import functools
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, BUILD = (Path(argument).resolve() for argument in sys.argv[1:3])
APPROVED = json.loads((ROOT / "tests/app/digests.json").read_text())
SKIPPED = 77
# What apt says here of clocks and proxies holds in the bare system, too.
APT = [line.strip() for line in subprocess.run(["apt-config", "dump", "Acquire"], capture_output=True, text=True).stdout.splitlines()
       if line.startswith(("Acquire::http", "Acquire::Check"))]
USE = ("import voxmelt, importlib.metadata\n"
       "s = voxmelt.Simulation('{scene}'); s.step(10)\n"
       "print(f\"{{importlib.metadata.version('voxmelt')}} {{s.digest():016x}} {{s.state().amount.shape}}\")\n")


def output(*command, **options):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.stdout[-3000:]}{result.stderr[-3000:]}")
    return result.stdout


@functools.cache
def packed():
    """Makes the package of the build as it stands, with less care for its size."""
    folder = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, folder)
    output("cpack", "--config", BUILD / "CPackConfig.cmake", "-G", "DEB", "-B", folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", cwd=folder)
    package, = Path(folder).glob("voxmelt_*.deb")
    return package


def bare_system(folder):
    """Debian 12 with apt, and nothing else. Without it the test is skipped."""
    if os.geteuid() != 0 or shutil.which("mmdebstrap") is None:
        print("skipped: it wants root, and mmdebstrap (apt-get install mmdebstrap)")
        sys.exit(SKIPPED)
    if len(sys.argv) > 3:
        output("cp", "-a", sys.argv[3], folder)
        return
    options = [f"--aptopt={line}" for line in APT]
    result = subprocess.run(["mmdebstrap", "--variant=apt", *options, "bookworm", folder], capture_output=True, text=True)
    if result.returncode != 0:
        print(f"skipped: Debian's packages cannot be reached\n{result.stderr[-2000:]}")
        sys.exit(SKIPPED)


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.system = cls.folder / "system"
        bare_system(cls.system)
        cls.package = packed()
        shutil.copy(cls.package, cls.system / "root/voxmelt.deb")
        shutil.copytree(ROOT / "tests/consumer", cls.system / "root/consumer")
        cls.inside("apt-get", "update")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def inside(cls, *command, **environment):
        # A name space of its own: /proc is gone when the command ends.
        script = 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"'
        clean = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive", **environment}
        return output("unshare", "--mount", "sh", "-c", script, cls.system, *command, env=clean)

    def install(self, *packages):
        self.inside("apt-get", "install", "-y", "-q", *packages)

    def elf_files(self):
        listed = self.inside("dpkg", "-L", "voxmelt").split()
        return [name for name in listed if (file := self.system / name[1:]).is_file() and file.read_bytes()[:4] == b"\x7fELF"]

    def digest(self, program):
        return self.inside(program, "digest", "bunny_small", "--steps", "10").strip()

    # The order matters: what is installed later could help what is tested earlier.
    def test_1_the_programs_need_nothing_but_what_the_package_asks_for(self):
        self.install("--no-install-recommends", "/root/voxmelt.deb")
        self.assertEqual(self.digest("voxmelt"), APPROVED["bunny_small"]["10"])
        vdb = (BUILD / "app/voxmelt-vdb").is_file()
        self.assertEqual(len(self.elf_files()), 6 + vdb, "the programs, and a module")
        for name in self.elf_files():
            said = self.inside("ldd", name)
            self.assertIn("libc.so.6 => ", said)
            self.assertNotIn("not found", said, name)
        for command in ("view", "sweep", "bench", "verify"):  # each is another program
            self.assertIn(f"voxmelt {command}", self.inside("voxmelt", command, "--help"))
        self.inside("voxmelt", "run", "bunny_small", "--steps", "20", "--out", "/root/run", "--quiet")
        self.assertTrue((self.system / "root/run/film.webp").is_file(), "there is no ffmpeg")
        if vdb:
            self.inside("voxmelt", "export", "bunny_small", "--format", "vdb", "--out", "/root/state", "--quiet")
            self.assertEqual(len(list((self.system / "root/state").glob("*.vdb"))), 1)

    def test_2_they_work_elsewhere(self):
        (self.system / "elsewhere").mkdir()
        self.inside("dpkg-deb", "-x", "/root/voxmelt.deb", "/elsewhere")
        self.inside("mv", "/usr/share/voxmelt", "/usr/share/hidden")
        try:
            self.assertEqual(self.digest("/elsewhere/usr/bin/voxmelt"), APPROVED["bunny_small"]["10"])
            self.assertNotEqual(subprocess.run(["chroot", self.system, "voxmelt", "digest", "bunny_small"], capture_output=True).returncode, 0)
        finally:
            self.inside("mv", "/usr/share/hidden", "/usr/share/voxmelt")

    def test_3_python(self):
        self.inside("apt-get", "purge", "-y", "-q", "voxmelt")
        self.install("/root/voxmelt.deb")  # with what it recommends
        version = output("dpkg-deb", "-f", self.package, "Version").strip()
        wanted = [version, APPROVED["bunny_small"]["10"].split()[3], "(38,", "28,", "35)"]
        use = USE.format(scene="/usr/share/voxmelt/scenes/bunny_small.toml")
        self.assertEqual(self.inside("python3", "-c", use).split(), wanted)
        folder = "/elsewhere/usr/lib/python3/dist-packages"
        self.assertEqual(self.inside("python3", "-c", use + f"assert voxmelt.__file__.startswith('{folder}')", PYTHONPATH=folder).split(), wanted)

    def test_4_a_consumer_builds(self):
        self.install("g++", "clang", "cmake", "ninja-build", "pkg-config")
        (self.system / "root/small.cpp").write_text(
            "#include <voxmelt/voxmelt.h>\n#include <cstdio>\n"
            "int main(int, char** a) { voxmelt::Simulation s(a[1]); s.step(10); std::printf(\"%016llx\\n\", (unsigned long long)s.digest()); }\n")
        scene = "/usr/share/voxmelt/scenes/bunny_small.toml"
        for compiler, prefix in (("g++", "/usr"), ("clang++", "/elsewhere/usr")):
            with self.subTest(f"{compiler} {prefix}"):
                place = f"/root/{compiler}{prefix.replace('/', '-')}"
                self.inside("cmake", "-S", "/root/consumer", "-B", place, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={compiler}",
                            f"-Dvoxmelt_DIR={prefix}/lib/cmake/voxmelt")
                self.inside("cmake", "--build", place)
                self.assertEqual(self.inside(f"{place}/consumer", "bunny_small", "10").strip(), APPROVED["bunny_small"]["10"])
                found = {"PKG_CONFIG_PATH": f"{prefix}/lib/pkgconfig"}
                self.inside("sh", "-c", f"{compiler} /root/small.cpp -o {place}/small $(pkg-config --cflags --libs voxmelt)", **found)
                words = self.inside("pkg-config", "--cflags", "--libs", "voxmelt", **found).split()
                self.assertIn("-lvoxmelt", words)
                if prefix != "/usr":  # else it is where compilers look anyway
                    self.assertEqual([os.path.normpath(word[2:]) for word in words if word.startswith(("-I", "-L")) and "pkgconfig" in word],
                                     [f"{prefix}/include", f"{prefix}/lib"])
                self.assertEqual(self.inside(f"{place}/small", scene).strip(), APPROVED["bunny_small"]["10"].split()[3])

    def test_5_nothing_stays(self):
        self.inside("apt-get", "purge", "-y", "-q", "voxmelt")
        left = [p for p in (self.system / "usr").rglob("*voxmelt*")]
        self.assertEqual(left, [])


class Contents(unittest.TestCase):
    def test_documents(self):
        with tempfile.TemporaryDirectory() as folder:
            package = packed()
            output("dpkg-deb", "-x", package, f"{folder}/x")
            place = Path(folder, "x/usr")
            licences = (place / "share/doc/voxmelt/copyright").read_text()
            for name in ("libtomlplusplus-dev", "libcli11-dev", "nlohmann-json3-dev", "libfmt9", "libtbb12", "libstdc++6", "libpng16-16",
                         "Stanford bunny", "vega-datasets", "common-licenses/Apache-2.0"):
                self.assertIn(name, licences)
            needed = output("dpkg-deb", "-f", package, "Depends")
            for name in ("libc6 (>= ", "libfmt9", "libtbb12", "libpng16-16", "libdeflate0", "libzstd1", "libxxhash0"):
                self.assertIn(name, needed)
            for name in ("man/man1/voxmelt.1.gz", "bash-completion/completions/voxmelt", "voxmelt/scenes/cello.toml", "doc/voxmelt/changelog.gz"):
                self.assertTrue((place / "share" / name).is_file(), name)
            for tree in (ROOT, BUILD):
                holders = [p for p in place.rglob("*") if p.is_file() and os.fsencode(tree) + b"/" in p.read_bytes()]
                self.assertEqual(holders, [])
            self.assertLess(package.stat().st_size, 40 << 20)


if __name__ == "__main__":
    unittest.main(argv=["package_test"], verbosity=2, failfast=True)
