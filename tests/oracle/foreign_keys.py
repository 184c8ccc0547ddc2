"""KEYS: the range of every key of a scene that a rule reads, for foreign_scenes.py."""
import math

from foreign_sources import KEYS_OF, LAST_STEP

TINY = 1e-9  # the lowest value of a range that leaves out 0


class Key:
    """A range with both ends, the part of it in which scenes are lively, and values at which bugs like to sit."""

    def __init__(self, low, high, lively_low, lively_high, *hostile):
        self.ends, self.lively, self.hostile = (low, high), (lively_low, lively_high), hostile
        self.whole = isinstance(high, int) and isinstance(lively_high, int)

    def between(self, low, high, dice):
        if self.whole:
            return dice.randint(low, high)
        if low > 0 and high > 20 * low:  # every order of magnitude alike
            return min(high, max(low, math.exp(dice.uniform(math.log(low), math.log(high)))))
        return dice.uniform(low, high)

    def draw(self, dice, wild):
        """`wild` is the probability of an end; a hostile value and one from the whole range are as likely."""
        luck = dice.random()
        if luck < wild:
            return dice.choice(self.ends)
        if luck < 2 * wild and self.hostile:
            return dice.choice(self.hostile)
        return self.between(*(self.ends if luck < 3 * wild else self.lively), dice)


class Choice:
    def __init__(self, *values):
        self.ends = values

    def draw(self, dice, wild):
        return dice.choice(self.ends)


TEMPERATURE = Key(0, 1, 0.2, 0.95, 1 / 65535, 65534 / 65535, 0.5)
AMOUNT = Key(0, 15, 0.01, 0.5, 1 / 4096, 4095 / 4096, 1, 4097 / 4096)
ALPHA = Key(0, 1, 0.5, 1.0, 65534 / 65536, 1 / 65536)
POSITION = Key(-65536, 65536, -4.0, 12.0, 0.5, 1)  # most positions are drawn near the grid
RADIUS = Key(0, 8192, 0.1, 8.0, 1 / 32, 1 / 16, 0.5, 1, 8191)
DIRECTION = Key(-10**6, 10**6, -1.0, 1.0, 0.0, 1e-9, 1 / 65536, 1, -1)
POWER = Key(0, 4194303, 0.1, 100.0, 1 / 2**28, 4194302)
STEP = Key(0, LAST_STEP, 0, 30, 65535, 65536, 2**31 - 1, 2**31, 2**31 + 1, LAST_STEP - 1)

KEYS = {
    "grid.size": Key(1, 4096, 1, 12, 63, 64, 65, 130),
    "grid.border": Choice("closed", "open"),
    "run.seed": Key(0, 2**63 - 1, 0, 2**63 - 1, 1, 2**32 - 1, 2**32, 2**63 - 2),
    "material.melting_point": Key(TINY, 1, 0.2, 0.7, 1 / 65535, 0.5),
    "material.latent_heat": Key(0, 1, 0.0, 0.3, 1 / 65535),
    "material.freezing_point": Key(TINY, 1, 0.15, 0.6, 1 / 65535, 0.5),
    "materials.melting_point": Key(TINY, 1, 0.1, 0.7, 1 / 65535, 0.5),
    "materials.latent_heat": Key(0, 1, 0.0, 0.3, 1 / 65535),
    "materials.conductivity": Key(0, 256, 0.05, 3.0, 1, 0.5, 2, 0.001),
    "materials.capacity": Key(1, 16, 1.0, 3.0, 2, 4, 15.99),
    "pieces.fall": Choice(False, True),
    "pieces.in_liquid": Key(1, 1024, 1, 5, 2, 3, 1023),
    "pieces.density": Key(1 / 65536, 1, 0.2, 1.0, 65535 / 65536, 0.5),
    "start.step": Key(0, LAST_STEP, 0, 2048, *range(2**31 - 22, 2**31 - 1, 3), LAST_STEP - 20, LAST_STEP - 1, 2**16 - 9, 2**16 - 1, 2**16, 2**24 - 5),
    "heat.neighbours": Choice(6, 18, 26),
    "heat.gamma": Key(0, 0.5236, 0.02, 0.5, math.pi / 65536),
    "heat.convection": Key(0, 0.5, 0.01, 0.4, 1 / 65536),
    "heat.visibility_every": Key(1, 1024, 1, 4, 2, 1023),
    "heat.rays_per_face": Choice(1, 4, 16),
    "heat.air.exchange": Key(1 / 65536, 0.66666, 0.01, 0.5, 3 / 65536),
    "heat.air.glow": Key(0, 0.16666, 0.01, 0.16, 1 / 65536, 3 / 65536),
    "heat.air.sky": TEMPERATURE,
    "heat.air.bottom": TEMPERATURE,
    "heat.air.top": TEMPERATURE,
    "heat_source.kind": Choice(*KEYS_OF),
    "heat_source.at": POSITION,
    "heat_source.radius": RADIUS,
    "heat_source.direction": DIRECTION,
    "heat_source.power": POWER,
    "heat_source.keyframes.step": STEP,
    "heat_source.keyframes.at": POSITION,
    "heat_source.keyframes.radius": RADIUS,
    "heat_source.keyframes.direction": DIRECTION,
    "heat_source.keyframes.power": POWER,
    "flow.law": Choice("paper", "viscous"),
    "flow.fall.factor": Key(0, 1, 0.2, 1.0, 1 / 65536, 65535 / 65536),
    "flow.fall.wall_factor": Key(0, 1, 0.2, 1.0, 1 / 65536, 65535 / 65536),
    "flow.fall.minimum": Key(0, 15, 0.001, 0.1, 1 / 4096, 1),
    "flow.fall.hang": AMOUNT,
    "flow.paper.neighbours": Choice(4, 8),
    "flow.paper.threshold": AMOUNT,
    "flow.paper.share (4 neighbours)": Key(0, 0.25, 0.05, 0.25, 1 / 65536, 16383 / 65536),
    "flow.paper.share (8 neighbours)": Key(0, 0.2, 0.05, 0.2, 1 / 65536, 13106 / 65536),
    "flow.paper.table": Key(0, 1, 0.0, 1.0),
    "flow.paper.downhill": Choice(False, True),
    "flow.paper.margin": AMOUNT,
    "flow.paper.support": Choice(False, True),
    "flow.paper.slump": AMOUNT,
    "flow.paper.energy": Choice("text", "printed"),
    "flow.paper.beta": Key(0, 4, 0.2, 2.0, 1 / 65536, 1, 65537 / 65536),
    "flow.paper.alpha_liquid": ALPHA,
    "flow.paper.alpha_solid": ALPHA,
    "flow.paper.alpha_floor": ALPHA,
    "flow.paper.reheat": Key(0, 1, 0.01, 1.0, 1 / 65536),
    "flow.viscous.kappa": Key(TINY, 71, 0.01, 5.0, 9 / 2**21, 50),
    "flow.viscous.yield": Key(0, 255, 0.001, 0.1, 1 / 65536),
    "flow.viscous.stiffness": Key(1, 8, 1, 8),
    "flow.viscous.substeps": Key(1, 1024, 1, 5, 2, 3, 4, 7, 64, 257),  # or "auto"
    "flow.viscous.substeps_max": Key(1, 1024, 1, 12, 2, 63),
    "flow.viscous.stages_max": Key(1, 16, 2, 16, 2, 3, 5, 9, 15),
    "flow.thermal.reference": TEMPERATURE,
    "flow.thermal.doubling": Key(0.002, 1, 0.005, 0.5),
    "vent.at": POSITION,
    "vent.radius": Key(TINY, 8192, 0.6, 4.0, 0.5, 1),
    "vent.rate": Key(TINY, 1, 0.02, 1.0, 1 / 4096, 4095 / 4096),
    "vent.temperature": TEMPERATURE,
    "vent.energy": Key(0, 1, 0.2, 1.0, 1 / 4096, 4095 / 4096),
    "vent.from": Key(0, LAST_STEP - 1, 0, 15, 2**31 - 1, 2**31),
    "vent.until": Key(1, LAST_STEP, 10, 40, 2**31 - 1, 2**31, LAST_STEP - 1),
    "drain.at": POSITION,
    "drain.radius": Key(TINY, 8192, 0.6, 4.0, 0.5, 1),
    "drain.rate": Key(TINY, 1, 0.02, 1.0, 1 / 4096, 4095 / 4096),
    "drain.from": Key(0, LAST_STEP - 1, 0, 15, 2**31 - 1, 2**31),
    "drain.until": Key(1, LAST_STEP, 10, 40, 2**31 - 1, 2**31, LAST_STEP - 1),
    "solid.temperature": TEMPERATURE,
    "liquid.temperature": TEMPERATURE,
    "inert.temperature": TEMPERATURE,
    "liquid.amount": Key(TINY, 15, 0.2, 3.0, 1 / 4096, 1, 4097 / 4096),
    "liquid.energy": Key(0, 15, 0.1, 1.0, 1 / 4096),
}
ENDS = [(name, end) for name, key in KEYS.items() for end in key.ends]


def uses(scene, path=""):
    """(row of KEYS, value) for every value of a scene that has a row."""
    if isinstance(scene, dict):
        for key, value in scene.items():
            name = f"{path}.{key}" if path else key
            if name == "flow.paper.share":
                name += f" ({scene.get('neighbours', 8)} neighbours)"
            yield from uses(value, name)
    elif isinstance(scene, list):
        for value in scene:
            yield from uses(value, path)
    elif path in KEYS:
        yield path, scene
