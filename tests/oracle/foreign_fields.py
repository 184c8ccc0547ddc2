"""Start fields: write_fields; and Fields, full of hostile values, for foreign_scenes.py."""
import struct

from foreign_materials import Palette

ONE, AMOUNT_MOST, HEAT_MOST = 4096, 65535, 65535  # docs/automaton.md, section 1
FREEZES_FROM = ONE - ONE // 64  # section 7
KINDS = ("air", "solid", "liquid", "inert")
CODES = {"solid": "B", "liquid": "B", "inert": "B", "amount": "H", "energy": "H", "heat": "H"}
MATERIAL = {"material": "B"}  # of scenes with `materials`


def write_fields(folder, size, fields):
    """NAME.npy for each name of fields; the values go by the index of the cell."""
    for name, values in fields.items():
        code = {**CODES, **MATERIAL}[name]
        header = (f"{{'descr': '{'|u1' if code == 'B' else '<u2'}', 'fortran_order': False, "
                  f"'shape': {tuple(reversed(size))}, }}")
        header += " " * (-(len(header) + 11) % 64) + "\n"
        (folder / f"{name}.npy").write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
                                             + struct.pack(f"<{len(values)}{code}", *values))


class Fields:
    """A random start that keeps the invariants of docs/automaton.md, section 1."""

    def __init__(self, scene, dice):
        self.size, self.dice = scene["grid"]["size"], dice
        self.fields = {name: [] for name in CODES}
        self.palette = Palette(scene, dice)
        if "materials" in scene and dice.random() < 0.9:  # without the field all solids are of material 0
            self.fields["material"] = []
        self.freezes = round(scene["material"].get("freezing_point", 0) * HEAT_MOST)
        near = [h + d for h in (*self.palette.near(), self.freezes) for d in (-1, 0, 1)]
        self.heats = [0, 1, HEAT_MOST - 1, HEAT_MOST, *(h for h in near if 0 <= h <= HEAT_MOST)]
        self.amounts = [1, 2, ONE // 2, FREEZES_FROM - 1, FREEZES_FROM, ONE - 1, ONE, ONE + 1, 2 * ONE, 8 * ONE, 11 * ONE, AMOUNT_MOST - 1, AMOUNT_MOST]
        self.most = dice.choice((ONE, ONE, 2 * ONE, AMOUNT_MOST))
        self.hostile = dice.choice((0.05, 0.3, 0.8))
        self.weights = [dice.random() for _ in range(4)]
        self.walls = dice.random() < 0.3  # isothermal ones
        self.layered, self.blocked = dice.random() < 0.5, dice.random() < 0.4
        self.adrift = "pieces" in scene and dice.random() < 0.8
        self.cools = self.freezes > 0 and dice.random() < 0.6  # most liquid is not much warmer than where it freezes
        self.cold_walls = self.cools and self.walls and dice.random() < 0.7
        self.fill()

    def one_of(self, values, low, high):
        return self.dice.choice(values) if self.dice.random() < self.hostile else self.dice.randint(low, high)

    def block(self):
        spans = [sorted(self.dice.randint(0, side) for _ in range(2)) for side in self.size]
        return spans, self.dice.choice(KINDS)

    def body(self):
        """Blocks of a solid that touches little, sometimes hollow and open below or above: a bell, or a bowl."""
        corner = [self.dice.randint(0, side) for side in self.size]
        corner[1] = self.dice.randint(min(2, self.size[1]), self.size[1])
        sides = [self.dice.randint(1, 4) for _ in range(3)]
        body = [(low, low + side) for low, side in zip(corner, sides)]
        hollow = [(low + 1, high - 1) for low, high in body]
        hollow[1] = self.dice.choice(((body[1][0], body[1][1] - 1), (body[1][0] + 1, body[1][1])))
        blocks = [(hollow, self.dice.choice(("air", "liquid")))] if self.dice.random() < 0.3 else []
        return [*blocks, (body, "solid")]

    def drifting(self):
        """Blocks: bodies in the air and in a pool, beside inert posts or none. Noise may lie around them, but no inert cell."""
        whole = [(0, side) for side in self.size]
        blocks = [block for _ in range(self.dice.randint(2, 8)) for block in self.body()]
        for _ in range(self.dice.choice((0, 0, 1, 2))):
            x, z = self.dice.randint(0, self.size[0]), self.dice.randint(0, self.size[2])
            blocks.append(([(x, x + 1), (0, self.dice.randint(1, self.size[1])), (z, z + 1)], "inert"))
        if self.dice.random() < 0.7:
            blocks.append(([whole[0], (0, self.dice.randint(0, self.size[1])), whole[2]], "liquid"))
        if self.dice.random() < 0.7:
            blocks.append((whole, "air"))
        self.weights[1] /= 4
        self.weights[3] = 0
        return blocks

    def kind(self, x, y, z, blocks):
        """Noise, often above a floor, often with blocks of one kind in it."""
        if self.layered and y == 0 and self.dice.random() < 0.9:
            return "inert"
        for spans, kind in blocks:
            if all(low <= c < high for c, (low, high) in zip((x, y, z), spans)):
                return kind
        return self.dice.choices(KINDS, self.weights)[0]

    def fill(self):
        blocks = self.drifting() if self.adrift else [self.block() for _ in range(6 if self.blocked else 0)]
        nx, ny, nz = self.size
        for z in range(nz):
            for y in range(ny):
                for x in range(nx):
                    self.add(self.kind(x, y, z, blocks))

    def add(self, kind, amount=None):
        """A cell of this kind; without an amount, a random one."""
        energy = heat = 0
        material = self.palette.draw() if kind == "solid" and "material" in self.fields else 0
        if kind == "inert":  # a bed offset
            amount = self.dice.choice((0, 2047, 2048, 2049, 4095, self.dice.randint(0, 4095)))
            most = self.freezes if self.cold_walls else HEAT_MOST
            heat = self.one_of(self.heats, 0, most) if self.walls and amount else 0
        if kind in ("solid", "liquid"):
            amount, heat = amount or self.one_of(self.amounts, 1, self.most), self.one_of(self.heats, 0, HEAT_MOST)
        if kind == "liquid" and self.cools and self.dice.random() < 0.8:
            heat = self.dice.randint(self.freezes, min(HEAT_MOST, self.freezes + HEAT_MOST // 16))
            amount = self.dice.choice((amount, self.dice.randint(FREEZES_FROM - 2, ONE)))
        if kind == "solid" and self.adrift and self.dice.random() < 0.9:
            heat = self.dice.randint(0, max(0, self.palette.melts[material] - 1))  # else bodies melt at once
        if kind == "liquid":
            energy = self.dice.choice((0, 1, amount - 1, amount, self.dice.randint(0, amount)))
        cell = {"amount": amount or 0, "energy": min(energy, amount or 0), "heat": heat, "material": material}
        for name, values in self.fields.items():
            values.append(cell.get(name, int(name == kind)))

    def write(self, folder):
        folder.mkdir()
        write_fields(folder, self.size, self.fields)
