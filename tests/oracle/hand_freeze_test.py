#!/usr/bin/env python3
"""Liquid freezes, sets, clings, and matter glows in small states, step by step, as docs/automaton.md sections 6 to 11 give
them by hand: every implementation and the oracle find the same.

  hand_freeze_test.py VOXMELT ORACLE [--all]

Liquid freezes below a heat of 10000 and solids melt from 20000 on, unless a case says otherwise. Nothing is conducted.
Where a case has both laws, its liquid has no energy under the viscous one. There kappa is so small that nothing spreads.
D(0) = 0, D(1) = 32768, D(2) = 16384, D(3) = 49152, D(4) = 8192, D(54) = 27648 and D(55) = 60416.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # a folder of bytecode here would fail oracle.independence
from foreign_fields import CODES, write_fields
from machines import of_hand_tests

BOTH, PAPER, VISCOUS = ("paper", "viscous"), ("paper",), ("viscous",)
MATERIAL = "material = { melting_point = 0.305181, freezing_point = 0.152591 }\n"
COLD = MATERIAL + "heat = { gamma = 0 }\n"
LATENT = "material = { melting_point = 0.305181, latent_heat = 0.305181 }\n"  # solids melt from 40000 on
STILL, FALLING = "{ factor = 0, minimum = 0 }", "{ factor = 1 }"
RESTS = {"paper": "paper = { share = 0 }", "viscous": "viscous = { kappa = 1e-9, substeps = 1 }"}
# Each neighbour gets an eighth. No energy is left of what a cell takes.
SPREADING = "paper = { neighbours = 4, share = 0.125, downhill = false, alpha_liquid = 0, alpha_solid = 0, alpha_floor = 0 }"


def viscous(kappa, more):
    return f"viscous = {{ kappa = {kappa}, {more} }}"


SPREADS = {"paper": SPREADING, "viscous": viscous(1, "substeps = 1")}


def air(more, bottom=0):
    """`bottom` is the temperature of the air. air_exchange and air_glow of 0.0625 are 4096."""
    return f"heat = {{ gamma = 0, air = {{ bottom = {bottom}, {more} }} }}\n"


def liquid(amount, heat, energy=0):
    return "liquid", amount, energy, heat


def solid(amount, heat):
    return "solid", amount, 0, heat


CELLS = {".": ("air", 0, 0, 0), "#": ("inert", 2048, 0, 0),
         "F": liquid(4096, 9999, 1000), "f": solid(4096, 9999), "H": liquid(4096, 10000, 1000),
         "L": liquid(4032, 9999, 500), "l": solid(4032, 9999), "M": liquid(4031, 9999, 500),
         "P": solid(4096, 20000), "Q": liquid(4096, 20000, 4096), "s": solid(1, 5),
         "S": liquid(1000, 9999), "W": liquid(1000, 12000), "X": liquid(5000, 9999), "Y": liquid(904, 9999),
         "Z": liquid(4096, 12000)}


def isolated(units):
    """A drawing of units of 3 x 3 x 3 cells, one behind the other, that have F in the middle, or what is at (0, 0, 0)."""
    slices = []
    for unit in units:
        cells = {(0, 0, 0): "F", **unit}
        slices += [" ".join("".join(cells.get((x, y, z), ".") for x in (-1, 0, 1)) for y in (1, 0, -1)) for z in (-1, 0, 1)]
    return " / ".join(slices)


def between_air(*rows):
    """A drawing of these rows, with a slice of air before and behind them."""
    empty = " ".join("." * len(row) for row in rows)
    return f"{empty} / {' '.join(rows)} / {empty}"


PLACES = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
BESIDE = [place for place in PLACES if sum(map(abs, place)) == 1]
FARTHER = [place for place in PLACES if sum(map(abs, place)) > 1]
ONE_OF_SIX = [{place: letter} for place in BESIDE for letter in "#s"]
# Each has 20 cells that touch the middle at an edge or a corner.
NONE_OF_SIX = [{place: letter for place in FARTHER} for letter in "#s."]

# Name, laws, rules, falling, flow, first step, drawings, more cells, ledgers by hand in the end.
# A drawing has its rows from the top down, and slashes between the slices z = 0, 1, ... The first one is the start; a step
# leads to the next.
CASES = [
    # 4032 = ONE - ONE / 64. The border is blocked. F and L lose their energy.
    ("what is full and cold freezes", BOTH, COLD, STILL, RESTS, 0, ["FLMH", "flMH", "flMH"], {}, {"frozen": 1500}),
    ("without a freezing point nothing freezes", BOTH, "heat = { gamma = 0 }\n", STILL, RESTS, 0, ["FLMH", "FLMH"], {},
     {"frozen": 0}),
    ("without heat nothing freezes", BOTH, MATERIAL, STILL, RESTS, 0, ["cd", "cd"],
     {"c": liquid(4096, 0, 1000), "d": liquid(4031, 0)}, {"frozen": 0}),
    ("it may freeze at the melting point", BOTH, COLD.replace("0.152591", "0.305181"), STILL, RESTS, 0, ["abc", "efc"],
     {"a": liquid(4096, 19999), "b": liquid(65535, 15000, 9), "c": liquid(4096, 20000), "e": solid(4096, 19999),
      "f": solid(65535, 15000)}, {"frozen": 9}),
    ("one blocked face neighbour does", BOTH, COLD, STILL, RESTS, 0,
     [isolated(ONE_OF_SIX), isolated([{**unit, (0, 0, 0): "f"} for unit in ONE_OF_SIX])], {}, {"frozen": 12000}),
    ("no other one does", BOTH, COLD, STILL, RESTS, 0, [isolated(NONE_OF_SIX)] * 3, {}, {"frozen": 0}),
    ("a cell that freezes is no blocked neighbour yet", BOTH, COLD, STILL, RESTS, 0,
     [between_air(".....", row, ".....") for row in (".#FF.", ".#fF.", ".#ff.", ".#ff.")], {}, {"frozen": 2000}),
    ("a solid that melts still is one", PAPER, COLD, STILL, RESTS, 0,
     [between_air("....", row, "....") for row in (".PF.", ".Qf.", ".Qf.")], {}, {"frozen": 1000, "melted": 4096}),
    # The phase finds what the vent added: 0.15 x 65535 = 9830.25, and half of the amount as energy. Then the cell is blocked.
    ("what a vent adds freezes at once", PAPER,
     COLD + "vent = [{ at = [0.5, 0.5, 0.5], radius = 0.5, rate = 1, temperature = 0.15, energy = 0.5 }]\n", STILL, RESTS, 0,
     [".", "v", "v"], {"v": solid(4096, 9830)}, {"frozen": 2048}),
    # n = 1: w = 4096, and -10000 / 16 = -625. Then -9375 / 16 + 1 / 2 = -585.4.
    ("what the air cools freezes at once", BOTH, MATERIAL + air("exchange = 0.0625"), STILL, RESTS, 0,
     [". / a / .", ". / b / .", ". / c / ."], {"a": liquid(4096, 10000, 7), "b": solid(4096, 9375), "c": solid(4096, 8789)},
     {"frozen": 7, "cooled": 4096 * (625 + 586)}),
    ("what froze falls as a piece", BOTH, COLD + "pieces = {}\n", STILL, RESTS, 0,
     ["F . .", "f . .", ". f .", ". . f", ". . f"], {}, {"frozen": 1000}),

    ("a set drop falls in free air, and a full one freezes where it lands", BOTH, COLD, FALLING, RESTS, 0,
     [between_air(".....", *rows) for rows in ((".S.F.", ".....", "....."), (".....", ".S.F.", "....."),
                                               (".....", ".....", ".S.F."), *[(".....", ".....", ".S.f.")] * 2)],
     {}, {"frozen": 1000}),
    # The inert cell at z = 0 touches only an edge of the drop that falls. The last one touches the border.
    ("a set drop clings to a wall at its side, a warm one does not", BOTH, COLD, FALLING, RESTS, 0,
     [f"........... .......#... ........... ........... / {rows} / ........... ........... ........... ..........." for rows in (
         "........... .#S.#W..S.S ........... ...........", "........... .#S.#.....S .....W..S.. ...........",
         "........... .#S.#.....S ........... .....W..S..", "........... .#S.#.....S ........... .....W..S..")], {}, {}),
    ("a set drop clings to a ceiling, and to the border above it", BOTH, COLD, FALLING, RESTS, 0,
     [between_air(*rows) for rows in ((".#.#.S.", ".S.W...", "......."), (".#.#.S.", ".S.....", "...W..."),
                                      (".#.#.S.", ".S.....", "...W..."))], {}, {}),
    # Above it the drop touches what is blocked once others have frozen.
    ("a set drop clings to a ceiling that freezes in this step", BOTH, COLD, FALLING, RESTS, 0,
     [between_air("....", *rows, "....") for rows in ((".#F.", "..S."), (".#f.", "..S."), (".#f.", "..S."))], {},
     {"frozen": 1000}),
    # Its sides date from before `melt` under the paper law, so that what froze is no wall yet, and what melted still is one.
    ("sides that freeze: paper", PAPER, COLD, FALLING, RESTS, 0,
     [between_air("......", *rows) for rows in ((".#FS..", "......", "......"), (".#f...", "...S..", "......"),
                                               (".#f...", "......", "...S.."))], {}, {"frozen": 1000}),
    ("sides that freeze: viscous", VISCOUS, COLD, FALLING, RESTS, 0,
     [between_air("......", row, "......") for row in (".#FS..", ".#fS..", ".#fS..")], {}, {"frozen": 0}),
    ("sides that melt: paper", PAPER, COLD, FALLING, RESTS, 0,
     [between_air("....", *rows) for rows in ((".PS.", "....", "...."), ("..S.", ".Q..", "...."), ("....", "..S.", ".Q.."))],
     {}, {"melted": 4096}),
    ("sides that melt: viscous", VISCOUS, COLD, FALLING, RESTS, 0,
     [between_air("....", *rows) for rows in ((".PS.", "....", "...."), ("....", ".QS.", "...."), ("....", "....", ".QS."))],
     {}, {"melted": 0}),
    # Nothing blocked touches the middle one. What is too much in it climbs, or settles upwards.
    ("excess leaves a set cell", BOTH, COLD, FALLING, RESTS, 0,
     [between_air("...", *rows) for rows in (("...", ".X.", ".Z."), (".Y.", ".F.", ".Z."), (".Y.", ".F.", ".Z."))],
     {"F": liquid(4096, 9999)}, {"frozen": 0}),

    # The random bytes of both steps (seed 1) let each cell give to the other. 4000 / 8 = 500: the heat is
    # (1000 x 9999 + 500 x 12000) / 1500 = 10666, and all energy that moves is lost. Then the right one is warm: it gives
    # 187 and its energy of 62, and takes 437. Heats (3063 x 12000 + 187 x 10666) / 3250 = 11923.24 and
    # (1313 x 10666 + 437 x 12000) / 1750 = 10999.12, where D(55) adds 0.92.
    ("a set cell takes, and does not give: paper", PAPER, COLD, FALLING, SPREADING, 54, ["ab", "cd", "ef"],
     {"a": liquid(4000, 12000, 4000), "b": liquid(1000, 9999, 500), "c": liquid(3500, 12000, 3500),
      "d": liquid(1500, 10666, 500), "e": liquid(3250, 11924, 3063), "f": liquid(1750, 11000, 438)}, {}),
    # (1000 x 9999 + 2000 x 12000) / 3000 = 11333. b gains the energy of what falls. The random bytes would let it give at
    # once. In the next step it gives 375, and of its energy 187, all of which is lost.
    ("warmth that falls in does not free a set cell", PAPER, COLD, FALLING, SPREADING, 2, ["a. b.", ".. c.", ".. de"],
     {"a": liquid(2000, 12000, 1000), "b": liquid(1000, 9999, 500), "c": liquid(3000, 11333, 1500),
      "d": liquid(2625, 11333, 1313), "e": liquid(375, 11333)}, {}),
    # a falls into the place that S leaves. The byte of that place at step 2 has all four directions. At step 3 a comes to
    # the next set place, and at step 4 onto the drop: (1000 x 9999 + 2000 x 12000) / 3000 = 11333.
    ("being set belongs to the place", PAPER, COLD, FALLING, SPREADING, 2,
     [between_air(*rows) for rows in ((".a.", ".S.", "...", "..."), ("...", ".a.", ".S.", "..."), ("...", "...", ".a.", ".S."),
                                      ("...", "...", "...", ".b."))],
     {"a": liquid(2000, 12000, 1000), "b": liquid(3000, 11333, 1000)}, {}),
    ("a set cell gives to none of its neighbours", BOTH, COLD, FALLING, SPREADS, 0, ["... ... / ... .a. / ... ..."] * 5,
     {"a": liquid(4000, 9999, 4000)}, {}),
    ("a full cell that touches nothing blocked is set, too", BOTH, COLD, FALLING, SPREADS, 0,
     ["... ... ### / ... .a. #Z# / ... ... ###"] * 5, {"a": liquid(4096, 9999, 4096)}, {"frozen": 0}),

    # kappa 1: raw is 3555556, 888889 and 222208 for M = 4000, 2000 and 1000, with limits of 13107. All four cells beside
    # a pair are blocked: s = 24576. drop = 500 - 250, drive = 6000, m = 3355392 + 888889, a = 3000, c = 3108604, and
    # w = 277.9. The heat: (2000 x 9999 + 277 x 12000) / 2277 = 10242.4. The middle is higher than the right one by 125.
    ("a set cell takes, and does not give: viscous", VISCOUS, COLD, FALLING, SPREADS, 0,
     ["... abc", "... dec"], {"a": liquid(4000, 12000), "b": liquid(2000, 9999), "c": liquid(1000, 12000), "d": liquid(3723, 12000),
      "e": liquid(2277, 10242)}, {}),
    # In halves raw is 1777778 and 444444: m = 2222222, c = 1627604, and 145.5 flow. That is (19998000 + 1740000) / 2145 =
    # 10134.3. Then M = 3855 and 2145: raw = 1651200 and 511204, c = 1583791, drop = 481 - 268, drive = 5112, R = 32768,
    # w = 121.1. With D(1) it is (2145 x 10134 + 121 x 12000) / 2266 + 1 / 2 = 10234.1, and the middle still gives nothing.
    ("warmth that flows in does not free a set cell", VISCOUS, COLD, FALLING, viscous(1, "substeps = 2"), 0,
     ["... abc", "... dec"], {"a": liquid(4000, 12000), "b": liquid(2000, 9999), "c": liquid(1000, 12000), "d": liquid(3734, 12000),
      "e": liquid(2266, 10234)}, {}),
    # kappa 2: N = 3, so two stages: reach 3, bits 2, times 21845 and 65536, limits 9830 that cut nothing. The middle is
    # higher by 2 than the left and by 440 than the right. m = 14279225 and 7279161, a = 4008 and 2258, c = 13972444 and
    # 4012779, k = 13642 and 3917. I_1 = 32511, 32553 and 23166: 8 and 561 are levelled. W = 24, -1707 and 1683,
    # D = 12, -854 and 841. The drops are -738 and 26465: 57.6 would come back. drive = 19848, c drive / 2^27 = 593.4.
    ("nothing flows back from a set cell", VISCOUS, COLD, FALLING, viscous(2, "substeps = 1, stages_max = 2"), 0,
     ["... abc", "... ade"],
     {"a": liquid(4000, 9999), "b": liquid(4016, 12000), "c": liquid(500, 12000), "d": liquid(3423, 12000),
      "e": liquid(1093, 12000)}, {}),
    # kappa 1: N = 2, so two stages. The left one is higher than the middle by 188, but is set: it takes no part. m = 1388885 +
    # 23438, a = 1413, c = 487210, k = 474. I_1 = 28500 and 22698 of the middle and the right: d is 5802, and 41 are
    # levelled. W = -123 and 123, D = -62 and 61. drop = 17408 - 123, drive = 12963, and c drive / 2^27 = 47.06.
    ("the head of a set cell does not relax downwards", VISCOUS, COLD, FALLING, viscous(1, "substeps = 1, stages_max = 2"), 0,
     ["... abc", "... ade"],
     {"a": liquid(4000, 9999), "b": liquid(2500, 12000), "c": liquid(325, 12000), "d": liquid(2453, 12000),
      "e": liquid(372, 12000)}, {}),

    # n = 3: w = 6144. T = 20000 while it melts, q = 6103^2 >> 16 = 568, and -568 x 6144 / 65536 = -53.25. D(1) adds 0.5.
    ("a cell in free air glows on three axes", BOTH, LATENT + air("glow = 0.0625"), STILL, RESTS, 0,
     [isolated([{(0, 0, 0): letter}]) for letter in "abc"],
     {"a": solid(1000, 30000), "b": solid(1000, 29946), "c": solid(1000, 29893)}, {"warmed": 0, "cooled": 1000 * (54 + 53)}),
    # q(60000) = 54931^2 >> 16 = 46042 and q(10000) = 1525^2 >> 16 = 35. w = 4096: 46007 / 16 = 2875.4.
    # q(15147) = 3500^2 >> 16 = 186, and 45856 / 16 = 2866; 15147^4 / 2^48 would be 187. q(15148) = 3501^2 >> 16 = 187, and
    # 45855 / 16 = 2865.9; 60000^4 / 2^48 would be 46043.
    ("a cell beside air on one axis glows", BOTH, LATENT + air("glow = 0.0625, sky = 0.915542"), STILL, RESTS, 0,
     ["... / ace", "... / bdd"],
     {"a": solid(1000, 10000), "b": solid(1000, 12875), "c": solid(1000, 15147), "d": solid(1000, 18013),
      "e": solid(1000, 15148)}, {"warmed": 8606000, "cooled": 0}),
    # w = 5120: 46007 x 5120 / 65536 = 3594.3.
    ("a cell beside air on two axes glows", BOTH, LATENT + air("glow = 0.0625, sky = 0.915542"), STILL, RESTS, 0,
     ["... / .a. / ...", "... / .b. / ..."], {"a": solid(1000, 10000), "b": solid(1000, 13594)}, {"warmed": 3594000}),
    ("a cell without air beside it does not glow", BOTH, LATENT + air("glow = 0.0625, sky = 0.915542"), STILL, RESTS, 0,
     ["a", "a"], {"a": solid(1000, 10000)}, {"warmed": 0, "cooled": 0}),
    # (50000 - 10000) / 16 = 2500. Then q(12500) = 2384^2 >> 16 = 86, and (46042 - 86) / 16 = 2872.25.
    ("a cell glows after the air has warmed it", BOTH,
     LATENT + air("exchange = 0.0625, glow = 0.0625, sky = 0.915542", 0.762952), STILL, RESTS, 0, [". / a", ". / b"],
     {"a": solid(1000, 10000), "b": solid(1000, 15372)}, {"warmed": 1000 * (2500 + 2872), "cooled": 0}),
    # -86 / 16 = -5.4. The sky is 0.
    ("what glows loses beside what the air gives", BOTH, LATENT + air("exchange = 0.0625, glow = 0.0625", 0.762952), STILL, RESTS,
     0, [". / a", ". / b"], {"a": solid(1000, 10000), "b": solid(1000, 12494)}, {"warmed": 2500000, "cooled": 6000}),
    # T = 45000, q = 30899^2 >> 16 = 14568, and (46042 - 14568) / 16 = 1967 is cut to 535.
    ("heat ends at 65535 in the glow, too", BOTH, LATENT + air("glow = 0.0625, sky = 0.915542"), STILL, RESTS, 0,
     [". / a", ". / b"], {"a": liquid(1000, 65000), "b": liquid(1000, 65535)}, {"warmed": 535000}),
]
# The ledger of a term, and its place in the oracle's line.
TERMS = {"frozen": ("energy", 2), "melted": ("energy", 1), "warmed": ("heat", 5), "cooled": ("heat", 6)}


def cells_of(drawing, letters, law):
    """The size of a drawing, and its cells in the order of their indices. Under the viscous law they have no energy."""
    slices = [piece.split()[::-1] for piece in drawing.split("/")]
    size = [len(slices[0][0]), len(slices[0]), len(slices)]
    cells = [letters[letter] for rows in slices for row in rows for letter in row]
    return size, [(kind, amount, energy if law == "paper" else 0, heat) for kind, amount, energy, heat in cells]


def fields_of(cells):
    """The values of each field."""
    numbers = dict(zip(("amount", "energy", "heat"), list(zip(*cells))[1:]))
    return {name: list(numbers.get(name, [int(cell[0] == name) for cell in cells])) for name in CODES}


def read_cells(folder, count):
    """(kind, amount, energy, heat) of each cell in a folder of fields."""
    found = {}
    for name, code in CODES.items():
        width = 1 if code == "B" else 2
        data = (folder / f"{name}.npy").read_bytes()[-count * width:]
        found[name] = [int.from_bytes(data[n:n + width], "little") for n in range(0, len(data), width)]
    masks = ("solid", "liquid", "inert")
    kinds = [" and ".join(name for name in masks if found[name][n]) or "air" for n in range(count)]
    return list(zip(kinds, found["amount"], found["energy"], found["heat"]))


def write_scene(folder, size, cells, law, case):
    rules, fall, flow, first = case[2:6]
    (folder / "fields").mkdir()
    write_fields(folder / "fields", size, fields_of(cells))
    scene = folder / "scene.toml"
    scene.write_text(f'grid = {{ size = {size} }}\nstart = {{ fields = "fields", step = {first} }}\n{rules}'
                     f'flow = {{ law = "{law}", fall = {fall}, {flow[law] if isinstance(flow, dict) else flow} }}\n')
    return scene


def output(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout.splitlines()


def told_by(voxmelt, name, scene, steps, folder):
    """The lines of all steps with their digests, and the terms of the ledgers, by this implementation."""
    file = folder / f"{name}.json"
    lines = output(voxmelt, "digest", scene, "--steps", steps, "--every", 1, "--quiet", "--implementation", name, "--report", file)
    report = json.loads(file.read_text())
    return lines, {term: int(report[of][term]) for term, (of, _) in TERMS.items()}


def cells_by(voxmelt, name, scene, steps, count, folder):
    """The cells after these steps, by this implementation."""
    output(voxmelt, "export", scene, "--steps", steps, "--quiet", "--implementation", name, "--out", folder / f"{name} {steps}")
    return read_cells(folder / f"{name} {steps}", count)


def by_oracle(oracle, start, steps, count, folder):
    """The cells after these steps, the lines of all of them, and the terms of the ledgers."""
    lines = output(oracle, start, "--steps", steps, "--every", 1, "--ledger", "--fields", folder / "judged")
    ledgers = {line.split()[1]: line.split()[2:] for line in lines if line.startswith("ledger")}
    terms = {term: int(ledgers[of][n]) for term, (of, n) in TERMS.items()}
    return read_cells(folder / "judged", count), [line for line in lines if line.startswith("step")], terms


def differences(what, program, cells, wanted):
    for i, (one, other) in enumerate(zip(cells, wanted)):
        if one != other:
            yield f"{what}, cell {i}:\n  {program}: {one}\n  by hand: {other}"


def offences_of(voxmelt, oracle, names, law, case, folder):
    """The oracle's cells are compared with those by hand. All others need only have the oracle's digests: their cells are
    looked at where they have not."""
    name, drawings, letters, terms = case[0], case[6], {**CELLS, **case[7]}, case[8]
    size, cells = cells_of(drawings[0], letters, law)
    count = len(cells)
    scene = write_scene(folder, size, cells, law, case)
    output(voxmelt, "export", scene, "--quiet", "--steps", 0, "--out", folder / "start")
    wanted = [cells_of(drawing, letters, law)[1] for drawing in drawings]
    for steps in range(1, len(drawings)):
        found, judged, judged_terms = by_oracle(oracle, folder / "start", steps, count, folder)
        yield from differences(f"{name}, {law}, {steps} steps", "oracle", found, wanted[steps])
    ledgers_of = {"oracle": judged_terms}
    for program in names:
        lines, ledgers_of[program] = told_by(voxmelt, program, scene, steps, folder)
        if lines == judged:
            continue
        yield f"{name}, {law}:\n  {program}: {lines}\n  oracle: {judged}"
        for n in range(1, len(drawings)):
            found = cells_by(voxmelt, program, scene, n, count, folder)
            yield from differences(f"{name}, {law}, {n} steps", program, found, wanted[n])
    for program, ledgers in ledgers_of.items():
        for term, value in terms.items():
            value = 0 if law == "viscous" and TERMS[term][0] == "energy" else value
            if ledgers[term] != value:
                yield f"{name}, {law}: {term} is {ledgers[term]} by {program}, {value} by hand"


def main():
    voxmelt, oracle = sys.argv[1:3]
    names = of_hand_tests(voxmelt, sys.argv)
    wrong = []
    for case in CASES:
        for law in case[1]:
            with tempfile.TemporaryDirectory() as folder:
                wrong += offences_of(voxmelt, oracle, names, law, case, Path(folder))
    print("\n".join(wrong) if wrong else f"{len(CASES)} states are as by hand")
    sys.exit(1 if wrong else 0)


main()
