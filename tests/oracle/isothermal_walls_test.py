#!/usr/bin/env python3
"""One step of the oracle beside isothermal walls gives the heats and terms that were computed by hand.

  isothermal_walls_test.py ORACLE
"""
import json
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # a folder of bytecode here would fail oracle.independence
from foreign_fields import CODES, write_fields


def solid(amount, heat):
    return {"solid": 1, "amount": amount, "heat": heat}


def inert(heat, amount=2048):
    return {"inert": 1, "amount": amount, "heat": heat}


# size, cells, what differs from parameters(), and the heats after the step, the terms `conducted` and `walls`
STATES = {
    # D = bitrev(1) = 32768. From x = 0: F = floor(-7996 / 8 + 1 / 2) = -999; from x = 2: floor(7996 / 8 + 1 / 2) = 1000.
    "a wall on both sides, with dither": (
        [3, 1, 1], [inert(10000), solid(3000, 2004), inert(10000)], {"step": 1},
        [10000, 4003, 10000], 0, 3000 * 1999),
    # The wall at y = 3 has T = 50000 - 16000. F is floor(8006 / 8 + 1 / 3) = 1001 and floor(24994 / 8 + 1 / 3) = 3124.
    "latent heat, matter of another amount, a cell that conducts nothing, a pair of walls": (
        [1, 5, 1], [inert(0), solid(4096, 1000), solid(1000, 9006), inert(50000), inert(1)], {},
        [0, 2001, 11129, 50000, 1], (4096 - 1000) * 1001, 1000 * 3124),
    # Axis (1, -1, 0) leads from the wall to the solid: k = 1 of 6. F = floor(-98 / 16 + 1 / 6) = -6.
    "an edge": (
        [2, 2, 1], [inert(0), solid(5, 1000), inert(1098), inert(0)], {"neighbours": 18},
        [0, 1006, 1098, 0], 0, 5 * 6),
    # Axis (1, 1, -1) leads from the solid to the wall: k = 1 of 4. F = floor(-40 / 32 + 1 / 4) = -1.
    "a corner, a wall that takes": (
        [2, 2, 2], [*[inert(0)] * 3, inert(960), solid(7, 1000), *[inert(0)] * 3], {"neighbours": 26},
        [0, 0, 0, 960, 999, 0, 0, 0], 0, -7),
}
REFUSED = {  # size, cells, what differs, what the oracle says
    "a wall without a bed offset": ([1, 1, 1], [inert(9, amount=0)], {}, "heat without amount"),
    "a wall that is not announced": ([1, 1, 1], [inert(9)], {"walls": False}, "an isothermal wall without heat.walls"),
    "an announced wall that is not there": ([1, 1, 1], [inert(0)], {}, "heat.walls, but no isothermal wall"),
}


def parameters(size, step=0, neighbours=6, walls=True):
    return {
        "grid": size, "border": "closed", "step": step, "seed": 1, "material": {"melting_point": 20000, "latent_heat": 16000, "freezing_point": 0}, "materials": [],
        "heat": {"enabled": True, "neighbours": neighbours, "weight_face": 8192, "weight_edge": 4096, "weight_corner": 2048,
                 "convection": 0, "walls": walls, "radiation": False, "air": False},
        "pieces": {"fall": False, "in_liquid": 1, "density": 65536}, "vents": [], "drains": [],
        "flow": {"law": "viscous", "fall": {"factor": 0, "wall_factor": 0, "minimum": 0, "hang": 0},
                 "viscous": {"mobility": 0, "yield": 0, "stiffness": 1, "substeps": 1, "substeps_max": 1, "stages_max": 1}, "thermal_viscosity": False}}


def run(oracle, folder, size, cells, changes):
    """Exit status, what the oracle says, and its folder of fields."""
    start, end = folder / "start", folder / "end"
    start.mkdir(parents=True)
    (start / "parameters.json").write_text(json.dumps(parameters(size, **changes)))
    write_fields(start, size, {name: [cell.get(name, 0) for cell in cells] for name in CODES})
    done = subprocess.run([oracle, start, "--steps", "1", "--ledger", "--fields", end], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr, end


def main():
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for name, (size, cells, changes, heats, conducted, walls) in STATES.items():
            status, text, end = run(sys.argv[1], Path(folder) / name, size, cells, changes)
            if status != 0:
                wrong.append(f"{name}: ended with {status}: {text}")
                continue
            found = struct.unpack(f"<{len(cells)}H", (end / "heat.npy").read_bytes()[-2 * len(cells):])
            terms = [int(word) for line in text.splitlines() if line.startswith("ledger heat") for word in line.split()[3:5]]
            if list(found) != heats or terms != [conducted, walls]:
                wrong.append(f"{name}: {list(found)}, {terms}; by hand {heats}, {[conducted, walls]}")
        for name, (size, cells, changes, says) in REFUSED.items():
            status, text, _ = run(sys.argv[1], Path(folder) / name, size, cells, changes)
            if status != 1 or says not in text:
                wrong.append(f"{name}: not refused: {status}, {text}")
    print("\n".join(wrong) if wrong else f"{len(STATES)} states are those by hand, {len(REFUSED)} are refused")
    sys.exit(1 if wrong else 0)


main()
