#!/usr/bin/env python3
"""The textures of a picture in Python are those of the library, and are safe to keep.

  textures_test.py ROOT FOLDER_OF_PACKAGE
"""
import gc
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, PACKAGE = (Path(word).resolve() for word in sys.argv[1:3])
sys.path.insert(0, str(PACKAGE))
import numpy  # noqa: E402
import voxmelt  # noqa: E402

SMALL = ROOT / "scenes/bunny_small.toml"
# Nothing is filtered, and there is no ground. Of each box the first cell and the one behind its last are known.
BOXES = """[grid]
size = [40, 20, 24]
[look]
smooth = 0
smooth_solid = 0
[[solid]]
shape = "box"
size = [10, 10, 4]
at = [15, 8, 10]
[[liquid]]
shape = "box"
size = [6, 8, 6]
at = [28, 8, 10]
[[inert]]
shape = "box"
size = [4, 12, 4]
at = [36, 12, 10]
"""
TYPES = {"levels": ("u16", numpy.uint16, ()), "matter": ("u8x4", numpy.uint8, (4,)), "light": ("u32x4", numpy.uint32, (4,))}


class Uploaded:
    """What a program keeps of textures: whole arrays."""

    def __init__(self):
        self.version, self.arrays = 0, {}

    def take(self, textures):
        if textures.everything:
            self.arrays = {}
        for brick in textures.bricks:
            texture, texels = textures.textures[brick.texture], brick.texels
            if texture.name not in self.arrays:
                self.arrays[texture.name] = numpy.zeros(texture.size[::-1] + texels.shape[3:], texels.dtype)
            x, y, z = brick.at
            depth, height, width = texels.shape[:3]
            self.arrays[texture.name][z:z + depth, y:y + height, x:x + width] = texels
        self.version = textures.version


class Textures(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.boxes = Path(self.temporary.name, "boxes.toml")
        self.boxes.write_text(BOXES)

    def tearDown(self):
        self.temporary.cleanup()

    def test_levels_and_matter_by_hand(self):
        uploaded = Uploaded()
        textures = voxmelt.Simulation(self.boxes).textures()
        self.assertTrue(textures.everything)
        uploaded.take(textures)
        levels, matter = uploaded.arrays["levels"], uploaded.arrays["matter"]
        # As in the library's own test: the pre-filter takes 43, 170 and 43 of 256 along each axis.
        for (x, y, z), level in {(15, 8, 9): 65280, (10, 8, 9): 54315, (9, 8, 9): 10965, (15, 13, 9): 10965,
                                 (10, 3, 9): (213 * 54315 + 128) // 256, (8, 8, 9): 0, (-1, 0, 0): 0}.items():
            self.assertEqual(levels[z + 2, y + 2, x + 2], level, (x, y, z))
        for (x, y, z), bytes_ in {(15, 8, 9): [0, 0, 0, 0], (28, 8, 9): [255, 0, 0, 0], (36, 12, 9): [0, 0, 255, 0]}.items():
            self.assertEqual(list(matter[z + 2, y + 2, x + 2]), bytes_)

    def test_shapes_formats_and_numbers(self):
        textures = voxmelt.Simulation(self.boxes).textures()
        self.assertEqual([t.name for t in textures.textures], ["levels", "matter", "blocks", "light", "columns", "rock", "tables"])
        by_name = {t.name: t for t in textures.textures}
        for name, (format_, type_, last) in TYPES.items():
            self.assertEqual(by_name[name].format, getattr(voxmelt.TexelFormat, format_))
            bricks = [b for b in textures.bricks if textures.textures[b.texture] == by_name[name]]
            self.assertGreater(len(bricks), 0, name)
            for brick in bricks:
                self.assertEqual((brick.texels.dtype, brick.texels.shape), (type_, by_name[name].brick[::-1] + last))
                self.assertEqual(brick.texels.tobytes(), brick.bytes)
        self.assertTrue(all(side % brick == 0 for t in textures.textures for side, brick in zip(t.size, t.brick)))
        numbers = {n.name: n.values for n in textures.numbers}
        self.assertGreater(len(numbers), 10)
        self.assertTrue(all(isinstance(value, int) for values in numbers.values() for value in values))
        self.assertTrue(repr(textures.textures[0]).startswith("Texture(name='levels', format=TexelFormat.u16, size=("))

    def test_they_keep_up_with_a_run(self):
        run, kept = voxmelt.Simulation(SMALL), Uploaded()
        kept.take(run.textures())
        sent = []
        for steps in (11, 60):
            run.step(steps)
            textures = run.textures(kept.version)
            self.assertFalse(textures.everything)
            sent.append(len(textures.bricks))
            kept.take(textures)
        fresh, wanted = voxmelt.Simulation(SMALL), Uploaded()
        fresh.step(71)
        everything = fresh.textures()
        wanted.take(everything)
        self.assertEqual(sorted(kept.arrays), sorted(wanted.arrays))
        for name, array in wanted.arrays.items():
            numpy.testing.assert_array_equal(kept.arrays[name], array, name)
        self.assertTrue(all(0 < count < len(everything.bricks) for count in sent), (sent, len(everything.bricks)))
        self.assertEqual(run.textures(kept.version).bricks, ())
        self.assertTrue(run.textures(kept.version + 1000).everything)

    def test_they_outlive_their_simulation_and_are_not_written(self):
        run = voxmelt.Simulation(SMALL)
        textures = run.textures()
        brick = textures.bricks[0]
        texels, before = brick.texels, brick.texels.copy()
        self.assertFalse(texels.flags.writeable)
        with self.assertRaises(ValueError):
            texels[0] = 0
        with self.assertRaises(ValueError):
            texels.setflags(write=True)
        run.step(50)
        run.textures()
        del run, brick, textures
        gc.collect()
        numpy.testing.assert_array_equal(texels, before)

    def test_a_grid_that_is_too_large_is_refused(self):
        self.boxes.write_text(BOXES.replace("40, 20, 24", "1025, 20, 24"))
        with self.assertRaisesRegex(voxmelt.InputError, "1025 x 20 x 24 cells exceeds 1024"):
            voxmelt.Simulation(self.boxes).textures()


if __name__ == "__main__":
    unittest.main(argv=["textures_test"], verbosity=1)
