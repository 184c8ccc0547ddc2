"""Heat sources for foreign_scenes.py: of every kind, near and far, inside matter, on planes, oblique, with keys."""
import re
from pathlib import Path

PAGE = (Path(__file__).resolve().parents[2] / "docs/scenes.md").read_text()


def keys_of_kinds(page):
    """The kinds that docs/scenes.md names, each with its keys but power: {"sphere": ("at", "radius"), ...}."""
    kinds = re.findall(r'"(\w+)"', re.search(r"^\| `\[\[heat_source\]\] kind` \|[^|]*\|([^|]*)\|", page, re.M)[1])
    rows = re.findall(r"^\| `(\w+)` \(([\w, ]+)\) \|", page, re.M)
    return {kind: tuple(key for key, having in rows if kind in having.split(", ")) for kind in kinds}


KEYS_OF = keys_of_kinds(PAGE)
MOST_POWER, MOST_DIRECTION = 4194303, 10**6
LAST_STEP = 2**32 - 1
LONGEST_TURN = 5  # pairs of steps in which a sun turns back
BRIGHT = 30  # cells: most powers that are drawn light a cell so far away, without being cut


def wanted_kinds(maker):
    """The kinds that can have the end which this scene must have."""
    if maker.wanted == "heat_source.kind":
        return [maker.end]
    last = maker.wanted.split(".")[-1] if maker.wanted.startswith("heat_source.") else ""
    return [kind for kind, keys in KEYS_OF.items() if last in keys] or list(KEYS_OF)


def position(maker, key):
    if key != maker.wanted:
        luck = maker.dice.random()
        if luck < 0.15:  # the centre of a cell, often of an opaque one
            return [maker.dice.randrange(side) + 0.5 for side in maker.size]
        if luck < 0.3:
            far = maker.dice.choice((100, 1000, 65535))
            return [round(maker.dice.uniform(-far, far) * 16) / 16 for _ in range(3)]
    return maker.at(key, 6)


def direction(maker, key):
    if key == maker.wanted:
        return [maker.end] * 3
    dice = maker.dice
    toward = [0, 0, 0]
    while not any(toward):
        toward = [maker.draw(key) if dice.random() < 0.2 else dice.uniform(-1, 1) for _ in range(3)]
        luck = dice.random()
        if luck < 0.2:  # along an axis, or in a plane of two
            toward = [dice.choice((-1, 0, 0, 1)) for _ in range(3)]
        elif luck < 0.4:  # nearly along one
            toward = [dice.choice((-1, 0, 1)) * 10 ** dice.uniform(-6, -1) for _ in range(3)]
            toward[dice.randrange(3)] = dice.choice((-1, 1))
    length = 10 ** dice.uniform(-3, 3) if dice.random() < 0.5 else 1
    return [max(-MOST_DIRECTION, min(MOST_DIRECTION, length * part)) for part in toward]


def power(maker, key, numbers):
    drawn = maker.draw(key)
    if key == maker.wanted or maker.chance(0.2):
        return drawn
    reach = max(1, numbers.get("radius", 0), *(abs(part) for part in numbers.get("at", ())))
    return min(MOST_POWER, drawn * (reach / BRIGHT) ** 2)


def numbers_of(maker, kind, table):
    """What a source of this kind has, or one of its keyframes."""
    make = {"at": position, "direction": direction, "radius": lambda maker, key: maker.draw(key)}
    numbers = {name: make[name](maker, f"{table}.{name}") for name in KEYS_OF[kind]}
    return {**numbers, "power": power(maker, f"{table}.power", numbers)}


def source(maker):
    kind = maker.dice.choice(wanted_kinds(maker))
    named = {} if kind == "point" and maker.wanted != "heat_source.kind" and maker.chance(0.5) else {"kind": kind}
    frame = "heat_source.keyframes"
    plain = maker.wanted in {f"heat_source.{key}" for key in ("at", "radius", "direction", "power")}
    if plain or not maker.gives(frame, 0.5):
        return {**named, **numbers_of(maker, kind, "heat_source")}
    turns_back = kind == "directional" and not maker.wanted.startswith(frame) and maker.chance(0.4)
    turns_back = turns_back and maker.first + 2 * LONGEST_TURN <= LAST_STEP
    steps = {maker.step(f"{frame}.step") for _ in range(maker.dice.randint(1, 4))}
    if turns_back:
        steps = {maker.first, maker.first + 2 * maker.dice.randint(1, LONGEST_TURN)}
    frames = [{"step": step, **numbers_of(maker, kind, frame)} for step in sorted(steps)]
    if turns_back:  # in the middle, D is short or 0: only then a ray needs many D to leave the grid
        longest = max(map(abs, frames[0]["direction"]))
        noise = maker.dice.choice((0, 1e-4, 1e-3))
        frames[1]["direction"] = [noise * maker.dice.uniform(-1, 1) - part / longest for part in frames[0]["direction"]]
    return {**named, "keyframes": frames}
