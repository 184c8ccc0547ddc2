"""Materials of solids for foreign_scenes.py: of every melting point, capacity and conductivity, and how they lie in start fields."""
import math

from foreign_keys import TINY

HEAT_MOST = 65535
MOST_GAMMA, GAMMA = 0.5236, 0.15  # of docs/scenes.md: the most, and the default
ROUNDED = 16
FURTHER = (1, 1, 2, 3, 15)  # beside that of `material`


def one(maker, number, coldest):
    """A material that melts at `coldest` or above, and takes at most all heat there is."""
    keys = ("melting_point", "latent_heat", "conductivity", "capacity")
    row = {"name": f"m{number}", **maker.some("materials", *keys, given=0.75)}
    wanted = maker.wanted.split(".")[-1] if maker.wanted.startswith("materials.") else ""
    if wanted == "melting_point":
        row["capacity"] = 1 if maker.end == 1 else row.get("capacity", 1)
    # Numbers that are rounded may need some more units of heat.
    capacity = min(row.get("capacity", 1), max(1, (1 - ROUNDED / HEAT_MOST) / max(coldest, TINY)))
    if row.get("capacity", 1) > capacity:
        row["capacity"] = capacity
    if wanted == "latent_heat" and maker.end == 1:
        row["melting_point"] = TINY
    most = max(TINY, math.floor(HEAT_MOST / capacity) - 1) / HEAT_MOST if capacity > 1 else 1
    row["melting_point"] = max(coldest, min(most, row.get("melting_point", 0.5)))
    room = max(0, math.floor((1 - capacity * row["melting_point"]) * HEAT_MOST) - 2) / HEAT_MOST
    if row["melting_point"] > TINY:
        row["latent_heat"] = min(room, row.get("latent_heat", 0))
    return row


def materials(maker, material):
    """The rows of `materials`; an end that the scene must have wants a scene in which nothing freezes."""
    if maker.wanted.startswith("materials."):
        material.pop("freezing_point", None)
    rows = maker.dice.choice((*FURTHER, maker.dice.randint(1, 15)))
    return [one(maker, number, material.get("freezing_point", 0)) for number in range(1, rows + 1)]


def bound_conductivity(rows, heat):
    """Lets every conductivity fit the gamma of the scene."""
    gamma = heat.get("gamma", GAMMA)
    for row in rows:
        if row.get("conductivity", 1) * gamma > MOST_GAMMA:
            row["conductivity"] = max(0, MOST_GAMMA - 1e-5) / gamma


class Palette:
    """What start fields must know of the materials of a scene."""

    def __init__(self, scene, dice):
        self.dice = dice
        rows = [scene["material"], *scene.get("materials", [])]
        self.melting_points = [round(row.get("melting_point", 0.5) * HEAT_MOST) for row in rows]
        self.softens = [round(row.get("capacity", 1) * Tm) for row, Tm in zip(rows, self.melting_points)]
        self.melts = [min(HEAT_MOST, S + round(row.get("latent_heat", 0) * HEAT_MOST)) for row, S in zip(rows, self.softens)]
        self.last, self.mixed = 0, dice.choice((0.1, 0.5, 1))

    def near(self):
        """Heats at which something changes."""
        return [h for numbers in (self.melting_points, self.softens, self.melts) for h in numbers]

    def draw(self):
        """The number of a solid's material: often that of the cell before."""
        if self.dice.random() < self.mixed:
            self.last = self.dice.randrange(len(self.melts))
        return self.last
