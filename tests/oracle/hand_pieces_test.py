#!/usr/bin/env python3
"""Pieces fall in small states, step by step, as docs/automaton.md section 15 gives it by hand: every implementation and
the oracle find the same.

  hand_pieces_test.py VOXMELT ORACLE [--all]

No liquid flows and no heat is conducted here, so that nothing but pieces moves. D(0) = 0 and D(2) = 16384.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # a folder of bytecode here would fail oracle.independence
from foreign_fields import CODES, write_fields
from machines import of_hand_tests

RULES = 'flow = { law = "paper", fall = { factor = 0, minimum = 0 }, paper = { share = 0 } }\nheat = { gamma = 0 }\n'
# A sun straight above, that gives each cell it sees 1258 of irradiance, for two steps.
SUN = RULES.replace("gamma = 0", "gamma = 0, visibility_every = 2") + \
      'heat_source = [{ kind = "directional", direction = [0, 1, 0], power = 0.0012 }]\n'
# Kind, amount, energy and heat of the cells in the drawings. Feet are wet from 2048 on.
CELLS = {
    ".": ("air", 0, 0, 0), "#": ("inert", 2048, 0, 0),
    "A": ("solid", 4096, 0, 100), "B": ("solid", 3000, 0, 200), "C": ("solid", 1, 0, 300),
    "D": ("solid", 4096, 0, 178), "E": ("solid", 4096, 0, 256),
    "o": ("liquid", 1000, 500, 30000), "p": ("liquid", 2048, 0, 7), "r": ("liquid", 2047, 0, 11),
    "q": ("liquid", 4096, 11, 9),
}
POOL = ".... .... qqqq qqqq qqqq"  # a slice in front of the cube, and one behind it


def cube(*slices):
    """Drawings of a cube of two cells a side in a pool: both slices through it are alike."""
    return [" / ".join((POOL, one, one, POOL)) for one in slices]


# Name, pieces, border, first step, drawings, how often pieces fall, wade and float by then, and other rules for some. A
# drawing has its rows from the top down, and slashes between the slices z = 0, 1, ... The first one is the start; a step
# leads to the next.
CASES = [
    ("a plate of one cell falls by one cell per step, and lands", "", "closed", 0,
     ["A . . .", ". A . .", ". . A .", ". . . A", ". . . A"], (3, 0, 0)),
    # Neither drop wets a foot. Below A is B, so that o comes out above both. Then B lies on an inert cell.
    ("a piece turns with the drops under it", "in_liquid = 1024", "closed", 1,
     [".. AC Br o. .. ##", ".. or AC B. .. ##", ".. or .. AC B. ##", ".. or .. AC B. ##"], (2, 0, 0)),
    # Both fall at once. The gap closes after the lower one has landed.
    ("two pieces keep their gap while both fall", "", "closed", 0,
     ["A . B . .", ". A . B .", ". . A . B", ". . . A B", ". . . A B"], (5, 0, 0)),
    # A touches the inert cell. B lies across an edge of it, falls, and touches it then.
    ("a piece that touches an inert cell at its side stays", "", "closed", 0,
     ["B.. .#A ... ...", "... B#A ... ...", "... B#A ... ..."], (1, 0, 0)),
    # The drop comes out above A, where the open border takes it in the same step.
    ("the border at the side holds nothing", "", "open", 0, ["A. o. ..", ".. A. ..", ".. .. A.", ".. .. A."], (2, 0, 0)),
    # The roof comes to lie on the post, and the drop in the cage comes out through the roof.
    ("a cage comes to hang on a post", "", "closed", 0,
     ["..... AAAAA Bo..B ..#.. ..#..", "..... .o... AAAAA B.#.B ..#..", "..... .o... AAAAA B.#.B ..#.."], (1, 0, 0)),
    # One of two feet is wet. Nothing beside the piece is in the grid: its layer is not under the surface.
    ("a piece wades every third step", "in_liquid = 3, density = 1.52587890625e-5", "closed", 0,
     ["AB p. q. q. q.", *["p. AB q. q. q."] * 3, *["p. q. AB q. q."] * 3], (0, 2, 0)),
    # Its lower half is under the surface: 65536 x 4 >= 32768 x 8.
    ("a cube of half the density floats", "in_liquid = 1, density = 0.5", "closed", 0,
     cube(".AA. .AA. qqqq qqqq qqqq", *[".qq. .AA. qAAq qqqq qqqq"] * 3), (0, 1, 2)),
    # 65536 x 4 < 32769 x 8.
    ("a slightly denser one sinks by one cell more", "in_liquid = 1, density = 0.50002", "closed", 0,
     cube(".AA. .AA. qqqq qqqq qqqq", ".qq. .AA. qAAq qqqq qqqq", *[".qq. .qq. qAAq qAAq qqqq"] * 2), (0, 2, 1)),
    # One of the two open sides is full: 65536 x 1 >= 65535 x 1.
    ("a piece floats that is wet on half of its sides", "in_liquid = 1, density = 0.99999", "closed", 0,
     ["... pAr .p.", "... pAr .p."], (0, 0, 1)),
    # The layer of A is not under the surface, and so that of B is not either.
    ("a wet layer above a dry one does not float", "in_liquid = 1, density = 0.25", "closed", 0,
     ["... qBq .A. .q.", "... qqq .B. .A."], (0, 1, 0)),
    ("a piece of density 1 never floats", "in_liquid = 1, density = 1.0", "closed", 0,
     ["... pAr .p.", "... ppr .A.", "... ppr .A."], (0, 1, 0)),
    # Step 0 warms A by 1258 / 16 in its new place, rounded down. It falls out of the light, and step 2 casts it anew.
    ("irradiance is cast after the fall, and belongs to places", "", "closed", 0,
     ["A . . .", ". D . .", ". . D .", ". . . E"], (3, 0, 0), SUN),
]


def cells_of(drawing):
    """The size of a drawing, and its cells in the order of their indices."""
    slices = [piece.split()[::-1] for piece in drawing.split("/")]
    size = [len(slices[0][0]), len(slices[0]), len(slices)]
    return size, [CELLS[letter] for rows in slices for row in rows for letter in row]


def fields_of(cells):
    """The values of each field."""
    numbers = dict(zip(("amount", "energy", "heat"), list(zip(*cells))[1:]))
    return {name: list(numbers.get(name, [int(cell[0] == name) for cell in cells])) for name in CODES}


def read_fields(folder, count):
    """The values of each field in a folder of `count` cells."""
    found = {}
    for name, code in CODES.items():
        width = 1 if code == "B" else 2
        data = (folder / f"{name}.npy").read_bytes()[-count * width:]
        found[name] = [int.from_bytes(data[n:n + width], "little") for n in range(0, len(data), width)]
    return found


def drawn(fields, size):
    """What a state looks like; cells that are none of CELLS are question marks."""
    letters = {tuple(value[0] for value in fields_of([cell]).values()): letter for letter, cell in CELLS.items()}
    text = "".join(letters.get(cell, "?") for cell in zip(*fields.values()))
    nx, ny, nz = size
    rows = [text[n:n + nx] for n in range(0, len(text), nx)]
    return " / ".join(" ".join(rows[z * ny:(z + 1) * ny][::-1]) for z in range(nz))


def write_scene(folder, drawing, pieces, border, first, rules):
    size, cells = cells_of(drawing)
    (folder / "fields").mkdir()
    write_fields(folder / "fields", size, fields_of(cells))
    scene = folder / "scene.toml"
    scene.write_text(f'grid = {{ size = {size}, border = "{border}" }}\nstart = {{ fields = "fields", step = {first} }}\n'
                     f"pieces = {{ {pieces} }}\n{rules}")
    return scene


def export(voxmelt, scene, steps, folder, *options):
    subprocess.run([voxmelt, "export", scene, "--quiet", "--steps", str(steps), "--out", folder, *options], check=True)


def offences_of(voxmelt, oracle, names, case, folder):
    name, pieces, border, first, drawings, by_hand, *rules = case
    scene = write_scene(folder, drawings[0], pieces, border, first, *(rules or [RULES]))
    export(voxmelt, scene, 0, folder / "start")
    size, cells = cells_of(drawings[0])
    for steps, drawing in enumerate(drawings[1:], 1):
        found = {}
        for program in names:
            export(voxmelt, scene, steps, folder / f"{program} {steps}", "--implementation", program)
            found[program] = read_fields(folder / f"{program} {steps}", len(cells))
        lines = subprocess.run([oracle, folder / "start", "--steps", str(steps), "--ledger", "--fields", folder / "judged"],
                               check=True, capture_output=True, text=True).stdout.splitlines()
        found["oracle"] = read_fields(folder / "judged", len(cells))
        for program, fields in found.items():
            if fields != fields_of(cells_of(drawing)[1]):
                yield f"{name}, {steps} steps:\n  {program}: {drawn(fields, size)}\n  by hand: {drawing}"
    counts = next(tuple(int(n) for n in line.split()[1:]) for line in lines if line.startswith("pieces"))
    if counts != by_hand:
        yield f"{name}: the oracle counts {counts}, by hand {by_hand}"


def main():
    voxmelt, oracle = sys.argv[1:3]
    names = of_hand_tests(voxmelt, sys.argv)
    wrong = []
    for case in CASES:
        with tempfile.TemporaryDirectory() as folder:
            wrong += offences_of(voxmelt, oracle, names, case, Path(folder))
    print("\n".join(wrong) if wrong else f"{len(CASES)} states are as by hand")
    sys.exit(1 if wrong else 0)


main()
