#!/usr/bin/env python3
"""The worked pixel of docs/picture/trace.md: the page, the plain program, the trace and the judge agree, number by number.

  worked_pixel_test.py ROOT VOXMELT JUDGE
"""
import re
import struct
import subprocess
import sys
import tempfile
import tomllib
import unittest
from itertools import product
from pathlib import Path

from plain_pixel import Pixel

ROOT, VOXMELT, JUDGE = map(Path, sys.argv[1:4])
PAGE = (ROOT / "docs/picture/trace.md").read_text()


def worked(page):
    """The scene of a page, its pixel, and the rows of its tables: stage, name, numbers as they are written."""
    section = page[page.index("\n## 4"):]
    place = re.search(r"`--setting fast --trace (\d+),(\d+)`", section)
    rows = [tuple(cell.strip() for cell in line.strip("|").split("|")) for line in section.splitlines()
            if line.startswith("|") and not line.startswith("|---") and line != "| stage | name | numbers |"]
    return re.search(r"```toml\n(.*?)```", section, re.S)[1], (int(place[1]), int(place[2])), rows


def traced(text, place):
    """The rows that the program prints."""
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "worked.toml"
        scene.write_text(text)
        lines = subprocess.run([VOXMELT, "render", scene, "--setting", "fast", "--trace", ",".join(map(str, place))],
                               check=True, capture_output=True, text=True).stdout.splitlines()
    return [(line[:10].strip(), line[10:30].strip(), line[30:].strip()) for line in lines]


def computed(text, place):
    return [(stage, name, " ".join(map(str, numbers))) for stage, name, numbers in Pixel(tomllib.loads(text), *place).all_rows()]


def judged(text, place):
    """The pixel's bytes in the judge's picture."""
    scene = tomllib.loads(text)
    look, light, camera, (x, y, z) = scene["look"], scene["light"], scene["camera"], scene["grid"]["size"]

    def cell_in(shapes, cell):
        return any(all(abs(c + 0.5 - a) < s / 2 for c, a, s in zip(cell, shape["at"], shape["size"])) for shape in shapes)
    cells = [(i, j, k) for k, j, i in product(range(z), range(y), range(x))]
    masks = [1 if cell_in(scene["solid"], c) else 2 if cell_in(scene["liquid"], c) else 0 for c in cells]
    numbers = {"grid": [x, y, z], "smooth": [look["smooth"], look["smooth_solid"]], "solid": look["solid"],
               "liquid": look["liquid"], "ground": look["ground"], "background": look["background"],
               "shininess": [look["shininess"]], "specular": [look["specular"]], "metallic": [look["metallic"]],
               "glow": [0, 0.3, 0.95], "light": [*light["direction"], light["ambient"]],
               "camera": [*camera["target"], camera["azimuth"], camera["elevation"], camera["distance"],
                          camera["field_of_view"], camera["width"], camera["height"]], "terrain": [0, 0]}
    head = "voxmelt-picture 1\n" + "".join(f"{key} {' '.join(map(repr, map(float, of)))}\n" for key, of in numbers.items())
    amounts = struct.pack(f"<{len(cells)}H", *(4096 if mask else 0 for mask in masks))
    with tempfile.NamedTemporaryFile(suffix=".picture") as file:
        file.write(f"{head}setting fast\ndata\n".encode() + bytes(masks) + amounts + bytes(2 * len(cells)))
        file.flush()
        picture = subprocess.run([JUDGE, "--picture", file.name], check=True, capture_output=True).stdout
    at = 3 * (place[1] * camera["width"] + place[0])
    return ("pixel", "bytes", " ".join(map(str, picture[at:at + 3])))


class WorkedPixel(unittest.TestCase):
    maxDiff = None

    def test_the_page_is_the_trace(self):
        text, place, rows = worked(PAGE)
        self.assertEqual(rows, traced(text, place))

    def test_the_page_is_what_the_plain_program_computes(self):
        text, place, rows = worked(PAGE)
        self.assertEqual(rows, computed(text, place))

    def test_the_judge_draws_the_last_row(self):
        text, place, rows = worked(PAGE)
        self.assertEqual(rows[-1], judged(text, place))

    def test_any_other_number_is_noticed(self):
        text, place, rows = worked(PAGE)
        begin = PAGE.index("\n## 4")
        places = [m.start() for m in re.finditer(r"(?<=[ -])\d+(?=[ \d-]*\|$)", PAGE[begin:], re.M)]
        self.assertEqual(len(places), sum(len(numbers.split()) for _, _, numbers in rows))
        for at in places:
            number = re.match(r"\d+", PAGE[begin + at:])[0]
            other = PAGE[:begin + at] + str(int(number) + 1) + PAGE[begin + at + len(number):]
            self.assertNotEqual(worked(other)[2], rows, number)

    # Pixels that the page does not show: on edges, in the liquid, in the solid.
    def test_the_plain_program_computes_other_pixels_too(self):
        text = worked(PAGE)[0]
        for place in ((4, 6), (6, 8), (8, 8), (9, 6)):
            self.assertEqual(computed(text, place), traced(text, place))
            self.assertEqual(computed(text, place)[-1], judged(text, place))


if __name__ == "__main__":
    unittest.main(argv=["worked_pixel_test"], verbosity=1)
