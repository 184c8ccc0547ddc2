"""A torch in the user's hand circles above the scene. After the first half turn a vent pours from it, too.

  torch.py SCENE.toml TURNS
"""
import math
import sys

import voxmelt

STEPS_PER_TURN, STEPS_PER_MOVE = 64, 8  # by default, shadows are cast every 8th step

if len(sys.argv) != 3:
    print("torch SCENE.toml TURNS", file=sys.stderr)
    sys.exit(2)
try:
    simulation = voxmelt.Simulation(sys.argv[1])
    grid = simulation.grid()
    for step in range(0, STEPS_PER_TURN * int(sys.argv[2]), STEPS_PER_MOVE):
        angle = 2 * math.pi * step / STEPS_PER_TURN
        x, y, z = grid.x * (0.5 + 0.4 * math.cos(angle)), grid.y, grid.z * (0.5 + 0.4 * math.sin(angle))
        simulation.set_heat_sources([voxmelt.HeatSource.fixed((x, y, z), power=60)])
        vent = voxmelt.Vent((x, y - 4, z), radius=3, rate=0.2, temperature=0.8)
        simulation.set_vents([] if angle < math.pi else [vent])
        simulation.step(STEPS_PER_MOVE)

    books = simulation.ledgers()
    for term in books.mass.terms:
        print("mass", term.name, term.value)
    print("liquid cells", simulation.state().liquid.sum())
    sys.exit(0 if books.balance() else 1)
except voxmelt.Error as error:
    print(error, file=sys.stderr)
    sys.exit(2)
