#!/usr/bin/env python3
"""Bodies of several materials conduct, melt, carry liquid and fall in small states, step by step, as docs/automaton.md
sections 6, 7, 10 and 15 give them by hand: every implementation and the oracle find the same.

  hand_materials_test.py VOXMELT ORACLE [--all]

Where a case has both laws, its liquid has no energy under the viscous one. There kappa is so small that nothing spreads,
unless a case says otherwise. D(0) = 0, D(1) = 32768 and D(2) = 16384.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # a folder of bytecode here would fail oracle.independence
from foreign_fields import CODES, MATERIAL, write_fields
from machines import of_hand_tests

BOTH, PAPER, VISCOUS = ("paper", "viscous"), ("paper",), ("viscous",)
STILL = "fall = { factor = 0, minimum = 0 }"
RESTS = {"paper": "paper = { share = 0 }", "viscous": "viscous = { kappa = 1e-9, substeps = 1 }"}
FLOWS = {"viscous": "viscous = { kappa = 1, substeps = 1 }"}
NOTHING = "heat = { gamma = 0 }\n"
# 65536 gamma / pi is 2048: weight_face of two cells of conductivity 1. So weight_edge is 1024, and weight_corner 682.
GAMMA = "gamma = 0.0981748"
CONDUCTS = f"heat = {{ {GAMMA} }}\n"


def material(melting_point, latent_heat=0, freezing_point=None):
    """`material`, by numbers of the page."""
    freezing = f", freezing_point = {freezing_point / 65535}" if freezing_point else ""
    return f"material = {{ melting_point = {melting_point / 65535}, latent_heat = {latent_heat / 65535}{freezing} }}\n"


def others(*rows):
    """`materials` from 1 on, each by its melting point, latent heat, capacity and conductivity."""
    text = (f'{{ name = "m{n}", melting_point = {Tm / 65535}, latent_heat = {L / 65535}, capacity = {capacity}, conductivity = {k} }}'
            for n, (Tm, L, capacity, k) in enumerate(rows, 1))
    return f"materials = [{', '.join(text)}]\n"


def air(more, bottom):
    """`bottom` is the temperature of the air. air_exchange and air_glow of 0.0625 are 4096 without conduction."""
    return f"heat = {{ gamma = 0, air = {{ bottom = {bottom / 65535}, {more} }} }}\n"


def solid(heat, m=0, amount=4096):
    return "solid", amount, 0, heat, m


def liquid(heat, amount=4096, energy=0):
    return "liquid", amount, energy, heat, 0


def wall(heat):
    return "inert", 2048, 0, heat, 0


CELLS = {".": ("air", 0, 0, 0, 0), "#": wall(0)}
FOREVER = 65535  # a melting point that no heat here reaches
# The middle one conducts three times as well, the last one half as well. The harmonic means 3/2, 2/3 and 6/7 of two
# conductivities give 3072, 1365.3 and 1755.4.
THREE = material(FOREVER) + others((FOREVER, 0, 1, 3), (FOREVER, 0, 1, 0.5))
BETTER = material(FOREVER) + others((FOREVER, 0, 1, 3))
# Its heat is half a degree a unit. So top = 65535 >> 1 = 32767.
TWICE = material(FOREVER) + others((32767, 0, 2, 1))

# Name, laws, rules, flow, drawings, more cells, rows of parameters.json, ledgers by hand in the end.
# A drawing has its rows from the top down, and slashes between the slices z = 0, 1, ... The first one is the start; a step
# leads to the next.
CASES = [
    # 8000 x 3072 / 65536 = 375 and 11000 x 1755 / 65536 = 294.6. Then D(1) adds 1/2: 7544 x 3072 / 65536 = 353.6 and
    # 10787 x 1755 / 65536 = 288.9.
    ("a pair has a weight of its two materials", BOTH, THREE + CONDUCTS, RESTS, ["abc", "def", "ghi"],
     {"a": solid(1000), "b": solid(9000, 1, 1000), "c": solid(20000, 2, 3000), "d": solid(1375), "e": solid(8919, 1, 1000),
      "f": solid(19706, 2, 3000), "g": solid(1729), "h": solid(8854, 1, 1000), "i": solid(19417, 2, 3000)},
     {"weight_face": [[2048, 3072, 1365], [3072, 6144, 1755], [1365, 1755, 1024]]},
     {"conducted": 4096 * 729 - 1000 * 146 - 3000 * 583}),
    # Two of one material: 8000 x 6144 / 65536 = 750 and 8000 x 1024 / 65536 = 125.
    ("two cells of another material have its weight", BOTH, THREE + CONDUCTS, RESTS, ["ab#cd", "ef#gh"],
     {"a": solid(1000, 1), "b": solid(9000, 1), "c": solid(9000, 2), "d": solid(1000, 2), "e": solid(1750, 1),
      "f": solid(8250, 1), "g": solid(8875, 2), "h": solid(1125, 2)}, {}, {"conducted": 0}),
    # A pair of 0 and 1 across an edge has 1536: 8192 x 1536 / 65536 = 192, axis (1, 1, 0) with k = 0.
    ("an edge has a weight of two materials", BOTH, BETTER + CONDUCTS.replace(" }", ", neighbours = 18 }"), RESTS, ["#b a#", "#d c#"],
     {"a": solid(1000, 1), "b": solid(9192), "c": solid(1192, 1), "d": solid(9000)},
     {"weight_edge": [[1024, 1536], [1536, 3072]]}, {"conducted": 0}),
    # 1024 across a corner: 8192 x 1024 / 65536 = 128, axis (1, 1, 1) with k = 0.
    ("a corner has a weight of two materials", BOTH, BETTER + CONDUCTS.replace(" }", ", neighbours = 26 }"), RESTS,
     ["## a# / #b ##", "## c# / #d ##"],
     {"a": solid(1000, 1), "b": solid(9192), "c": solid(1128, 1), "d": solid(9064)},
     {"weight_corner": [[682, 1024], [1024, 2048]]}, {}),
    ("without conductivity nothing is conducted, not from a wall either", BOTH,
     material(FOREVER) + others((FOREVER, 0, 1, 0)) + CONDUCTS, RESTS, ["aebcd"] * 3,
     {"a": wall(50000), "e": solid(60000, 1), "b": solid(1000, 1), "c": solid(30000), "d": solid(30000)},
     {"weight_face": [[2048, 0], [0, 0]]}, {"conducted": 0, "walls": 0}),

    # T of the wall is 50000 - 16384 = 33616, whatever is beside it. -32616 x 6144 / 65536 = -3057.75, and
    # 32616 x 2048 / 65536 = 1019.25. With conductivity 3 and 1 the mean would be 3072.
    ("a wall has the weight of its neighbour, and a temperature of its own", BOTH,
     material(20000, 16384) + others((FOREVER, 0, 1, 3)) + CONDUCTS, RESTS, ["wa#bw", "wc#dw"],
     {"w": wall(50000), "a": solid(1000, 1, 1000), "b": solid(1000, 0, 2000), "c": solid(4058, 1, 1000), "d": solid(2019, 0, 2000)},
     {}, {"walls": 1000 * 3058 + 2000 * 1019, "conducted": 0}),

    # T = 10000: -6000 x 2048 / 65536 = -187.5. Then T = 19813 >> 1 = 9906: -5718 / 32 + 1 / 2 = -178.2.
    ("capacity 2 halves the temperature", BOTH, TWICE + CONDUCTS, RESTS, ["ab", "cd", "ef"],
     {"a": solid(20001, 1), "b": solid(4000, 0, 1000), "c": solid(19813, 1), "d": solid(4188, 0, 1000), "e": solid(19634, 1),
      "f": solid(4367, 0, 1000)}, {"warmth": [65536, 32768]}, {"conducted": -367 * 3096}),
    # 20000 >> 1 = 10000 is its melting point: while it melts, T is no more. F = 20000 + 8192. -6000 / 32 = -187.5.
    ("latent heat of capacity 2", BOTH, material(FOREVER) + others((10000, 8192, 2, 1)) + CONDUCTS, RESTS, ["ab", "cd"],
     {"a": solid(28190, 1), "b": solid(4000), "c": solid(28002, 1), "d": solid(4188)}, {}, {"melted": 0}),
    # T of b is top = 32767, and no more: (32767 - 25000) / 32 = 242.7. That of e is, too, and that of d is 32766.
    ("no temperature is above top", BOTH, TWICE + CONDUCTS, RESTS, ["ab#de", "fg#de"],
     {"a": solid(50001, 1), "b": solid(40000), "d": solid(65533, 1), "e": solid(60000), "f": solid(50243, 1),
      "g": solid(39758)}, {}, {"melted": 0}),
    # A wall is bound, too.
    ("no wall is above top", BOTH, TWICE + CONDUCTS, RESTS, ["wa", "wf"],
     {"w": wall(65535), "a": solid(50001, 1), "f": solid(50244, 1)}, {}, {"walls": 4096 * 243}),
    # T of a is 10000, and that of b 32767. (40000 - 10000) / 16 = 1875 and 7233 / 16 = 452.1.
    ("air sees the temperatures", BOTH, TWICE + air("exchange = 0.0625", 40000), RESTS, ["... / a#b", "... / c#d"],
     {"a": solid(20001, 1), "b": solid(60000), "c": solid(21876, 1), "d": solid(60452)}, {}, {"warmed": 4096 * 2327}),
    # The half cell to the surface conducts as 1/16 and as 3/16 here, in a row with the 1/16 of the air: 1/32 and 3/64. n = 1:
    # 40000 x 2048 / 65536 = 1250 and 40000 x 3072 / 65536 = 1875.
    ("the air reaches a better conductor better", BOTH,
     BETTER + f"heat = {{ {GAMMA}, air = {{ bottom = {50000 / 65535}, exchange = 0.0625 }} }}\n", RESTS, ["... / a#b", "... / c#d"],
     {"a": solid(10000), "b": solid(10000, 1), "c": solid(11250), "d": solid(11875, 1)}, {"air_exchange": [2048, 3072]},
     {"warmed": 4096 * 3125, "conducted": 0}),
    # q(20000) = 6103^2 >> 16 = 568 and q(32767) = 16383^2 >> 16 = 4095: -568 / 16 = -35.5 and -4095 / 16 = -255.9.
    ("glow sees the temperatures", BOTH, TWICE + air("glow = 0.0625", 0), RESTS, ["... / a#b", "... / c#d"],
     {"a": solid(40000, 1), "b": solid(60000), "c": solid(39964, 1), "d": solid(59744)}, {}, {"cooled": 4096 * (36 + 256)}),

    # Solids of material 0 melt from 36384 on, and T = 20000 is theirs until then. b is too warm: 30005 - 30000 + 46384 =
    # 46389 is 30005 in material 0. c is lower: 15007 - 15000 + 10000. d is, without latent heat. e has F = 21000: 21002 -
    # 21000 + 10000. f has the melting point of material 0, and F = 20100: 20150 - 20100 + 20000. g would be 76384.
    ("what melts goes on at its temperature", BOTH,
     material(20000, 16384) + others((30000, 0, 1, 1), (10000, 5000, 1, 1), (10000, 0, 1, 1), (10000, 1000, 2, 1), (20000, 100, 1, 1),
                                     (60000, 0, 1, 1)) + NOTHING, RESTS, ["abcdefghij", "klmnopqhij", "klmnopqhij"],
     {"a": solid(36384), "b": solid(30005, 1, 1000), "c": solid(15007, 2, 2000), "d": solid(10003, 3, 50), "e": solid(21002, 4, 3),
      "f": solid(20150, 5, 700), "g": solid(60000, 6, 9), "h": solid(36383), "i": solid(14999, 2), "j": solid(20999, 4),
      "k": liquid(36384, 4096, 4096), "l": liquid(46389, 1000, 1000), "m": liquid(10007, 2000, 2000), "n": liquid(10003, 50, 50),
      "o": liquid(10002, 3, 3), "p": liquid(20050, 700, 700), "q": liquid(65535, 9, 9)}, {},
     {"melted": 1000 * 16384 - 2000 * 5000 - 3 * 11000 - 700 * 100 + 9 * 5535, "of energy": 4096 + 1000 + 2000 + 50 + 3 + 700 + 9}),
    # T = 16000 - 5000 and -11000 / 16 = -687.5: what melts has 15312 - 15000 + 10000. Then -10312 / 16 + 1 / 2 = -644: it is
    # colder than 10000, and freezes as material 0. -9668 / 16 + 1 / 4 = -604.
    ("what freezes is of material 0", BOTH, material(20000, 0, 10000) + others((10000, 5000, 1, 1)) + air("exchange = 0.0625", 0),
     RESTS, [f". / {letter} / ." for letter in "abcd"],
     {"a": solid(16000, 1), "b": liquid(10312, 4096, 4096), "c": solid(9668), "d": solid(9064)}, {},
     {"melted": -4096 * 5000, "cooled": 4096 * (688 + 644 + 604)}),
    # What is liquid reheats by material 0 alone, whatever it was.
    ("liquid is of material 0", PAPER, material(20000) + others((10000, 0, 1, 1)) + NOTHING, "paper = { share = 0, reheat = 0.5 }",
     ["ab#c", "db#e", "db#f"],
     {"a": solid(12000, 1), "b": liquid(12000, 1000, 100), "c": liquid(20000, 1000, 100), "d": liquid(12000, 4096, 4096),
      "e": liquid(20000, 1000, 550), "f": liquid(20000, 1000, 775)}, {}, {}),

    # F = 38192 of the bed, W = 8192 and lack = 4096: half of it is there, b = 0. The bed is 512 - 256 = 256 and the other one
    # 512, the heads are 256 + 500 and 512 + 125. drop = 119, t = 8, s = 10485 + 4 x 1310 = 15725 and drive = 1827. kappa 1:
    # raw = 3555556 and 222208, limit = 13107, m = 3355392 + 222208, c = 3577600 x 4000 / 4096 = 3493750. D(y) = 32768:
    # w = (3493750 x 1827 + 1024 x 32768) / 2^26 = 95.6. By material 0 the bed would be molten: b = -2048.
    ("a bed of another material", VISCOUS, material(20000) + others((30000, 8192, 1, 1)) + NOTHING, FLOWS, ["ab p#", "cd p#"],
     {"p": solid(34096, 1), "a": liquid(21000, 4000), "b": liquid(21000, 1000), "c": liquid(21000, 3905),
      "d": liquid(21000, 1095)}, {}, {"melted": 0}),
    # F = 60000 and W = ONE: lack = 2048 is half of it.
    ("a bed of capacity 2", VISCOUS, material(20000) + others((30000, 0, 2, 1)) + NOTHING, FLOWS, ["ab p#", "cd p#"],
     {"p": solid(57952, 1), "a": liquid(21000, 4000), "b": liquid(21000, 1000), "c": liquid(21000, 3905),
      "d": liquid(21000, 1095)}, {}, {"melted": 0}),

    # Both fall as one piece, and the drop comes out above.
    ("a piece falls with its materials", BOTH, THREE + NOTHING + "pieces = {}\n", RESTS, ["a b o .", "o a b .", "o . a b", "o . a b"],
     {"a": solid(100, 1), "b": solid(200, 2, 3000), "o": liquid(300, 1000, 500)}, {}, {}),
    ("without heat solids keep their material", BOTH, THREE, RESTS, ["abc", "abc"],
     {"a": solid(0), "b": solid(0, 1), "c": solid(0, 2)}, {}, {}),
]
# The ledger of a term, its name in a report, and its place in the oracle's line.
TERMS = {"conducted": ("heat", "conducted", 1), "walls": ("heat", "walls", 2), "warmed": ("heat", "warmed", 5),
         "cooled": ("heat", "cooled", 6), "melted": ("heat", "melted", 7), "of energy": ("energy", "melted", 1)}
ALL = {**CODES, **MATERIAL}


def cells_of(drawing, letters, law):
    """The size of a drawing, and its cells in the order of their indices. Under the viscous law they have no energy."""
    slices = [piece.split()[::-1] for piece in drawing.split("/")]
    size = [len(slices[0][0]), len(slices[0]), len(slices)]
    cells = [letters[letter] for rows in slices for row in rows for letter in row]
    return size, [(kind, amount, energy if law == "paper" else 0, heat, m) for kind, amount, energy, heat, m in cells]


def fields_of(cells):
    """The values of each field."""
    numbers = dict(zip(("amount", "energy", "heat", "material"), list(zip(*cells))[1:]))
    return {name: list(numbers.get(name, [int(cell[0] == name) for cell in cells])) for name in ALL}


def read_cells(folder, count):
    """(kind, amount, energy, heat, material) of each cell in a folder of fields."""
    found = {}
    for name, code in ALL.items():
        width = 1 if code == "B" else 2
        data = (folder / f"{name}.npy").read_bytes()[-count * width:]
        found[name] = [int.from_bytes(data[n:n + width], "little") for n in range(0, len(data), width)]
    kinds = [" and ".join(name for name in ("solid", "liquid", "inert") if found[name][n]) or "air" for n in range(count)]
    return list(zip(kinds, found["amount"], found["energy"], found["heat"], found["material"]))


def write_scene(folder, size, cells, rules, flow, law):
    (folder / "fields").mkdir()
    write_fields(folder / "fields", size, fields_of(cells))
    scene = folder / "scene.toml"
    scene.write_text(f'grid = {{ size = {size} }}\nstart = {{ fields = "fields" }}\n{rules}'
                     f'flow = {{ law = "{law}", {STILL}, {flow[law] if isinstance(flow, dict) else flow} }}\n')
    return scene


def output(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout.splitlines()


def by_voxmelt(voxmelt, name, scene, steps, count, folder):
    """The cells and the terms after these steps, by this implementation."""
    fields, file = folder / f"{name} {steps}", folder / f"{name}.json"
    output(voxmelt, "export", scene, "--steps", steps, "--quiet", "--implementation", name, "--out", fields)
    output(voxmelt, "digest", scene, "--steps", steps, "--quiet", "--implementation", name, "--report", file)
    report = json.loads(file.read_text())
    return read_cells(fields, count), {term: int(report[of][key]) for term, (of, key, _) in TERMS.items()}


def by_oracle(oracle, start, steps, count, folder):
    lines = output(oracle, start, "--steps", steps, "--ledger", "--fields", folder / "judged")
    ledgers = {line.split()[1]: line.split()[2:] for line in lines if line.startswith("ledger")}
    return read_cells(folder / "judged", count), {term: int(ledgers[of][n]) for term, (of, _, n) in TERMS.items()}


def offences_of(voxmelt, oracle, names, law, case, folder):
    name, _, rules, flow, drawings, more, rows, terms = case
    letters = {**CELLS, **more}
    size, cells = cells_of(drawings[0], letters, law)
    scene = write_scene(folder, size, cells, rules, flow, law)
    output(voxmelt, "export", scene, "--quiet", "--steps", 0, "--out", folder / "start")
    written = json.loads((folder / "start" / "parameters.json").read_text())["materials"]
    for key, values in rows.items():
        if [row[key] for row in written] != values:
            yield f"{name}: {key} is {[row[key] for row in written]}, by hand {values}"
    for steps, drawing in enumerate(drawings[1:], 1):
        wanted = cells_of(drawing, letters, law)[1]
        found = {program: by_voxmelt(voxmelt, program, scene, steps, len(cells), folder) for program in names}
        found["oracle"] = by_oracle(oracle, folder / "start", steps, len(cells), folder)
        for program, (mine, _) in found.items():
            for i, (one, other) in enumerate(zip(mine, wanted)):
                if one != other:
                    yield f"{name}, {law}, {steps} steps, cell {i}:\n  {program}: {one}\n  by hand: {other}"
    for program, (_, judged) in found.items():
        for term, value in terms.items():
            value = 0 if law == "viscous" and TERMS[term][0] == "energy" else value
            if judged[term] != value:
                yield f"{name}, {law}: {term} is {judged[term]} by {program}, {value} by hand"


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
