#!/usr/bin/env python3
"""GeoTIFF height fields, against ESRI ASCII grids of the same numbers.

  geotiff_test.py VOXMELT

Files are written here, by the specification, and by GDAL and Pillow where these are installed. GDAL reads those that are
written here, too. What is no height field gets exit code 2 and one line that names its place, soon and with little memory.
"""
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import bad_files
from program import voxmelt, write

WIDTH, HEIGHT = 37, 21
HEIGHTS = [[(37 * x * x + 101 * y * y + 13 * x * y) % 120 for x in range(WIDTH)] for y in range(HEIGHT)]
HOLES = [[None if (x + y) % 5 == 0 else h for x, h in enumerate(row)] for y, row in enumerate(HEIGHTS)]
GDAL = shutil.which("gdal_translate")
PILLOW = next((python for python in (sys.executable, "/usr/bin/python3")
               if subprocess.run([python, "-c", "import PIL.TiffImagePlugin"], capture_output=True).returncode == 0), None)
BUILT_IN = "libtiff: built in" in voxmelt("--version").stdout
# Codes of the specification: types of tags, and of numbers.
SHORT, LONG, DOUBLE, ASCII, LONG8 = 3, 4, 12, 2, 16
UNSIGNED, SIGNED, REAL = 1, 2, 3
LETTERS = {(UNSIGNED, 8): "B", (UNSIGNED, 16): "H", (UNSIGNED, 32): "I", (UNSIGNED, 64): "Q", (SIGNED, 8): "b", (SIGNED, 16): "h",
           (SIGNED, 32): "i", (SIGNED, 64): "q", (REAL, 32): "f", (REAL, 64): "d"}


def scene(file, scale=0.15):
    """No filter, and a cell for each height: one that is off by 7 is seen."""
    return (f"[grid]\nsize = [{WIDTH}, 24, {HEIGHT}]\n[[inert]]\nshape = \"heightfield\"\n"
            f'file = "{file}"\nsmooth = 0\nvertical_scale = {scale}\n[[vent]]\nat = [4, 23, 4]\nradius = 1\nrate = 0.1\n')


def grid(heights, header=""):
    """An ESRI ASCII grid. None stands for no data."""
    head = f"ncols {len(heights[0])}\nnrows {len(heights)}\nxllcorner 0\nyllcorner 0\n{header or 'cellsize 1'}\nNODATA_value -7\n"
    return head + "".join(" ".join("-7" if h is None else str(h) for h in row) + "\n" for row in heights)


def tiff(heights=HEIGHTS, kind=SIGNED, bits=16, order="<", rows=8, tile=None, zipped=False, big=False, tags=None, hole=-7, parts=None):
    """A TIFF by the specification: strips of so many rows, or square tiles."""
    letter = LETTERS[kind, bits]
    heights = [[hole if h is None else h for h in row] for row in heights]
    width, height = len(heights[0]), len(heights)

    def packed(part):
        data = b"".join(struct.pack(f"{order}{len(row)}{letter}", *row) for row in part)
        return zlib.compress(data) if zipped else data
    if parts is None and tile:
        parts = [packed([[(heights[y][x] if y < height and x < width else 99) for x in range(left, left + tile)] for y in range(top, top + tile)])
                 for top in range(0, height, tile) for left in range(0, width, tile)]
    elif parts is None:
        parts = [packed(heights[top:top + rows]) for top in range(0, height, rows)]
    place = LONG8 if big else LONG
    all_tags = {256: (LONG, [width]), 257: (LONG, [height]), 258: (SHORT, [bits]), 259: (SHORT, [8 if zipped else 1]), 262: (SHORT, [1]),
                277: (SHORT, [1]), 339: (SHORT, [kind])}
    if tile:
        all_tags |= {322: (LONG, [tile]), 323: (LONG, [tile]), 324: (place, []), 325: (LONG, [len(p) for p in parts])}
    else:
        all_tags |= {273: (place, []), 278: (LONG, [rows]), 279: (LONG, [len(p) for p in parts])}
    all_tags |= tags or {}
    head, at = (16 if big else 8), []
    for part in parts:
        at.append(head + sum(map(len, parts[:len(at)])) if part else 0)
    all_tags[324 if tile else 273] = (place, at)
    if tags:
        all_tags |= {number: value for number, value in tags.items()}
    return head_of(order, big, head + sum(map(len, parts))) + b"".join(parts) + folder_of(order, big, head + sum(map(len, parts)), all_tags)


def head_of(order, big, folder):
    mark = b"II" if order == "<" else b"MM"
    return mark + (struct.pack(order + "HHHQ", 43, 8, 0, folder) if big else struct.pack(order + "HI", 42, folder))


def folder_of(order, big, begin, tags):
    """The tags, and behind them the values that are too large to stand in the table."""
    letters = {SHORT: "H", LONG: "I", DOUBLE: "d", LONG8: "Q"}
    entry, inline = (20, 8) if big else (12, 4)
    behind, table = begin + (16 if big else 6) + entry * len(tags), b""
    values = b""
    for number, (type_, value) in sorted(tags.items()):
        data = value if type_ == ASCII else struct.pack(f"{order}{len(value)}{letters[type_]}", *value)
        field = data.ljust(inline, b"\0")
        if len(data) > inline:
            field = struct.pack(order + ("Q" if big else "I"), behind + len(values))
            values += data + bytes(len(data) % 2)
        table += struct.pack(order + ("HHQ" if big else "HHI"), number, type_, len(value)) + field
    return struct.pack(order + ("Q" if big else "H"), len(tags)) + table + bytes(inline) + values


NO_DATA = {42113: (ASCII, b"-7\0")}
LAZY = {257: (LONG, [8192]), 256: (LONG, [8192]), 278: (LONG, [8192])}
BAD = {
    "empty.tif": (b"", "no TIFF: "),
    "text.tif": (grid(HEIGHTS), "no TIFF: Not a TIFF"),
    "head.tif": (tiff()[:6], "no TIFF: "),
    "cut.tif": (tiff()[:-100], "no TIFF: "),
    "folder.tif": (head_of("<", False, 4000) + bytes(100), "no TIFF: "),
    "png.tif": (b"\x89PNG\r\n\x1a\n" + bytes(40), "no TIFF: Not a TIFF"),
    "bands.tif": (tiff(tags={277: (SHORT, [3]), 262: (SHORT, [2])}), "it has 3 bands, and heights are one"),
    "palette.tif": (tiff(kind=UNSIGNED, bits=8, tags={262: (SHORT, [3]), 320: (SHORT, [0] * 768)}), "heights are grey, and this one has colours"),
    "narrow.tif": (tiff([[1], [2]]), "a side of 1 cells is outside 2..8192"),
    "wide.tif": (tiff(tags={256: (LONG, [8193])}), "a side of 8193 cells is outside 2..8192"),
    "huge.tif": (tiff(tags={256: (LONG, [2**31]), 257: (LONG, [2**31])}), "tif: "),
    "bomb.tif": (tiff(tags=LAZY), "tif: "),
    "zipped_bomb.tif": (tiff(zipped=True, tags=LAZY), "it is too short for its cells: is it truncated?"),
    "tile_bomb.tif": (tiff(tile=16, zipped=True, tags={322: (LONG, [8192]), 323: (LONG, [8192])}), "tif: "),
    "wide_tile.tif": (tiff(tile=16, tags={322: (LONG, [2**20])}), "tif: "),
    "counts.tif": (tiff(zipped=True, tags={279: (LONG, [2**31] * 3)}), "tif: "),
    "damaged.tif": (tiff(zipped=True).replace(b"x\x9c", b"y\x9d"), "its data are damaged: "),
    "short.tif": (tiff(zipped=True, parts=[zlib.compress(bytes(30))] * 3), "its data are damaged: "),
    "jpeg.tif": (tiff(kind=UNSIGNED, bits=8, tags={259: (SHORT, [7])}), "its compression 7 is not read"),
    "lerc.tif": (tiff(tags={259: (SHORT, [34887])}), "its compression 34887 is not read"),
    "unknown.tif": (tiff(tags={259: (SHORT, [4321])}), "its compression 4321 is not read"),
    "bits.tif": (tiff(tags={258: (SHORT, [12])}), "numbers of 12 bits are not read"),
    "half.tif": (tiff(tags={339: (SHORT, [REAL])}), "numbers of 16 bits, floating-point, are not read"),
    "complex.tif": (tiff(kind=REAL, bits=64, tags={339: (SHORT, [6])}), "numbers of 64 bits, complex or of no known kind, are not read"),
    "high.tif": (tiff([[1.5, 2e9], [3, 4]], REAL, 32), "2e+09 in column 1, row 0 is no elevation; where it means that there is none"),
    "infinite.tif": (tiff([[1, 2], [float("-inf"), 4]], REAL, 64), "-inf in column 0, row 1 is no elevation"),
    "nothing.tif": (tiff([[-7, -7], [-7, -7]], tags=NO_DATA), "every cell is without data"),
    "nans.tif": (tiff([[float("nan")] * 2] * 2, REAL, 32), "every cell is without data"),
    "word.tif": (tiff(tags={42113: (ASCII, b"none\0")}), "its no-data tag has 'none', which is no number"),
    "size.tif": (tiff(tags={33550: (DOUBLE, [0.0, 1.0, 0.0])}), "cells of 0 x 1 are no size"),
    "endless.tif": (tiff(tags={33550: (DOUBLE, [1.0, float("inf"), 0.0])}), "cells of 1 x inf are no size"),
    "turned.tif": (tiff(tags={34264: (DOUBLE, [1.0, 0.5, 0, 0, 0.5, -1.0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.0])}), "its map is turned"),
    "tiff.asc": (tiff(), "this is a TIFF; call it .tif"),
    "pointer.tif": (b"version https://git-lfs.github.com/spec/v1\n", "no TIFF: Not a TIFF"),
}


class InFolder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def digest(self, name, content):
        if content is not None:
            (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        result = voxmelt("digest", write(self.folder, scene(name)), "--steps", 0)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout, result.stderr.replace(name, "NAME")


@unittest.skipUnless(BUILT_IN, "built without libtiff: apt-get install libtiff-dev")
class GeoTiff(InFolder):
    def test_numbers_are_elevations(self):
        wanted = self.digest("a.asc", grid(HEIGHTS))
        self.assertEqual(wanted[1], "")
        for y, x in ((0, 0), (0, WIDTH - 1), (HEIGHT - 1, 0), (HEIGHT - 1, WIDTH - 1), (9, 17)):
            other = [list(row) for row in HEIGHTS]
            other[y][x] = (other[y][x] + 60) % 120
            self.assertNotEqual(self.digest("b.asc", grid(other)), wanted, "the test would prove nothing")
        for kind, bits in LETTERS:
            for options in ({}, {"order": ">"}, {"tile": 16}, {"tile": 16, "order": ">", "zipped": True}, {"zipped": True, "big": True},
                            {"rows": HEIGHT}, {"rows": 1, "order": ">", "big": True}):
                with self.subTest(f"{kind} {bits} {options}"):
                    self.assertEqual(self.digest("b.tif", tiff(kind=kind, bits=bits, **options)), wanted)
        self.assertEqual(self.digest("c.TIFF", tiff()), wanted)

    def test_signs_and_decimals(self):
        heights = [[(h - 60) * 1.25 for h in row] for row in HEIGHTS]
        heights[3][4] = heights[5][6] = -60.0
        wanted = self.digest("a.asc", grid(heights))
        for bits in (32, 64):
            self.assertEqual(self.digest("b.tif", tiff(heights, REAL, bits)), wanted)
        below = [[h - 60 for h in row] for row in HEIGHTS]
        wanted = self.digest("c.asc", grid(HEIGHTS))  # the lowest point stands at the base
        for bits in (8, 16, 32, 64):
            self.assertEqual(self.digest("d.tif", tiff(below, SIGNED, bits)), wanted)

    def test_no_data(self):
        wanted = self.digest("a.asc", grid(HOLES))
        self.assertRegex(wanted[1], r"NAME: 15\d cells without data take the lowest elevation")
        lowest = -3.4028234663852886e38
        for name, content in {"short": tiff(HOLES, tags=NO_DATA), "blanks": tiff(HOLES, tags={42113: (ASCII, b" -7.0 \0")}),
                              "tiles": tiff(HOLES, REAL, 64, tile=16, tags=NO_DATA),
                              "nan": tiff(HOLES, REAL, 32, hole=float("nan"), tags={42113: (ASCII, b"nan\0")}),
                              "untold": tiff(HOLES, REAL, 32, hole=float("nan")),
                              "float": tiff(HOLES, REAL, 32, hole=lowest, tags={42113: (ASCII, b"-3.4028234663852886e+38\0")}),
                              "digits": tiff(HOLES, REAL, 32, hole=-1e9 / 3, tags={42113: (ASCII, b"-333333333.33\0")}),
                              "large": tiff(HOLES, UNSIGNED, 32, hole=2**32 - 1, tags={42113: (ASCII, b"4294967295\0")})}.items():
            with self.subTest(name):
                self.assertEqual(self.digest(name + ".tif", content), wanted)
        self.assertEqual(self.digest("usual.tif", tiff(HOLES, hole=-9999))[0], wanted[0])
        self.assertIn("(-9999; no NODATA_value is named)", self.digest("usual.tif", None)[1])

    def test_parts_that_are_left_out(self):
        lower = [[0 if y >= 16 else h for h in row] for y, row in enumerate(HEIGHTS)]
        strips = [struct.pack(f"<{8 * WIDTH}h", *sum(HEIGHTS[top:top + 8], [])) for top in (0, 8)] + [b""]
        self.assertEqual(self.digest("a.tif", tiff(parts=strips)), self.digest("a.asc", grid(lower)))
        holes = [[None if y >= 16 else h for h in row] for y, row in enumerate(HEIGHTS)]
        self.assertEqual(self.digest("b.tif", tiff(parts=strips, tags=NO_DATA)), self.digest("b.asc", grid(holes)))

    def test_sizes_of_cells(self):
        for tags, header in (({33550: (DOUBLE, [3.0, 1.0, 0.0])}, "dx 3\ndy 1"), ({33550: (DOUBLE, [1.0, 4.0, 0.0])}, "dx 1\ndy 4"),
                             ({34264: (DOUBLE, [5.0, 0, 0, 7, 0, -1.0, 0, 7, 0, 0, 0, 0, 0, 0, 0, 1])}, "dx 5\ndy 1")):
            wanted = self.digest("a.asc", grid(HEIGHTS, header))
            self.assertIn("is stretched over", wanted[1])
            self.assertEqual(self.digest("b.tif", tiff(tags=tags)), wanted)
        turned_over = {34264: (DOUBLE, [1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1])}
        self.assertEqual(self.digest("c.tif", tiff(HEIGHTS[::-1], tags=turned_over)), self.digest("c.asc", grid(HEIGHTS)))
        # Of another type the tag means nothing, and is no address.
        self.assertEqual(self.digest("d.tif", tiff(tags={33550: (SHORT, [3, 1, 0]), 42113: (DOUBLE, [5.0])})), self.digest("d.asc", grid(HEIGHTS)))

    @unittest.skipUnless(GDAL, "no GDAL here: apt-get install gdal-bin")
    def test_what_gdal_writes(self):
        for heights in (HEIGHTS, HOLES):
            wanted = self.digest("a.asc", grid(heights))
            for number, options in enumerate((
                    ("-ot", "Int16"), ("-ot", "Float32"), ("-ot", "Float64", "-co", "COMPRESS=LZW"), ("-ot", "Int32", "-co", "COMPRESS=PACKBITS"),
                    ("-ot", "Int16", "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=2"), ("-ot", "Float32", "-co", "COMPRESS=ZSTD", "-co", "PREDICTOR=3"),
                    ("-ot", "Float32", "-co", "COMPRESS=LZW", "-co", "ENDIANNESS=BIG"), ("-ot", "Int16", "-co", "COMPRESS=LZMA"),
                    ("-ot", "Float32", "-co", "TILED=YES", "-co", "BLOCKXSIZE=16", "-co", "BLOCKYSIZE=32", "-co", "BIGTIFF=YES"),
                    ("-ot", "Float32", "-a_nodata", "-3.4028234663852886e+38") if heights is HEIGHTS else ("-ot", "Float64"))):
                with self.subTest(options):
                    subprocess.run([GDAL, "-q", "-of", "GTiff", *options, "a.asc", f"{number}.tif"], cwd=self.folder, check=True, capture_output=True)
                    self.assertEqual(self.digest(f"{number}.tif", None), wanted)

    @unittest.skipUnless(GDAL, "no GDAL here: apt-get install gdal-bin")
    def test_gdal_reads_the_same(self):
        for number, options in enumerate(({}, {"kind": REAL, "bits": 32, "order": ">"}, {"kind": REAL, "bits": 64, "tile": 16, "zipped": True},
                                          {"kind": UNSIGNED, "bits": 32, "big": True}, {"heights": HOLES, "tags": NO_DATA})):
            with self.subTest(options):
                # Without a place GDAL takes the first row for the southern one.
                tags = {**options.pop("tags", {}), 33550: (DOUBLE, [1.0, 1.0, 0.0]), 33922: (DOUBLE, [0.0, 0, 0, 0, HEIGHT, 0])}
                mine = self.digest(f"{number}.tif", tiff(tags=tags, **options))
                subprocess.run([GDAL, "-q", "-of", "AAIGrid", f"{number}.tif", f"{number}.asc"], cwd=self.folder, check=True, capture_output=True)
                self.assertEqual(self.digest(f"{number}.asc", None), mine)

    @unittest.skipUnless(PILLOW, "no Pillow here: apt-get install python3-pil")
    def test_what_pillow_writes(self):
        code = ("import sys, struct; from PIL import Image; w, h, *n = map(int, sys.argv[1:])\n"
                "Image.frombytes('I;16', (w, h), struct.pack(f'<{w * h}H', *n)).save('0.tif')\n"
                "Image.frombytes('L', (w, h), bytes(n)).save('1.tif', compression='tiff_lzw')\n"
                "Image.frombytes('F', (w, h), struct.pack(f'={w * h}f', *n)).save('2.tif', compression='tiff_adobe_deflate')")
        subprocess.run([PILLOW, "-c", code, *map(str, [WIDTH, HEIGHT] + sum(HEIGHTS, []))], cwd=self.folder, check=True)
        wanted = self.digest("a.asc", grid(HEIGHTS))
        for number in range(3):
            self.assertEqual(self.digest(f"{number}.tif", None), wanted)

    def test_a_map_without_a_scene(self):
        (self.folder / "a.asc").write_text(grid(HEIGHTS))
        for name, content in (("a.tif", tiff()), ("b.TIFF", tiff(kind=REAL, bits=32, tile=16, zipped=True))):
            (self.folder / name).write_bytes(content)
            lines = [voxmelt("digest", file, "--steps", 2, cwd=self.folder) for file in ("a.asc", name)]
            self.assertEqual([line.returncode for line in lines], [0, 0], lines[1].stderr)
            self.assertEqual(lines[0].stdout, lines[1].stdout)
            self.assertEqual(lines[0].stderr.replace("a.asc", name), lines[1].stderr)

    def test_bad_files(self):
        bad_files.check(self, BAD, scene)


@unittest.skipIf(BUILT_IN, "this build has libtiff")
class Without(InFolder):
    def test_the_command_that_brings_it_is_said(self):
        bad_files.check(self, {"a.tif": (tiff(), "this build has no libtiff: apt-get install libtiff-dev, then configure and build again")}, scene)
        alone = voxmelt("run", "a.tif", cwd=self.folder)
        self.assertEqual((alone.returncode, alone.stderr.count("\n")), (2, 1))
        self.assertIn("a.tif: error: a.tif: this build has no libtiff: apt-get install libtiff-dev", alone.stderr)


if __name__ == "__main__":
    unittest.main(argv=["geotiff_test"])
