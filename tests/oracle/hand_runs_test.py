#!/usr/bin/env python3
"""One step of small viscous states, as docs/automaton.md gives them by hand: the program and the oracle find the same.

  hand_runs_test.py VOXMELT ORACLE

Nothing conducts here (weights of 0). With kappa = 0.05 mobility_parameter is 11651. So raw is 43, 728, 1124 and 2913
at depths of 62, 256, 318 and 512. D(0) = 0, D(1) = 32768 and D(6) = 24576.
"""
import json
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

FIELDS = {"solid": "B", "liquid": "B", "inert": "B", "amount": "H", "energy": "H", "heat": "H"}
VISCOUS = 'flow = { law = "viscous", viscous = { kappa = 0.05 } }\nheat = { gamma = 1e-9 }\n'
# The mobility doubles from each entry of the table to the next.
THERMAL = VISCOUS.replace(" } }\nheat", " }, thermal = { reference = 0.03125, doubling = 0.03125 } }\nheat")
AIR, HIGH, LOW, FLAT = ("air", 0, 0), ("inert", 3840, 0), ("inert", 240, 0), ("inert", 2048, 0)


def liquid(amount, heat):
    return "liquid", amount, heat


def column(*cells, air=0):
    return [1, len(cells) + air, 1], [liquid(*cell) for cell in cells] + [AIR] * air


# The table at the mean heat of 2047 is that of entry 0: this is what the flank of the last case gets per cell.
def thermal_flank(parameters):
    raw = (2913 * parameters["flow"]["mobility_table"][0]) >> 15
    w = (raw * 8192 + 4 * 32768) >> 18  # D(1, 0, 4) = 32768
    return [(4096 - w, 2047), (2 * w, 2048), (4096 - w, 2048), (0, 0)]


# Name, size, cells (x fastest, then y), scene, first step, expected amounts and heats of the cells with matter.
CASES = [
    # down_1 = 2048: (4096 x 2000 + 2048 x 3000) / 6144 = 2333.3; then down_0 = 2048: (2048 x 1000 + 2048 x 2333) / 4096.
    ("a deficit moves down, from the top on", *column((2048, 1000), (4096, 2000), (4096, 3000)), VISCOUS, 0,
     [(4096, 1666), (4096, 2333), (2048, 3000)]),
    # With D = 32768 half a cell is added: 2333.8, and then (2048 x 3333 + 2048) / 4096 = 1667.
    ("each flow is dithered", *column((2048, 1000), (4096, 2000), (4096, 3000)), VISCOUS, 1,
     [(4096, 1667), (4096, 2333), (2048, 3000)]),
    # up_0 = 5904: (100 x 1000 + 5904 x 50000) / 6004 = 49183.9; up_1 = 1908 of that.
    ("an excess moves up, from the bottom on", *column((10000, 50000), (100, 1000), air=2), VISCOUS, 0,
     [(4096, 50000), (4096, 49183), (1908, 49183), (0, 0)]),
    # up_1 = 6144: (100 x 9000 + 6144 x 2000) / 6244 = 2112.1; up_2 = 2148 of that; down_0 = 2048: (1000 + 2000) / 2.
    ("up and down in one run", *column((2048, 1000), (12288, 2000), (100, 9000), air=3), VISCOUS, 0,
     [(4096, 1500), (4096, 2000), (4096, 2112), (2148, 2112), (0, 0), (0, 0)]),
    # e_0 = e_1 = 61439: (4096 x 20000 + 61439 x 40000) / 65535 = 38749.98.
    ("an excess of AMAX - ONE keeps the order", *column((65535, 40000), (4096, 20000), air=15), VISCOUS, 0,
     [(4096, 40000)] + [(4096, 38749)] * 15 + [(4095, 38749)]),
    # e_1 = 61440: (65535 x 40000 + 4097 x 20000) / 69632 = 38823.2.
    ("one more mixes the run", *column((65535, 40000), (4097, 20000), air=15), VISCOUS, 0, [(4096, 38823)] * 17),
    # e_29 = 61441 - 30 ONE = -61439, M = 65537. Only cell 0 is of another heat than what comes down.
    ("a deficit of AMAX - ONE keeps the order",
     *column((2048, 1000), *[(2048, 2000)] * 28, (2049, 2000), (4096, 2000)), VISCOUS, 0,
     [(4096, 1500)] + [(4096, 2000)] * 15 + [(1, 2000)] + [(0, 0)] * 14),
    # e_29 = -61440: (2048 x 1000 + 63488 x 2000) / 65536 = 1968.75.
    ("one less mixes the run", *column((2048, 1000), *[(2048, 2000)] * 29, (4096, 2000)), VISCOUS, 0,
     [(4096, 1968)] * 16 + [(0, 0)] * 15),
    # over = 4096 comes to lie in the upper cell: (8192 x 1000 + 4096 x 4000) / 12288 = 2000.
    ("a run under a ceiling is mixed", [1, 2, 1], [liquid(8192, 1000), liquid(4096, 4000)], VISCOUS, 0,
     [(4096, 2000), (8192, 2000)]),
    # Beds 368 and 143: t = 23 - 8 = 15. drive = 5941 x 256 >> 9 = 2970, c = 728 + 43, and 771 x 2970 >> 18 = 8.
    ("a slope slows the flow along x", [2, 3, 1], [HIGH, LOW, liquid(4096, 7), liquid(1000, 9), AIR, AIR], VISCOUS, 0,
     [(4088, 7), (1008, 8), (0, 0), (0, 0)]),
    # R = 32768: (771 x 2970 + 4 R) >> 18 = 9. The heat: (9000 + 63 + 504) / 1009 = 9.5.
    ("a flow is dithered", [2, 3, 1], [HIGH, LOW, liquid(4096, 7), liquid(1000, 9), AIR, AIR], VISCOUS, 1,
     [(4087, 7), (1009, 9), (0, 0), (0, 0)]),
    # Beds 368 and 0: t = 16. Heads 624 and 318, drive = 5461 x 256 >> 9 = 2730, (728 + 1124) x 2730 >> 18 = 19.
    ("a slope of more than 1 is cut", [2, 2, 1],
     [HIGH, liquid(4096, 9), liquid(4096, 7), liquid(1000, 9)], VISCOUS, 0,
     [(4096, 9), (4077, 7), (1019, 8)]),
    # +z to the air on a flat bed: t = 7, drive = 11848 x 256 >> 9 = 5924, R = 40960: (728 x 5924 + 4 R) >> 18 = 17.
    # +x+z: t = 15, drive = 2331 x 362 >> 9 = 1648, R = 57344: (771 x 1648 + 16 R) >> 20 = 2.
    ("a slope slows the flow along a diagonal", [2, 2, 2],
     [HIGH, FLAT, liquid(4096, 7), FLAT, FLAT, LOW, AIR, liquid(1000, 9)], VISCOUS, 6,
     [(4077, 7), (17, 7), (1002, 9)]),
    # Head 880, and 2913 x 8192 >> 18 = 91: both cells beside it lie over air, so t = 0. Then both flows fall.
    ("a flank above air shows no bed", [2, 3, 1], [HIGH, AIR, liquid(4096, 7), AIR, liquid(4096, 7), AIR], VISCOUS, 0,
     [(91, 7), (4005, 7), (91, 7), (4005, 7), (0, 0)]),
    # t = 15 at both heights. Into the run: (2730 + 43) x 2970 >> 18 = 31. Above it: (2913 + 43) x 2970 >> 18 = 33,
    # which then falls: (1031 x 8 + 33 x 7) / 1064 = 7.97.
    ("a cell above a run shows its bed", [2, 3, 1],
     [HIGH, LOW, liquid(4096, 7), liquid(1000, 9), liquid(4096, 7), AIR], VISCOUS, 0,
     [(4065, 7), (1064, 7), (4063, 7), (0, 0)]),
    # The falling half mixes with the other: (2047 + 2048) / 2, and half a cell by D(1) = 32768.
    ("the mobility goes by the mean heat without dither", [2, 2, 1],
     [liquid(4096, 2047), AIR, liquid(4096, 2048), AIR], THERMAL, 1, thermal_flank),
]


def write_field(path, code, size, values):
    header = f"{{'descr': '{'|u1' if code == 'B' else '<u2'}', 'fortran_order': False, 'shape': {tuple(size[::-1])}, }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
                     + struct.pack(f"<{len(values)}{code}", *values))


def read_field(path):
    data = path.read_bytes()
    begin = 10 + struct.unpack("<H", data[8:10])[0]
    return struct.unpack(f"<{(len(data) - begin) // 2}H", data[begin:])


def write_scene(folder, size, cells, rules, first):
    (folder / "fields").mkdir()
    for name, code in FIELDS.items():
        values = {"amount": [cell[1] for cell in cells], "heat": [cell[2] for cell in cells], "energy": [0] * len(cells)}
        write_field(folder / "fields" / f"{name}.npy", code, size,
                    values.get(name, [int(cell[0] == name) for cell in cells]))
    scene = folder / "scene.toml"
    scene.write_text(f'grid = {{ size = {size} }}\nstart = {{ fields = "fields", step = {first} }}\n{rules}')
    return scene


def after_one_step(voxmelt, oracle, folder, scene):
    """The parameters, and (amount, heat) of all cells by the oracle and by the program."""
    start, judged, mine = folder / "start", folder / "judged", folder / "mine"
    export = [voxmelt, "export", scene, "--quiet", "--implementation", "reference"]
    subprocess.run([*export, "--steps", "0", "--out", start], check=True)
    subprocess.run([*export, "--steps", "1", "--out", mine], check=True)
    subprocess.run([oracle, start, "--steps", "1", "--fields", judged], check=True, stdout=subprocess.DEVNULL)
    states = {name: list(zip(read_field(where / "amount.npy"), read_field(where / "heat.npy")))
              for name, where in (("oracle", judged), ("voxmelt", mine))}
    return json.loads((start / "parameters.json").read_text()), states


def main():
    voxmelt, oracle = sys.argv[1:]
    wrong = 0
    for name, size, cells, rules, first, expected in CASES:
        with tempfile.TemporaryDirectory() as folder:
            scene = write_scene(Path(folder), size, cells, rules, first)
            parameters, states = after_one_step(voxmelt, oracle, Path(folder), scene)
        by_hand = expected(parameters) if callable(expected) else expected
        for program, state in states.items():
            found = [pair for pair, cell in zip(state, cells) if cell[0] != "inert"]
            if found != by_hand:
                wrong += 1
                print(f"{name}:\n  {program} {found}\n  by hand {by_hand}")
    if wrong:
        sys.exit(1)
    print(f"{len(CASES)} states are as by hand")


main()
