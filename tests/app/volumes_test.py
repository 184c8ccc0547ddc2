#!/usr/bin/env python3
"""Volumes in every format, as a user meets them.

  volumes_test.py VOXMELT

A body of boxes is made of shapes, and given as a volume that other programs write: NumPy, and unu of teem. Both have the
same digest. What is no volume gets exit code 2 and one line that names its place, soon and with little memory.
"""
import gzip
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

from program import PROGRAM, voxmelt, write

SIZE = (12, 10, 14)  # x, y, z
BOXES = [((1, 2, 3), (5, 8, 11)), ((5, 2, 3), (11, 4, 6)), ((8, 4, 4), (9, 9, 5))]  # low, high
SECONDS, BYTES = 2, 200 << 20
PYTHONS = [sys.executable, "/usr/bin/python3"]
UNU = shutil.which("teem-unu") or shutil.which("unu")
NUMPY = next((python for python in PYTHONS if shutil.which(python)
              and subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode == 0), None)


def within(x, y, z, boxes=BOXES):
    return any(all(low[i] <= p < high[i] for i, p in enumerate((x, y, z))) for low, high in boxes)


NX, NY, NZ = SIZE
CELLS = bytes(within(x, y, z) for z in range(NZ) for y in range(NY) for x in range(NX))
HEAD = f"[grid]\nsize = [{NX}, {NY}, {NZ}]\n"


def of_shapes(boxes=BOXES):
    return HEAD + "".join(
        f'[[solid]]\nshape = "box"\nsize = {[h - l for l, h in zip(low, high)]}\nat = {[(l + h) / 2 for l, h in zip(low, high)]}\n'
        for low, high in boxes)


def volume(file, more=""):
    return f'{HEAD}[[solid]]\nshape = "volume"\nfile = "{file}"\n{more}'


def npy(type_="|u1", shape=(NZ, NY, NX), data=CELLS, order="False", version=1):
    text = f"{{'descr': '{type_}', 'fortran_order': {order}, 'shape': {shape}, }}".encode().ljust(100) + b"\n"
    return b"\x93NUMPY" + bytes((version, 0)) + struct.pack("<H" if version == 1 else "<I", len(text)) + text + data


def nrrd(data=CELLS, **fields):
    fields = {"type": "uchar", "dimension": "3", "sizes": f"{NX} {NY} {NZ}", "encoding": "raw"} | fields
    return b"NRRD0004\n# by hand\n" + "".join(f"{k}: {v}\n" for k, v in fields.items() if v).encode() + b"\n" + data


def meta(data=CELLS, **fields):
    fields = {"ObjectType": "Image", "NDims": 3, "DimSize": f"{NX} {NY} {NZ}", "ElementType": "MET_UCHAR",
              "ElementDataFile": "LOCAL"} | fields
    name = fields.pop("ElementDataFile")
    return ("".join(f"{k} = {v}\n" for k, v in fields.items() if v) + f"ElementDataFile = {name}\n").encode() + data


def chunk(name, content, children=b""):
    return name + struct.pack("<II", len(content), len(children)) + content + children


def vox(size=(NX, NZ, NY), voxels=None, more=b""):
    """z is up in the file, and what faces us has the least y."""
    if voxels is None:
        voxels = [(x, NZ - 1 - z, y, 3 if x < 5 else 7) for z in range(NZ) for y in range(NY) for x in range(NX) if within(x, y, z)]
    body = chunk(b"SIZE", struct.pack("<3I", *size)) + chunk(
        b"XYZI", struct.pack("<I", len(voxels)) + b"".join(bytes(v) for v in voxels)) + more
    return b"VOX " + struct.pack("<I", 150) + chunk(b"MAIN", b"", body)


WITH_NUMPY = """
import numpy, sys
a = numpy.frombuffer(bytes.fromhex(sys.argv[1]), numpy.uint8).reshape(%d, %d, %d)
for kind in ["bool", "i1", "u1"] + [order + kind for order in "<>" for kind in ("i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8")]:
    for order in "CF":
        numpy.save(kind.replace("<", "little_").replace(">", "big_") + order + ".npy", numpy.asarray(a.astype(kind), order=order))
for version in ((1, 0), (2, 0), (3, 0)):
    with open("version_%%d.npy" %% version[0], "wb") as file:
        numpy.lib.format.write_array(file, a, version=version)
numpy.savez("plain.npz", body=a)
numpy.savez_compressed("packed.npz", other=a[:2], body=a.astype(">f4"))
""" % (NZ, NY, NX)

BAD = {
    "empty.npy": (b"", "not an npy file"),
    "version.npy": (npy(version=1)[:6] + b"\4" + npy()[7:], "npy format 4.0 is not known"),
    "header.npy": (npy()[:60], "truncated in its header"),
    "cut.npy": (npy()[:-1], "12 x 10 x 14 numbers are 1680 bytes, and it has 1679: is it truncated?"),
    "more.npy": (npy() + b"x", "and it has 1681"),
    "complex.npy": (npy("<c8"), "type '<c8': bool, whole numbers and floats are read"),
    "object.npy": (npy("|O"), "type '|O'"),
    "text.npy": (npy("<U4"), "type '<U4'"),
    "flat.npy": (npy(shape=(1680,)), "shape (1680,): three axes (z, y, x) are read"),
    "four.npy": (npy(shape=(1, NZ, NY, NX)), "three axes"),
    "wide.npy": (npy(shape=(1, 1, 1680000)), "a side of 1680000 voxels; 1 to 4096 are read"),
    "none.npy": (npy(shape=(0, 1, 1), data=b""), "a side of 0 voxels"),
    "huge.npy": (npy(shape=(4096, 4096, 4096)), "bytes of numbers; at most 1073741824 are read"),
    "order.npy": (npy(order="Maybe"), "says nothing of fortran_order"),
    "nothing.npy": (npy(data=bytes(1680)), "no number is within `filled`"),
    "pointer.npy": (b"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"),
    "empty.npz": (b"", "no archive of NumPy: is it truncated?"),
    "cut.npz": (b"PK\3\4" + bytes(60), "no archive of NumPy"),
    "damaged.npz": (b"PK\5\6" + struct.pack("<4H2IH", 0, 0, 3, 3, 0, 9999, 0), "its directory is damaged"),
    "empty.nrrd": (b"", "no NRRD file"),
    "type.nrrd": (nrrd(type="block"), "type 'block' is not read"),
    "no_type.nrrd": (nrrd(type=""), "its header has no field `type`"),
    "dimension.nrrd": (nrrd(dimension="4"), "dimension '4': 3 is read"),
    "sizes.nrrd": (nrrd(sizes="12 10"), "sizes: 2 numbers, not 3"),
    "half.nrrd": (nrrd(sizes="12 10 1.5"), "sizes: 1.5 is no number of voxels"),
    "letters.nrrd": (nrrd(sizes="12 10 O"), "sizes: 'O' is no number"),
    "endian.nrrd": (nrrd(type="short"), "its header has no field `endian`"),
    "encoding.nrrd": (nrrd(encoding="bzip2"), "encoding 'bzip2' is not read"),
    "cut.nrrd": (nrrd()[:-1], "is it truncated?"),
    "gzip.nrrd": (nrrd(encoding="gzip"), "or damaged"),
    "bomb.nrrd": (nrrd(gzip.compress(bytes(100)), encoding="gzip", sizes="1000 1000 1000"), "are not 1000000000 bytes"),
    "spacing.nrrd": (nrrd(spacings="1 0 1"), "a voxel has a side of 0"),
    "skip.nrrd": (nrrd(**{"byte skip": "7"}), "`byteskip` is not read"),
    "line.nrrd": (b"NRRD0004\nnothing\n\n", "line 2 of its header is no field"),
    "gone.nhdr": (nrrd(b"", **{"data file": "gone.raw"}), "gone.raw"),
    "empty.mha": (b"", "no field `ElementDataFile`"),
    "line.mha": (b"something\n", "line 1 of its header is no field"),
    "dims.mha": (meta(NDims=2), "NDims = '2': 3 is read"),
    "type.mha": (meta(ElementType="MET_STRING"), "ElementType = 'MET_STRING' is not read"),
    "channels.mha": (meta(ElementNumberOfChannels=3), "ElementNumberOfChannels: 1 is read"),
    "size.mha": (meta(DimSize="12 10 0"), "a side of 0 voxels"),
    "cut.mha": (meta()[:-1], "is it truncated?"),
    "packed.mha": (meta(CompressedData="True"), "or damaged"),
    "gone.mhd": (meta(b"", ElementDataFile="gone.raw"), "gone.raw"),
    "empty.vox": (b"", "no file of MagicaVoxel"),
    "cut.vox": (vox()[:-1], "a chunk is truncated"),
    "size.vox": (vox(size=(300, 1, 1)), "a side of 300 voxels; 1 to 256 are read"),
    "outside.vox": (vox(voxels=[(12, 0, 0, 1)]), "voxel 0 is at 12, 0, 0, outside of the model"),
    "count.vox": (vox().replace(struct.pack("<I", sum(CELLS)), struct.pack("<I", 1 << 31)), "2147483648 voxels are not"),
    "two.vox": (vox(more=chunk(b"SIZE", struct.pack("<3I", 1, 1, 1))), "it has several models; save one"),
    "none.vox": (b"VOX \x96\0\0\0" + chunk(b"MAIN", b""), "it has no model"),
    "air.vox": (vox(voxels=[]), "no number is within `filled`"),
    "a.tiff": (b"II*\0", "volumes are read from .npy, .npz, .nrrd, .nhdr, .mha, .mhd, .vox, not from '.tiff'"),
}


class Volumes(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def digest(self, text):
        result = voxmelt("digest", write(self.folder, text), "--steps", 0)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def same(self, name, content=None, more=""):
        if content is not None:
            (self.folder / name).write_bytes(content)
        self.assertEqual(self.digest(volume(name, more)), self.digest(of_shapes()), name)

    def test_by_hand(self):
        self.same("a.npy", npy())
        self.same("b.nrrd", nrrd())
        self.same("c.mha", meta())
        self.same("d.vox", vox())
        self.same("e.mha", meta(zlib.compress(CELLS), CompressedData="True"))
        self.same("f.mha", meta(b"".join(struct.pack(">h", 5 * c) for c in CELLS), ElementType="MET_SHORT", BinaryDataByteOrderMSB="True"),
                  "filled = [5, 5]\n")
        (self.folder / "numbers.raw").write_bytes(CELLS)
        self.same("g.mhd", meta(b"", ElementDataFile="numbers.raw"))
        self.same("h.nhdr", nrrd(b"", **{"data file": "numbers.raw"}))
        self.same("i.nrrd", nrrd(gzip.compress(CELLS), encoding="gzip"))

    def test_numbers_that_fill(self):
        self.same("a.npy", npy("<f4", data=b"".join(struct.pack("<f", 2.5 if c else 2.25) for c in CELLS)), "filled = [2.5, 9]\n")
        self.same("b.npy", npy("<f8", data=b"".join(struct.pack("<d", -1 if c else 0.1) for c in CELLS)), "filled = [-1e15, 0]\n")
        self.same("c.npy", npy("<f2", data=b"".join(struct.pack("<e", 1 if c else float("nan")) for c in CELLS)))
        (self.folder / "d.vox").write_bytes(vox())
        parts = [((1, 2, 3), (5, 8, 11))], BOXES[1:]
        for index, boxes in zip((3, 7), parts):
            self.assertEqual(self.digest(volume("d.vox", f"filled = [{index}, {index}]\n")), self.digest(of_shapes(boxes)))

    # The bits of halves are written by hand: 2^-24, 2^-14 - 2^-24, 2^-14 and 65504, and their negatives.
    def test_halves(self):
        for bits, value in ((0x0001, 2 ** -24), (0x03ff, 1023 * 2 ** -24), (0x0400, 2 ** -14), (0x3555, 1365 / 4096), (0x7bff, 65504)):
            for sign, low, high in ((0, value * 0.999, value * 1.001), (0x8000, -value * 1.001, -value * 0.999)):
                data = b"".join(struct.pack("<H", (bits | sign) if cell else 0) for cell in CELLS)
                self.same("half.npy", npy("<f2", data=data), f"filled = [{low!r}, {high!r}]\n")

    def test_places(self):
        (self.folder / "a.npy").write_bytes(npy(shape=(2, 1, 3), data=b"\1\0\1\1\1\1"))
        def boxes(*some):
            return self.digest(of_shapes(some))
        self.assertEqual(self.digest(volume("a.npy", "at = [2, 3, 4]\nscale = 2\n")),
                         boxes(((2, 3, 4), (4, 5, 8)), ((4, 3, 6), (6, 5, 8)), ((6, 3, 4), (8, 5, 8))))
        # With z up it is 2 high. The voxel that misses is below.
        self.assertEqual(self.digest(volume("a.npy", 'up = "z"\nat = [2, 3, 4]\n')),
                         boxes(((2, 3, 4), (3, 5, 5)), ((3, 4, 4), (4, 5, 5)), ((4, 3, 4), (5, 5, 5))))
        # 3 x 1 x 2 voxels fit twice as large into 6 x 7 x 8 cells.
        self.assertEqual(self.digest(volume("a.npy", "fit = { margin = 3 }\n")),
                         boxes(((3, 0, 5), (5, 2, 9)), ((5, 0, 7), (7, 2, 9)), ((7, 0, 5), (9, 2, 9))))
        # Voxels that are not cubes.
        (self.folder / "b.nrrd").write_bytes(nrrd(b"\1", sizes="1 1 1", spacings="2 3 5"))
        self.assertEqual(self.digest(volume("b.nrrd", "at = [1, 1, 1]\n")), boxes(((1, 1, 1), (3, 4, 6))))
        (self.folder / "c.nrrd").write_bytes(nrrd(b"\1", sizes="1 1 1", **{"space directions": "(0,2,0) (3,0,0) (0,0,5)"}))
        self.assertEqual(self.digest(volume("c.nrrd", "at = [1, 1, 1]\n")), boxes(((1, 1, 1), (3, 4, 6))))

    @unittest.skipUnless(NUMPY, "no NumPy here: apt-get install python3-numpy")
    def test_what_numpy_writes(self):
        subprocess.run([NUMPY, "-c", WITH_NUMPY, CELLS.hex()], cwd=self.folder, check=True)
        names = sorted(path.name for path in self.folder.glob("*.npy"))
        self.assertEqual(len(names), 2 * 21 + 3)
        for name in names:
            with self.subTest(name):
                self.same(name)
        self.same("plain.npz")
        self.same("packed.npz", more='array = "body"\n')
        for more, expected in (("", "it has several arrays, 'other', 'body'; `array` names one"),
                               ('array = "x"\n', "it has no array 'x'; its arrays are 'other', 'body'")):
            result = voxmelt("digest", write(self.folder, volume("packed.npz", more)))
            self.assertEqual(result.returncode, 2)
            self.assertIn(expected, result.stderr)
        bytes_ = (self.folder / "packed.npz").read_bytes()
        scene = write(self.folder, volume("hurt.npz", 'array = "body"\n'))
        for at in range(0, len(bytes_), 19):  # no damage does more than that
            (self.folder / "hurt.npz").write_bytes(bytes_[:at] + bytes([bytes_[at] ^ 255]) + bytes_[at + 1:])
            result = subprocess.run([PROGRAM, "digest", scene, "--steps", "0"], capture_output=True)
            self.assertIn(result.returncode, (0, 2), result.stderr)

    @unittest.skipUnless(UNU, "no unu here: apt-get install teem-apps")
    def test_what_teem_writes(self):
        (self.folder / "a.raw").write_bytes(CELLS)
        def unu(*arguments):
            subprocess.run([UNU, *arguments], cwd=self.folder, check=True, capture_output=True)
        unu("make", "-i", "a.raw", "-t", "uchar", "-s", *map(str, SIZE), "-e", "raw", "-o", "a.nrrd")
        self.same("a.nrrd")
        unu("save", "-f", "nrrd", "-e", "gzip", "-i", "a.nrrd", "-o", "packed.nrrd")
        self.same("packed.nrrd")
        for kind in ("int8", "short", "ushort", "int", "uint", "longlong", "ulonglong", "float", "double"):
            unu("convert", "-t", kind, "-i", "a.nrrd", "-o", f"{kind}.nrrd")
            self.same(f"{kind}.nrrd")
            unu("save", "-f", "nrrd", "-e", "raw", "-en", "big", "-i", f"{kind}.nrrd", "-o", f"big_{kind}.nrrd")
            self.same(f"big_{kind}.nrrd")
        unu("save", "-f", "nrrd", "-e", "raw", "-i", "float.nrrd", "-o", "apart.nhdr")
        self.same("apart.nhdr")

    @unittest.skipUnless(UNU and NUMPY, "no unu or no NumPy here: apt-get install teem-apps python3-numpy")
    def test_teem_reads_what_is_exported(self):
        scene = write(self.folder, of_shapes() + "[heat]\ngamma = 0.1\n[[heat_source]]\nat = [14, 12, 14]\npower = 90\n")
        for form in ("npy", "nrrd"):
            result = voxmelt("export", scene, "--steps", 20, "--format", form, "--out", self.folder / form)
            self.assertEqual(result.returncode, 0, result.stderr)
        fields = sorted(path.stem for path in (self.folder / "npy").glob("*.npy"))
        self.assertEqual(sorted(path.stem for path in (self.folder / "nrrd").glob("*.nrrd")), fields)
        for field in fields:
            # unu writes text, x fastest; NumPy reads the other format.
            flat = subprocess.run([UNU, "reshape", "-s", str(NX * NY * NZ), "-i", self.folder / f"nrrd/{field}.nrrd", "-o", self.folder / "flat.nrrd"],
                                  capture_output=True)
            self.assertEqual(flat.returncode, 0, flat.stderr)
            text = subprocess.run([UNU, "save", "-f", "text", "-i", self.folder / "flat.nrrd", "-o", "-"], capture_output=True, text=True)
            numpy = subprocess.run([NUMPY, "-c", "import numpy, sys; print(*numpy.load(sys.argv[1]).ravel())", self.folder / f"npy/{field}.npy"],
                                   capture_output=True, text=True)
            self.assertEqual(text.stdout.split(), numpy.stdout.split(), field)
            self.assertEqual(len(numpy.stdout.split()), NX * NY * NZ)
            if field in ("solid", "liquid", "amount", "heat"):
                self.assertGreater(len(set(numpy.stdout.split())), 1, field)

    def test_a_volume_without_a_scene(self):
        (self.folder / "a.npy").write_bytes(npy())
        result = voxmelt("run", "a.npy", "--steps", 1, "--size", "32x32", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        # The body has 10 x 7 x 8 voxels. 96 cells of width are 9.6 to each, and the grid 6 higher and 32 deeper.
        self.assertIn("fitted to a grid of 128 x 74 x 109 cells, 9.6 to its unit", result.stderr)
        self.assertIn('shape = "volume"', (self.folder / "out/a/scene.toml").read_text())

    def test_bad_files(self):
        for name, (content, expected) in BAD.items():
            with self.subTest(name):
                (self.folder / name).write_bytes(content)
                scene = write(self.folder, volume(name))
                before = set(self.folder.iterdir())
                child = subprocess.Popen([PROGRAM, "run", scene.name, "--steps", "1"], cwd=self.folder,
                                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                out, error = child.stdout.read(), child.stderr.read()
                _, status, used = os.wait4(child.pid, 0)
                child.returncode = os.waitstatus_to_exitcode(status)
                child.stdout.close()
                child.stderr.close()
                self.assertEqual((child.returncode, out), (2, ""), error)
                self.assertRegex(error, rf"\Ascene\.toml:5:8: error: [^\n]*\b{name}\b[^\n]*\n\Z")
                self.assertIn(expected, error)
                self.assertLess(used.ru_maxrss << 10, BYTES)
                self.assertLess(used.ru_utime + used.ru_stime, SECONDS)
                self.assertEqual(set(self.folder.iterdir()), before)


unittest.main(argv=["volumes_test"])
