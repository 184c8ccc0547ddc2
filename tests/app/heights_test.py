#!/usr/bin/env python3
"""Height fields as PNG, against ESRI ASCII grids of the same numbers; and such grids as GDAL writes them.

  heights_test.py VOXMELT

The PNG files are written here, by the specification, and by Pillow and GDAL where these are installed. What is no picture of
heights gets exit code 2 and one line that names its place, soon and with little memory.
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

WIDTH, HEIGHT = 11, 7
HEIGHTS = [[(37 * x * x + 101 * y * y + 13 * x * y) % 5000 for x in range(WIDTH)] for y in range(HEIGHT)]
GDAL = shutil.which("gdal_translate")
PILLOW = next((python for python in (sys.executable, "/usr/bin/python3")
               if subprocess.run([python, "-c", "import PIL.PngImagePlugin"], capture_output=True).returncode == 0), None)


def scene(file, scale=0.002):
    return ("[grid]\nsize = [22, 24, 14]\n[[inert]]\nshape = \"heightfield\"\n"
            f'file = "{file}"\nvertical_scale = {scale}\n[[vent]]\nat = [4, 20, 4]\nradius = 1\nrate = 0.1\n')


def grid(heights, header="", gap=" "):
    """An ESRI ASCII grid. None stands for no data."""
    head = header or f"ncols {len(heights[0])}\nnrows {len(heights)}\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -7\n"
    return head + "".join(gap.join("-7" if h is None else str(h) for h in row) + "\n" for row in heights)


def chunk(name, content):
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


def png(heights=HEIGHTS, depth=16, color=0, interlaced=False, more=b"", rows=None):
    """A PNG by the specification. A height is (height, alpha) in a picture with alpha."""
    def packed(row):
        numbers = [n for height in row for n in (height if isinstance(height, tuple) else (height,))]
        if depth == 16:
            return b"\0" + struct.pack(f">{len(numbers)}H", *numbers)
        bits = "".join(format(n, f"0{depth}b") for n in numbers)
        bits += "0" * (-len(bits) % 8)
        return b"\0" + bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8))
    if rows is None:
        rows = b""
        # the seven passes of Adam7: first column and row, and the steps from there on
        for x, y, across, down in ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)) if interlaced else ((0, 0, 1, 1),):
            rows += b"".join(packed(row[x::across]) for row in heights[y::down] if row[x::across])
    header = struct.pack(">IIBBBBB", len(heights[0]), len(heights), depth, color, 0, 0, int(interlaced))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + more + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def sized(width, height):
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes(100))) + chunk(b"IEND", b""))


SMALLER = [[h % 200 for h in row] for row in HEIGHTS]
BAD = {
    "empty.png": (b"", "no PNG picture: it is truncated"),
    "text.png": (grid(HEIGHTS).encode(), "no PNG picture: Not a PNG file"),
    "cut.png": (png()[:-40], "no PNG picture: it is truncated"),
    "head.png": (png()[:20], "no PNG picture: it is truncated"),
    "sum.png": (png()[:30] + b"?" + png()[31:], "no PNG picture: IHDR: CRC error"),
    "short.png": (png(rows=b"\0" * 50), "no PNG picture: Not enough image data"),
    "damaged.png": (png().replace(b"x\x9c", b"x\x9d"), "no PNG picture: "),
    "colors.png": (png([[(1, 2, 3)] * 3] * 3, depth=8, color=2), "a picture of heights is grey, and this one has colours"),
    "palette.png": (png([[0, 1], [1, 0]], depth=8, color=3, more=chunk(b"PLTE", bytes(6))), "has colours"),
    "narrow.png": (png([[1], [2]]), "a side of 1 pixels is outside 2..8192"),
    "wide.png": (sized(8193, 2), "a side of 8193 pixels is outside 2..8192"),
    "huge.png": (sized(2**31 - 1, 2**31 - 1), "no PNG picture: "),
    "bomb.png": (sized(8192, 8192), "it is too short for its pixels: is it truncated?"),
    "nothing.png": (png([[5, 5], [5, 5]], more=chunk(b"tRNS", b"\0\5")), "every pixel is without data"),
    "pointer.png": (b"version https://git-lfs.github.com/spec/v1\n", "no PNG picture: Not a PNG file"),
    "a.asc": (b"II*\0\x08\0\0\0", "this is a TIFF; call it .tif"),
    "b.asc": (b"MM\0*\0\0\0\x08", "this is a TIFF; call it .tif"),
    "png.asc": (png(), "this is a PNG; call it .png"),
}


class Heights(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def digest(self, name, content, scale=0.002):
        if content is not None:
            (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        result = voxmelt("digest", write(self.folder, scene(name, scale)), "--steps", 0)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout, result.stderr

    def test_numbers_are_elevations(self):
        wanted = self.digest("a.asc", grid(HEIGHTS))
        self.assertEqual(wanted[1], "")
        higher = self.digest("b.asc", grid([[h + (h == 0) * 900 for h in row] for row in HEIGHTS]))
        self.assertNotEqual(wanted, higher, "the test would prove nothing")
        for name, content in {"plain": png(), "interlaced": png(interlaced=True), "gamma": png(more=chunk(b"gAMA", struct.pack(">I", 45455))),
                              "srgb": png(more=chunk(b"sRGB", b"\0")), "alpha": png([[(h, 65535) for h in row] for row in HEIGHTS], color=4),
                              "UPPER": png()}.items():
            with self.subTest(name):
                self.assertEqual(self.digest(name + (".PNG" if name == "UPPER" else ".png"), content), wanted)

    def test_fewer_bits(self):
        for depth in (1, 2, 4, 8):
            heights = [[h % (1 << depth) for h in row] for row in HEIGHTS]
            scale = 16 / (1 << depth)
            wanted = self.digest("a.asc", grid(heights), scale)
            for interlaced in (False, True):
                self.assertEqual(self.digest("b.png", png(heights, depth=depth, interlaced=interlaced), scale), wanted, depth)

    def test_what_is_transparent_is_no_data(self):
        holes = [[None if (x + y) % 5 == 0 else h for x, h in enumerate(row)] for y, row in enumerate(SMALLER)]
        wanted = self.digest("a.asc", grid(holes), 0.05)
        self.assertRegex(wanted[1], r"a\.asc: 1[0-9] cells without data take the lowest elevation")
        for name, content in {"mark": png([[250 if h is None else h for h in row] for row in holes], depth=8, more=chunk(b"tRNS", struct.pack(">H", 250))),
                              "wide": png([[65000 if h is None else h for h in row] for row in holes], more=chunk(b"tRNS", struct.pack(">H", 65000))),
                              "alpha": png([[(9, 0) if h is None else (h, 1) for h in row] for row in holes], depth=8, color=4),
                              "alphas": png([[(60000, 0) if h is None else (h, 1) for h in row] for row in holes], color=4)}.items():
            with self.subTest(name):
                digest, said = self.digest(name + ".png", content, 0.05)
                self.assertEqual((digest, said.replace(name + ".png", "a.asc")), wanted)

    # The same grid in all the words that programs have for it.
    def test_words_of_grids(self):
        wanted = self.digest("a.asc", grid(HEIGHTS))
        size = f"ncols {WIDTH}\nnrows {HEIGHT}\n"
        for header, more in ((size + "xllcenter 3.5\nyllcenter -1e3\ncellsize 1\nNODATA_value -7\n", {}),
                             (size + "xllcorner 1.5e+05\nyllcorner 0\ndx 2\ndy 2\nNODATA_value -7\n", {}),
                             (size.upper() + "XLLCORNER 0\nYLLCORNER 0\nCELLSIZE 1.0000000000\nNODATA_VALUE -3.4028234663852886e+38\n", {}),
                             (size + "xllcorner 0\nyllcorner 0\ncellsize 30\nNODATA_value nan\n", {}),
                             (size + "cellsize 1\nNODATA_value  1e400\n", {}), (size, {"gap": "\t"}), (size, {"gap": "\n"})):
            with self.subTest(header):
                self.assertEqual(self.digest("b.asc", grid(HEIGHTS, header, **more)), wanted)
        exponents = [[f"{h / 1000:.6e}" if h % 2 else f"{h}E-3" for h in row] for row in HEIGHTS]
        self.assertEqual(self.digest("c.asc", grid(exponents), 2), wanted)
        lowest = min(h for row in HEIGHTS for h in row if h)
        filled = self.digest("d.asc", grid([[h or lowest for h in row] for row in HEIGHTS]))[0]
        for word in ("nan", "NaN", "-nan", "-7", "-7.0", "-7e0", "-0.7e1"):
            text = grid(HEIGHTS).replace("\n0 ", f"\n{word} ", 1)
            digest, said = self.digest("d.asc", text)
            self.assertEqual((digest, "1 cells without data take the lowest elevation" in said), (filled, True), word)

    @unittest.skipUnless(PILLOW, "no Pillow here: apt-get install python3-pil")
    def test_what_pillow_writes(self):
        code = ("import sys, struct; from PIL import Image; w, h, *n = map(int, sys.argv[1:])\n"
                "Image.frombytes('I;16', (w, h), struct.pack(f'<{w * h}H', *n)).save('wide.png')\n"
                "Image.frombytes('L', (w, h), bytes(v % 200 for v in n)).save('bytes.png')")
        subprocess.run([PILLOW, "-c", code, *map(str, [WIDTH, HEIGHT] + sum(HEIGHTS, []))], cwd=self.folder, check=True)
        self.assertEqual(self.digest("wide.png", None), self.digest("a.asc", grid(HEIGHTS)))
        self.assertEqual(self.digest("bytes.png", None, 0.05), self.digest("b.asc", grid(SMALLER), 0.05))

    @unittest.skipUnless(GDAL, "no GDAL here: apt-get install gdal-bin")
    def test_what_gdal_writes(self):
        def gdal(*arguments):
            subprocess.run([GDAL, "-q", *arguments], cwd=self.folder, check=True, capture_output=True)
        holes = [[None if (x + y) % 5 == 0 else h for x, h in enumerate(row)] for y, row in enumerate(HEIGHTS)]
        for heights in (HEIGHTS, holes):
            wanted = self.digest("a.asc", grid(heights).replace("-7", "64999"))[0]
            gdal("-of", "PNG", "-ot", "UInt16", "a.asc", "a.png")
            self.assertEqual(self.digest("a.png", None)[0], wanted)
            gdal("-of", "GTiff", "-ot", "Float64", "-a_ullr", "0", "14", "11", "0", "a.asc", "a.tif")
            for i, options in enumerate(((), ("-co", "FORCE_CELLSIZE=YES"), ("-co", "DECIMAL_PRECISION=3"), ("-co", "SIGNIFICANT_DIGITS=9"),
                                         ("-a_nodata", "-3.4028234663852886e+38"), ("-a_nodata", "nan"))):
                gdal("-of", "AAIGrid", *options, "a.tif", f"{i}.asc")
                if "-a_nodata" in options and heights is holes:
                    continue  # it names another number than it writes
                self.assertEqual(self.digest(f"{i}.asc", None)[0], wanted, (options, (self.folder / f"{i}.asc").read_text()[:300]))

    # The ground is as wide as 128 cells. A peak in the plain is the middle of 25 heights that the filter and the spline
    # weigh, and its own weight is (5/12)^2 there: 17.4 of 100. A cell is 100/48 high, so it stands 8.3 cells above the base.
    def test_heights_without_a_scene(self):
        peak = [[{(7, 2): 100, (0, 6): 100}.get((x, y), 0) for x in range(WIDTH)] for y in range(HEIGHT)]
        (self.folder / "a b.asc").write_text(grid(peak))
        first = voxmelt("run", "a b.asc", "--steps", 3, "--size", "32x32", cwd=self.folder)
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertEqual([line for line in first.stderr.splitlines() if "assumed" in line], [
            "assumed: the 11 x 7 heights of a b.asc are the ground of a grid of 128 x 66 x 81 cells, 0.48 to their unit: 0 to 100 is 48 cells high",
            "assumed: lava of temperature 0.95 comes from [87, 11, 28], the highest place, until step 700",
            "assumed: it cools in air of temperature 0, and leaves at the edge; 900 steps"])
        self.assertIn("scene          out/a b.asc/scene.toml; change it", first.stdout)
        scene_file = self.folder / "out/a b.asc/scene.toml"
        digests = [voxmelt("digest", name, "--steps", 3, cwd=self.folder).stdout for name in ("a b.asc", scene_file)]
        self.assertEqual(*digests)
        self.assertRegex(digests[0], r"liquid [1-9]")
        # A map that is twice as deep as wide, of elevations below 0; one that is long; one that is flat.
        for name, text, said in (
                ("deep.asc", grid([[h - 1000 for h in row] for row in peak], f"ncols {WIDTH}\nnrows {HEIGHT}\ndx 7\ndy 22\nNODATA_value -7\n"),
                 "of a grid of 64 x 66 x 128 cells, 0.48 to their unit: -1000 to -900 is 48 cells high"),
                ("long.asc", grid([[3, 1] + [2] * 98, [4] * 100]), "of a grid of 128 x 66 x 16 cells, 16 to their unit: 1 to 4 is 48"),
                ("flat.asc", grid([[5] * 4] * 4), "of a grid of 128 x 66 x 128 cells, 1 to their unit: 5 to 5 is 0 cells high")):
            (self.folder / name).write_text(text)
            result = voxmelt("digest", name, "--steps", 1, cwd=self.folder)
            self.assertEqual((result.returncode, said in result.stderr), (0, True), result.stderr)

    def test_each_format_without_a_scene(self):
        (self.folder / "a.asc").write_text(grid(HEIGHTS))
        (self.folder / "a.PNG").write_bytes(png())
        lines = [voxmelt("digest", name, "--steps", 2, cwd=self.folder) for name in ("a.asc", "a.PNG")]
        self.assertEqual([line.returncode for line in lines], [0, 0])
        self.assertEqual(lines[0].stdout, lines[1].stdout)
        self.assertEqual(lines[0].stderr.replace("a.asc", "a.PNG"), lines[1].stderr)

    def test_heights_that_are_none(self):
        for name, content, expected in (("cut.png", BAD["cut.png"][0], "no PNG picture: it is truncated"),
                                        ("colors.png", BAD["colors.png"][0], "a picture of heights is grey, and this one has colours"),
                                        ("words.asc", b"a map\n", ":1: unknown header 'a'"), ("gone.asc", None, "cannot read gone.asc: No such file")):
            with self.subTest(name):
                if content is not None:
                    (self.folder / name).write_bytes(content)
                result = voxmelt("run", name, cwd=self.folder)
                self.assertEqual(result.returncode, 2)
                self.assertRegex(result.stderr, rf"\A{name}: error: [^\n]*\n\Z")
                self.assertIn(expected, result.stderr)
                self.assertFalse((self.folder / "out").exists())

    def test_bad_files(self):
        bad_files.check(self, BAD, scene)


unittest.main(argv=["heights_test"])
