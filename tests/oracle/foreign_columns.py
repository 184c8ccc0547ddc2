"""Start fields of tall columns that settle, for foreign_scenes.py: deficits, cliffs, ceilings and half-full cells."""
from foreign_fields import AMOUNT_MOST, ONE, Fields

# Amounts of the cells of a pile; a pair is a range.
PILES = {
    "full": (ONE,),
    "deficit": (2048, 2049, (2048, ONE)),
    "excess": (ONE, ONE + 1, AMOUNT_MOST, (ONE, AMOUNT_MOST), (2048, 2 * ONE)),
    "burst": (*[(2048, ONE)] * 9, (ONE, AMOUNT_MOST), AMOUNT_MOST),
    "drain": (1, 5, 2047, 2048, (1, 2047), (2048, ONE), (2048, ONE)),
}
# Piles at the bounds within which heat keeps its order: the excess AMAX - ONE, and the same as a deficit.
EDGES = ([AMOUNT_MOST, ONE], [AMOUNT_MOST, ONE + 1], [2048] * 29 + [2049], [2048] * 30, [2048] * 30 + [AMOUNT_MOST],
         [2048] * 29 + [2049, ONE, AMOUNT_MOST, 2048])


class Columns(Fields):
    def fill(self):
        nx, ny, nz = self.size
        self.cliff = self.dice.choice((0, 0, 1, 3))  # cells that the bed rises per two cells of x
        self.ceiling = self.dice.choice((0.1, 0.3, 1))
        columns = {(x, z): self.column(x) for x in range(nx) for z in range(nz)}
        for z in range(nz):
            for y in range(ny):
                for x in range(nx):
                    self.add(*columns[x, z][y])

    def pile(self, most):
        """(kind, amount) of up to `most` cells, upwards."""
        name = self.dice.choice((*PILES, "edge"))
        if name == "edge":
            amounts = self.dice.choice(EDGES)[:most]
        else:
            drawn = self.dice.choices(PILES[name], k=self.dice.randint(1, most))
            amounts = [self.dice.randint(*amount) if isinstance(amount, tuple) else amount for amount in drawn]
        return [("liquid", amount) for amount in amounts]

    def column(self, x):
        """(kind, amount) of each cell: a bed, and then piles with gaps and ceilings between them."""
        height, dice = self.size[1], self.dice
        cells = [("inert", None)] * min(height - 1, x * self.cliff // 2 + dice.randint(0, 2))
        while len(cells) < height:
            if dice.random() < 0.1:  # it may melt
                cells += [("solid", None)] * dice.randint(1, 6)
            if len(cells) < height:
                cells += self.pile(height - len(cells))
            if dice.random() < 0.5:
                cells += [("air", None)] * dice.choice((1, 8, height))
            if dice.random() < self.ceiling:
                cells += [(dice.choice(("inert", "solid")), None)]
        return cells[:height]
