#!/usr/bin/env python3
"""Random scenes that are like no committed one: one seed makes a scene file and, for most, start fields.

  foreign_scenes.py SEED FOLDER     writes FOLDER/scene.toml and FOLDER/fields/*.npy

A new key needs a row of KEYS in foreign_keys.py, and a place in the function of its table here, or in foreign_sources.py.
"""
import math
import random
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # a folder of bytecode here would fail oracle.independence
from foreign_columns import Columns
from foreign_fields import HEAT_MOST, Fields
from foreign_keys import ENDS, KEYS, LAST_STEP, TINY
from foreign_materials import bound_conductivity, materials
from foreign_sources import source


class Maker:
    """Makes the tables of a scene, each key by its row. The seed also chooses one end of one key, which this scene has."""

    def __init__(self, seed):
        self.dice = random.Random(seed)
        self.wild = self.dice.choice((0.02, 0.06, 0.15))
        self.wanted, self.end = ENDS[41 * seed % len(ENDS)]  # 41: neighbouring seeds take different keys
        self.size = self.make_size()
        self.first = 0
        self.materials = []

    def gives(self, table, probability):
        """Whether the scene has this table or key."""
        return f"{self.wanted}.".startswith(f"{table}.") or self.chance(probability)

    def chance(self, probability):
        return self.dice.random() < probability

    def draw(self, key):
        return self.end if key == self.wanted else KEYS[key].draw(self.dice, self.wild)

    def some(self, table, *keys, given=0.7):
        """Some of these keys; the program fills in the defaults of the others."""
        return {key: self.draw(f"{table}.{key}") for key in keys if self.gives(f"{table}.{key}", given)}

    def make_size(self):
        luck = self.dice.random()
        if self.wanted == "grid.size" or luck < 0.03:  # as long as can be, or flat, along one axis
            size = [self.dice.choice((1, 2)) for _ in range(3)]
            size[self.dice.randrange(3)] = self.draw("grid.size") if luck < 0.03 else self.end
            return size
        if luck < 0.25:
            return [self.dice.choice((63, 64, 65, 130)), self.dice.randint(1, 8), self.dice.randint(1, 5)]
        if luck < 0.4:
            return [self.dice.randint(1, 7), self.dice.choice((17, 33, 40, 70)), self.dice.randint(1, 3)]
        if luck < 0.45:
            return [self.dice.randint(1, 40), self.dice.randint(1, 24), self.dice.randint(1, 24)]
        return [self.dice.randint(1, 12) for _ in range(3)]

    def at(self, key, around=0):
        """A position in the grid, or up to `around` cells beside it; sometimes one of the whole range."""
        if key == self.wanted or self.chance(self.wild / 2):
            return [self.draw(key) for _ in range(3)]
        rounding = self.dice.choice((1, 2, 16, 1000))  # cells' corners and centres; sixteenths; neither
        return [round(self.dice.uniform(-around, side + around) * rounding) / rounding for side in self.size]

    def step(self, key):
        """A step: often one that this run reaches."""
        if key == self.wanted or self.chance(0.3):
            return self.draw(key)
        return min(LAST_STEP, self.first + self.dice.randint(1, 21))

    def material(self):
        material = self.some("material", "melting_point", "latent_heat", given=0.8)
        if self.wanted == "inert.temperature":
            material.pop("latent_heat", None)  # with it, a wall is at most as hot as the hottest liquid
        room = 1 - material.get("melting_point", 0.5)
        if material.get("latent_heat", 0) == 1:
            material["melting_point"] = TINY
        elif material.get("latent_heat", 0) > room:  # together at most 1
            material["latent_heat"] = max(0, math.floor(room * HEAT_MOST) - 1) / HEAT_MOST
        if self.gives("material.freezing_point", 0.55):
            self.freezing(material)
        return material

    def freezing(self, material):
        """A freezing point of at most the melting point, often both the same."""
        point = self.draw("material.freezing_point")
        if self.wanted == "material.freezing_point" and point > material.get("melting_point", 0.5):
            material.update(melting_point=point, latent_heat=0)
        melting_point = material.get("melting_point", 0.5)
        free = not self.wanted.startswith("material.")
        material["freezing_point"] = melting_point if free and self.chance(0.3) else min(point, melting_point)

    def air(self, freezing_point):
        """Moving air, glow, or both; where liquid freezes, the air is often cold."""
        glow = self.draw("heat.air.glow") if self.gives("heat.air.glow", 0.5) else 0
        air = {"bottom": self.draw("heat.air.bottom"), **self.some("heat.air", "top")}
        if glow > 0 or self.wanted == "heat.air.glow":
            air["glow"] = glow
        if glow == 0 or self.gives("heat.air.exchange", 0.6):
            air["exchange"] = self.draw("heat.air.exchange")
        if self.gives("heat.air.sky", 0.6 if glow > 0 else 0.1):
            air["sky"] = self.draw("heat.air.sky")
        if freezing_point and not self.wanted.startswith("heat.air.") and self.chance(0.6):
            air[self.dice.choice(("bottom", "top"))] = freezing_point * self.dice.random()
        return air

    def pieces(self):
        """Without the key `fall`, pieces fall."""
        return {**self.some("pieces", "in_liquid", "density", given=0.8), **self.some("pieces", "fall", given=0.1)}

    def heat(self, freezing_point):
        heat = self.some("heat", "neighbours", "gamma", "convection", "visibility_every", "rays_per_face")
        if self.wanted == "materials.conductivity":
            heat["gamma"] = 0.002  # that of the best conductor is 0.512
        if self.gives("heat.air", 0.7 if freezing_point else 0.5):
            heat["air"] = self.air(freezing_point)
        return heat

    def region(self, table):
        region = {"at": self.at(f"{table}.at"), "radius": self.draw(f"{table}.radius"), "rate": self.draw(f"{table}.rate")}
        if self.gives(f"{table}.from", 0.3):
            region["from"] = min(LAST_STEP - 1, self.step(f"{table}.from"))
        if self.gives(f"{table}.until", 0.3):
            region["until"] = max(region.get("from", 0) + 1, self.step(f"{table}.until"))
        if table == "vent":
            region.update(self.some("vent", "temperature", "energy"))
        return region

    def table(self):
        """Row p gives only in the directions of pattern p, and at most 1 together."""
        rows = []
        for pattern in range(16):
            inside = [d for d in range(4) if pattern >> d & 1]
            weights = {d: self.dice.choice((0, 1, self.dice.random())) for d in inside}
            most = self.dice.choice((0, 1, self.dice.random())) / max(sum(weights.values()), TINY)
            rows.append([math.floor(weights.get(d, 0) * most * 65536) / 65536 for d in range(4)])
        return rows

    def flow(self):
        law = next((law for law in ("paper", "viscous") if self.gives(f"flow.{law}", 0)), self.draw("flow.law"))
        flow = {"law": law, "fall": self.some("flow.fall", "factor", "wall_factor", "minimum", given=0.5)}
        if self.gives("flow.fall.hang", 0.25):
            flow["fall"]["hang"] = self.draw("flow.fall.hang")
        flow[law] = self.paper() if law == "paper" else self.viscous()
        if self.gives("flow.thermal", 0.3):
            flow["thermal"] = {"reference": self.draw("flow.thermal.reference"), "doubling": self.draw("flow.thermal.doubling")}
        return flow

    def viscous(self):
        viscous = {"kappa": self.draw("flow.viscous.kappa"), **self.some("flow.viscous", "yield", "stiffness", given=0.5)}
        if self.wanted != "flow.viscous.substeps" and self.gives("flow.viscous.substeps_max", 0.4):
            viscous["substeps"] = "auto"
            viscous.update(self.some("flow.viscous", "substeps_max", given=0.8))
        else:
            viscous.update(self.some("flow.viscous", "substeps", given=0.6))
        viscous.update(self.some("flow.viscous", "stages_max", given=0.5))
        return viscous

    def paper(self):
        paper = self.some("flow.paper", "neighbours", "energy")
        asked = next((n for n in (4, 8) if self.gives(f"flow.paper.share ({n} neighbours)", 0)), None)
        if asked or self.gives("flow.paper.table", 0):
            paper["neighbours"] = asked or 4
        paper.update(self.some("flow.paper", "threshold", "downhill", "margin", "support", "slump", "beta", "alpha_liquid",
                               "alpha_solid", "alpha_floor", "reheat", given=0.4))
        neighbours = paper.get("neighbours", 8)
        if neighbours == 4 and not asked and self.gives("flow.paper.table", 0.4):
            paper["table"] = self.table()
        elif asked or self.chance(0.7):
            paper["share"] = self.draw(f"flow.paper.share ({neighbours} neighbours)")
        return paper

    def wall(self, latent_heat):
        """Some inert shapes have a temperature, unless latent heat leaves no room for it."""
        most = max(0, math.floor((1 - latent_heat) * HEAT_MOST) - 1) / HEAT_MOST if latent_heat else 1
        return {key: min(most, value) for key, value in self.some("inert", "temperature", given=0.4).items() if most > 0}

    def shape(self, kind):
        if kind == "inert" and self.chance(0.4):
            return {"shape": "floor", "thickness": self.dice.randint(1, max(1, self.size[1] // 2))}
        shape = {"shape": "box", "size": [round(self.dice.uniform(0.3, side), 2) for side in self.size]}
        if self.chance(0.5):
            shape = {"shape": "sphere", "radius": round(self.dice.uniform(0.6, max(2, min(self.size))), 2)}
        shape["at"] = [round(self.dice.uniform(0, side), 2) for side in self.size]
        if kind in ("solid", "liquid"):
            shape.update(self.some(kind, "temperature", given=0.9))
        if kind == "solid" and self.materials and self.chance(0.7):
            shape["material"] = self.dice.choice(self.materials)["name"]
        if kind == "liquid":
            shape.update(self.some(kind, "amount"))
            if self.gives("liquid.energy", 0.4):
                shape["energy"] = self.draw("liquid.energy")
                shape["amount"] = max(shape.get("amount", 1), shape["energy"])
        return shape

    def scene(self):
        scene = {"title": "foreign", "grid": {"size": self.size, **self.some("grid", "border", given=0.5)}, "run": self.some("run", "seed"), "material": self.material()}
        if self.gives("materials", 0.4):
            scene["materials"] = self.materials = materials(self, scene["material"])
        by_shapes = self.gives("solid", 0) or self.gives("inert", 0) or self.gives("liquid", 0.1)
        if not by_shapes:
            scene["start"] = {"fields": "fields", **self.some("start", "step", given=0.8)}
            if self.wanted != "start.step" and self.chance(0.04):
                scene["start"]["step"] = 2**31 - self.dice.randint(1, 6)
            self.first = scene["start"].get("step", 0)
        if self.gives("pieces", 0.33):  # nearly all scenes have solids
            scene["pieces"] = self.pieces()
        sources = self.gives("heat_source", 0.5)
        often = self.materials or "freezing_point" in scene["material"]
        if sources or self.gives("heat", 0.9 if often else 0.6) or self.wanted == "materials.conductivity":
            scene["heat"] = self.heat(scene["material"].get("freezing_point", 0))
            if sources:
                scene["heat_source"] = [source(self) for _ in range(self.dice.randint(1, 4))]
        bound_conductivity(self.materials, scene.get("heat", {}))
        for table in ("vent", "drain"):
            if self.gives(table, 0.4):
                scene[table] = [self.region(table) for _ in range(self.dice.randint(1, 3))]
        scene["flow"] = self.flow()
        if by_shapes:
            for kind in ("solid", "liquid", "inert"):
                scene[kind] = [self.shape(kind) for _ in range(self.dice.randint(1, 3))]
            for shape in scene["inert"]:
                shape.update(self.wall(scene["material"].get("latent_heat", 0)))
        return scene


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else repr(value)


def write_scene(seed, folder):
    """The scene of this seed: written to the folder, and returned."""
    maker = Maker(seed)
    scene = maker.scene()
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.toml").write_text("".join(f"{key} = {toml(value)}\n" for key, value in scene.items()))
    if "start" in scene:
        columns = scene["flow"]["law"] == "viscous" and maker.chance(0.2 if "pieces" in scene else 0.5)
        (Columns if columns else Fields)(scene, maker.dice).write(folder / "fields")
    return scene


if __name__ == "__main__":
    write_scene(int(sys.argv[1]), sys.argv[2])
