#!/usr/bin/env python3
"""Volumes in every format, as a user meets them.

  volumes_test.py VOXMELT

A body of boxes is made of shapes, and given as a volume that other programs write: NumPy, and unu of teem. Both have the
same digest. What is no volume gets exit code 2 and one line that names its place, soon and with little memory.
"""
import gzip
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import bad_files
from program import PROGRAM, voxmelt, write

SIZE = (12, 10, 14)  # x, y, z
BOXES = [((1, 2, 3), (5, 8, 11)), ((5, 2, 3), (11, 4, 6)), ((8, 4, 4), (9, 9, 5))]  # low, high
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


def words(**pairs):
    text = struct.pack("<I", len(pairs))
    for pair in pairs.items():
        for word in pair:
            text += struct.pack("<I", len(word)) + word.encode()
    return text


def turn_node(node, child, hidden=False, layer=0, **frame):
    """A node that moves (_t) and turns (_r) what is below."""
    attributes = words(_hidden="1") if hidden else words(_name="some")
    return chunk(b"nTRN", struct.pack("<i", node) + attributes + struct.pack("<iiii", child, -1, layer, 1) + words(**frame))


def group_node(node, children):
    return chunk(b"nGRP", struct.pack("<i", node) + words() + struct.pack(f"<{1 + len(children)}i", len(children), *children))


def shape_node(node, model):
    return chunk(b"nSHP", struct.pack("<i", node) + words() + struct.pack("<ii", 1, model) + words())


def model(size, voxels):
    return chunk(b"SIZE", struct.pack("<3I", *size)) + chunk(b"XYZI", struct.pack("<I", len(voxels)) + b"".join(bytes(v) for v in voxels))


def magica(*parts):
    return b"VOX " + struct.pack("<I", 200) + chunk(b"MAIN", b"", b"".join(parts))


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
    "encoding.nrrd": (nrrd(encoding="bzip2"), "encoding 'bzip2' is not read; raw, gzip and ascii are: `unu save -f nrrd -e gzip`"),
    "hex.nrrd": (nrrd(encoding="hex"), "encoding 'hex' is not read; raw, gzip and ascii are\n"),
    "few.nrrd": (nrrd(b"1 " * 1679, encoding="ascii"), "it has 1679 of 1680 numbers: is it truncated?"),
    "many.nrrd": (nrrd(b"1 " * 1681, encoding="ascii"), "it has more than 1680 numbers"),
    "word.nrrd": (nrrd(b"1 " * 9 + b"one " * 1671, encoding="ascii"), "number 9 is 'one'"),
    "short.nrrd": (nrrd(b"1 " * 99, encoding="ascii", sizes="4096 4096 60"), "1006632960 numbers are not 198 bytes of text"),
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
    "two.vox": (vox(more=chunk(b"SIZE", struct.pack("<3I", 1, 1, 1))), "it has 2 models, and no scene that places them"),
    "root.vox": (vox(more=shape_node(1, 0)), "its scene has no node 0"),
    "child.vox": (vox(more=turn_node(0, 1)), "its scene has no node 1"),
    "twice.vox": (vox(more=turn_node(0, 1) + turn_node(0, 1)), "node 0 of its scene is there twice"),
    "loop.vox": (vox(more=turn_node(0, 1) + group_node(1, [2]) + turn_node(2, 1)), "node 1 of its scene has two parents"),
    "self.vox": (vox(more=turn_node(0, 0)), "node 0 of its scene has two parents"),
    "model.vox": (vox(more=turn_node(0, 1) + shape_node(1, 1)), "its scene names model 1 of 1"),
    "minus.vox": (vox(more=turn_node(0, 1) + shape_node(1, -1)), "its scene names model -1 of 1"),
    "rotation.vox": (vox(more=turn_node(0, 1, _r="5") + shape_node(1, 0)), "_r = '5' is no rotation"),
    "rotated.vox": (vox(more=turn_node(0, 1, _r="x") + shape_node(1, 0)), "_r: 'x' is no number"),
    "move.vox": (vox(more=turn_node(0, 1, _t="1 2") + shape_node(1, 0)), "_t: 2 numbers, not 3"),
    "far.vox": (vox(more=turn_node(0, 1, _t="1 2 1e9") + shape_node(1, 0)), "_t = '1 2 1e9' is no move"),
    "wide.vox": (vox(more=turn_node(0, 1) + group_node(1, [2, 3]) + turn_node(2, 4, _t="-3000 0 0") + turn_node(3, 5, _t="3000 0 0")
                     + shape_node(4, 0) + shape_node(5, 0)), "its models span 6012 voxels; at most 4096 are read"),
    "hidden.vox": (vox(more=turn_node(0, 1, hidden=True) + shape_node(1, 0)), "its scene shows no model: all is hidden"),
    "node.vox": (vox(more=chunk(b"nGRP", struct.pack("<2i", 0, 0))), "a node of its scene is truncated"),
    "nodes.vox": (vox(more=chunk(b"nGRP", struct.pack("<3i", 0, 0, 1 << 30))), "a node of its scene has 1073741824 parts in 0 bytes"),
    "none.vox": (b"VOX \x96\0\0\0" + chunk(b"MAIN", b""), "it has no model"),
    "air.vox": (vox(voxels=[]), "no number is within `filled`"),
    "a.tiff": (b"II*\0", "volumes are read from .npy, .npz, .nrrd, .nhdr, .mha, .mhd, .vox, .vdb, not from '.tiff'; numbers without a header want `raw`"),
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

    def test_numbers_as_text(self):
        text = " ".join(str(3 * c) for c in CELLS).encode()
        self.same("a.nrrd", nrrd(text, encoding="ascii"))
        self.same("b.nrrd", nrrd(text.replace(b" ", b"\n"), encoding="text", type="float"), "filled = [3, 3]\n")
        self.same("c.nrrd", nrrd(text.replace(b" ", b", ").replace(b"3", b"3.0e+0") + b"\n\n", encoding="txt", type="double"), "filled = [3, 3]\n")
        (self.folder / "numbers.txt").write_bytes(text)
        self.same("d.nhdr", nrrd(b"", encoding="ascii", **{"data file": "numbers.txt"}))

    # What the header of a file would say stands in the scene.
    def test_numbers_without_a_header(self):
        size = f"size = [{NX}, {NY}, {NZ}]"
        self.same("a.raw", CELLS, f'raw = {{ {size}, type = "uint8" }}\n')
        self.same("b.dat", b"head!" + b"".join(struct.pack(">h", -7 * c) for c in CELLS),
                  f'filled = [-7, -7]\nraw = {{ {size}, type = "int16", endian = "big", skip = 5 }}\n')
        self.same("c", b"".join(struct.pack("<d", c) for c in CELLS), f'raw = {{ {size}, type = "float64", endian = "little" }}\n')
        (self.folder / "d.raw").write_bytes(b"\1")
        self.assertEqual(self.digest(volume("d.raw", 'at = [1, 1, 1]\nraw = { size = [1, 1, 1], type = "int8", spacing = [2, 3, 5] }\n')),
                         self.digest(of_shapes([((1, 1, 1), (3, 4, 6))])))
        for more, expected in (("", "a.raw: volumes are read from .npy"),
                               (f'raw = {{ {size}, type = "uint16" }}\n', "12 x 10 x 14 numbers are 3360 bytes, and it has 1680: is it truncated?"),
                               (f'raw = {{ {size}, type = "uint8", skip = 1 }}\n', "are 1680 bytes, and it has 1679"),
                               (f'raw = {{ {size}, type = "uint8", skip = 9999 }}\n', "it has 1680 bytes, and 9999 are to be skipped"),
                               (f'raw = {{ {size}, type = "u8" }}\n', "float64"), (f"raw = {{ {size} }}\n", "type"),
                               (f'raw = {{ {size}, type = "uint8", endian = "middle" }}\n', "little"),
                               (f'raw = {{ {size}, type = "uint8", skip = -1 }}\n', "skip"),
                               ('raw = { size = [12, 10, 1.5], type = "uint8" }\n', "size: 1.5 is no number of voxels"),
                               ('raw = { size = [12, 10, 5000], type = "uint8" }\n', "size"),
                               (f'raw = {{ {size}, type = "uint8", spacing = [1, 0, 1] }}\n', "spacing"),
                               (f'raw = {{ {size}, type = "uint8", order = "C" }}\n', "order")):
            result = voxmelt("digest", write(self.folder, volume("a.raw", more)), "--steps", 0)
            self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1), result.stderr)
            self.assertIn(expected, result.stderr)

    def boxes(self, file, *cells, size=1):
        """The file holds these cells and no others. Their lowest corner is moved to (1, 1, 1)."""
        low = [min(cell[axis] for cell in cells) for axis in range(3)]
        moved = [tuple(1 + c - l for c, l in zip(cell, low)) for cell in cells]
        self.assertEqual(self.digest(volume(file, "at = [1, 1, 1]\n")), self.digest(of_shapes([(cell, tuple(c + size for c in cell)) for cell in moved])))

    # By hand, in the file's axes: a model of 3 x 2 x 1 has its middle at (1, 1, 0). An L of three voxels (0, 0), (2, 0), (0, 1).
    # A quarter turn about z takes (x, y) to (-y, x); the scene's x, y, z are x, z, -y here.
    def test_scenes_of_several_models(self):
        shape = model((3, 2, 1), [(0, 0, 0, 1), (2, 0, 0, 1), (0, 1, 0, 1)])
        one = model((1, 1, 1), [(0, 0, 0, 2)])
        (self.folder / "turned.vox").write_bytes(magica(shape, turn_node(0, 1, _r=str(1 | 0 << 2 | 1 << 4)) + shape_node(1, 0)))
        # voxels' middles (-0.5, -0.5), (1.5, -0.5), (-0.5, 0.5) become (0.5, -0.5), (0.5, 1.5), (-0.5, -0.5)
        self.boxes("turned.vox", (0, 0, 1), (0, 0, -1), (-1, 0, 1))
        # With moves: the first one turned and moved by (4, 0, 2), the second one in a group that is moved by (0, 1, 0) and mirrored along x.
        scene = (turn_node(0, 1) + group_node(1, [2, 3]) + turn_node(2, 4, _r=str(1 | 0 << 2 | 1 << 4), _t="4 0 2") + turn_node(3, 5, _r=str(0 | 1 << 2 | 1 << 4), _t="0 1 0")
                 + shape_node(4, 0) + group_node(5, [6]) + turn_node(6, 7, _t="3 2 0") + shape_node(7, 1))
        (self.folder / "both.vox").write_bytes(magica(shape, one, scene))
        # the second one: middle (0.5, 0.5, 0.5) + (3, 2, 0), mirrored (-3.5, 2.5), moved by (0, 1): the cell (-4, 3, 0)
        self.boxes("both.vox", (4, 2, 1), (4, 2, -1), (3, 2, 1), (-4, 0, -3))
        # Chunks in another order, a copy of the same model, and a hidden layer.
        copies = (shape_node(4, 1) + shape_node(5, 1) + shape_node(6, 0) + turn_node(2, 4, _t="0 0 0") + turn_node(3, 5, _t="5 0 1") + turn_node(7, 6, layer=3)
                  + group_node(1, [2, 3, 7]) + turn_node(0, 1) + chunk(b"LAYR", struct.pack("<i", 3) + words(_hidden="1") + struct.pack("<i", -1)))
        (self.folder / "copies.vox").write_bytes(magica(shape, one, copies))
        self.boxes("copies.vox", (0, 0, 0), (5, 1, 0))
        # What comes later is seen where both are; its index counts.
        over = turn_node(0, 1) + group_node(1, [2, 3]) + turn_node(2, 4, _t="1 1 0") + turn_node(3, 5, _t="0 0 0") + shape_node(4, 0) + shape_node(5, 1)
        (self.folder / "over.vox").write_bytes(magica(shape, one, over))
        self.assertEqual(self.digest(volume("over.vox", "at = [1, 1, 1]\nfilled = [2, 2]\n")), self.digest(of_shapes([((1, 1, 2), (2, 2, 3))])))

    # All 48 turns and mirrors of a body of 5 x 4 x 3, against a second, plain way: middles as fractions, by a matrix.
    def test_all_turns(self):
        import itertools
        import math
        body = [(0, 0, 0), (4, 0, 0), (0, 3, 0), (0, 0, 2), (4, 3, 0), (1, 0, 0)]
        sides = (5, 4, 3)
        for order in itertools.permutations(range(3)):
            for signs in itertools.product((1, -1), repeat=3):
                bits = order[0] | order[1] << 2 | sum((sign < 0) << 4 + row for row, sign in enumerate(signs))
                (self.folder / "t.vox").write_bytes(magica(model(sides, [(*v, 1) for v in body]), turn_node(0, 1, _r=str(bits), _t="9 -8 7") + shape_node(1, 0)))
                cells = []
                for voxel in body:
                    middle = [v + 0.5 - side // 2 for v, side in zip(voxel, sides)]
                    x, y, z = (math.floor(sign * middle[axis] + move) for sign, axis, move in zip(signs, order, (9, -8, 7)))
                    cells.append((x, z, -1 - y))
                self.boxes("t.vox", *cells)

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
        unu("save", "-f", "nrrd", "-e", "ascii", "-i", "a.nrrd", "-o", "text.nrrd")
        self.same("text.nrrd")
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
        self.assertIn('shape = "volume"', (self.folder / "out/a.npy/scene.toml").read_text())

    # Voxels are filled or not and a mesh fills parts of cells, so they differ by little: at the beginning, and in what melts.
    def test_the_cup_is_that_of_the_mesh(self):
        numbers = []
        for name in ("cup.vox", "cup.obj"):
            result = voxmelt("digest", Path(__file__).resolve().parents[1] / "data" / name, "--steps", 50, "--every", 50)
            self.assertEqual(result.returncode, 0, result.stderr)
            first, last = (dict(zip(*2 * [iter(line.split())])) for line in result.stdout.splitlines())
            numbers.append([int(first["mass"]), int(last["liquid"]), int(last["solid"])])
        for vox, mesh, delta in zip(*numbers, (0.001, 0.01, 0.03)):
            self.assertAlmostEqual(vox / mesh, 1, delta=delta)

    def test_bad_files(self):
        bad_files.check(self, BAD, volume)


unittest.main(argv=["volumes_test"])
