"""What a page keeps that draws from textures: bricks as the server sends them, and a second way to the same field."""
import json
import struct
import zlib
from itertools import product
from pathlib import Path

TEXEL = {"u16": 2, "u8x4": 4, "u32x2": 8, "u32x4": 16, "i32": 4, "i32x2": 8}


class Textures:
    """The textures of a page, and the bricks of its last message."""

    def __init__(self, page):
        self.page, self.version = page, 0
        self.bricks = {}  # (name, first texel) -> bytes, of those that are not zeros
        self.shapes, self.sent, self.news, self.packed = {}, {}, {}, 0

    def ask(self):
        self.page.send(f"textures {self.version}")

    def take(self):
        """The next message. Returns its head."""
        while (heard := self.page.hear())[0] != "textures":
            pass
        head, packed = heard[1:]
        plain = zlib.decompress(packed)
        length = struct.unpack_from("<I", plain)[0]
        self.news = json.loads(plain[4:4 + length])
        self.packed = len(packed)
        if self.news["everything"]:
            self.bricks = {}
        self.shapes = {one["name"]: one for one in self.news["textures"]}
        at, self.sent = 4 + length, {}
        for _ in range(self.news["bricks"]):
            which, x, y, z = struct.unpack_from("<4H", plain, at)
            one = self.news["textures"][which]
            size = self.brick_bytes(one["name"])
            assert all(v % b == 0 and v < s for v, b, s in zip((x, y, z), one["brick"], one["size"])), (one, x, y, z)
            assert (one["name"], (x, y, z)) not in self.sent, "a brick comes once"
            self.sent[one["name"], (x, y, z)] = plain[at + 8:at + 8 + size]
            at += 8 + size
        assert at == len(plain), "there is nothing but bricks"
        self.bricks.update(self.sent)
        self.version = self.news["version"]
        return head

    def update(self):
        self.ask()
        return self.take()

    def brick_bytes(self, name):
        one = self.shapes[name]
        return TEXEL[one["format"]] * one["brick"][0] * one["brick"][1] * one["brick"][2]

    def bytes(self, *names):
        """The bytes of whole textures."""
        return sum(TEXEL[self.shapes[n]["format"]] * self.shapes[n]["size"][0] * self.shapes[n]["size"][1] *
                   self.shapes[n]["size"][2] for n in names)

    def held(self):
        """What the textures hold, whether a brick of zeros was sent or not."""
        return {key: data for key, data in self.bricks.items() if any(data)}

    def texel(self, name, x, y, z):
        one, size = self.shapes[name], TEXEL[self.shapes[name]["format"]]
        first = tuple(v - v % b for v, b in zip((x, y, z), one["brick"]))
        wide, high, _ = one["brick"]
        at = (((z - first[2]) * high + y - first[1]) * wide + x - first[0]) * size
        data = self.bricks.get((name, first))
        return data[at:at + size] if data else bytes(size)

    def slices(self, name):
        """The bytes of a texture slice by slice, as a graphics processor gives them."""
        one, size = self.shapes[name], TEXEL[self.shapes[name]["format"]]
        (sx, sy, sz), (wide, high, deep) = one["size"], one["brick"]
        for z in range(sz):
            data = bytearray(sx * sy * size)
            for y, x in product(range(sy), range(0, sx, wide)):
                brick = self.bricks.get((name, (x, y - y % high, z - z % deep)))
                if brick:
                    at = ((z % deep) * high + y % high) * wide * size
                    data[(y * sx + x) * size:(y * sx + x + wide) * size] = brick[at:at + wide * size]
            yield bytes(data)


def read_npy(file, code):
    data = Path(file).read_bytes()
    return struct.unpack(f"<{(len(data) - 128) // struct.calcsize(code)}{code}", data[128:])


def filtered(grid, values, along):
    """Each cell of three neighbours along z, y and x. Beside the grid the nearest cell repeats itself."""
    nx, ny, nz = grid
    steps = {0: 1, 1: nx, 2: nx * ny}
    for axis in along[1]:
        step, count = steps[axis], grid[axis]
        values = [along[0](values[i - step if i // step % count > 0 else i], v,
                           values[i + step if i // step % count < count - 1 else i]) for i, v in enumerate(values)]
    return values


def field_of(folder, grid):
    """Levels and matter of an export, as docs/picture/field.md and definition.md have them, where nothing is smoothed
    and no ground, puddle, glow or tone is: (level + 32640, (liquid, 0, obstacle, 0)) by cell."""
    solid, liquid, inert = (read_npy(f"{folder}/{name}.npy", "B") for name in ("solid", "liquid", "inert"))
    amount = read_npy(f"{folder}/amount.npy", "H")
    full = [16 * a - ((a + 15) >> 4) for a in (min(a, 4096) for a in amount)]
    s = [f if on else 0 for f, on in zip(full, solid)]
    l = [f if on else 0 for f, on in zip(full, liquid)]
    o = [65280 if on else 0 for on in inert]
    levels = filtered(grid, [c or a + b for a, b, c in zip(s, l, o)],
                      (lambda a, b, c: (43 * a + 170 * b + 43 * c + 128) >> 8, (0, 1, 2)))
    s, l, o = (filtered(grid, part, (lambda a, b, c: (a + 2 * b + c + 2) >> 2, (2, 1, 0))) for part in (s, l, o))
    matter = [(255 * b // max(1, a + b), 0, 255 * c // max(1, a + b + c), 0) if i else (0, 0, 0, 0)
              for i, a, b, c in zip(levels, s, l, o)]
    return levels, matter
