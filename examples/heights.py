"""The example reads the state as arrays. It prints how much liquid stands above each cell of the ground, as a PGM picture.

  heights.py SCENE.toml STEPS > heights.pgm
"""
import sys

import numpy
import voxmelt

if len(sys.argv) != 3:
    print("heights SCENE.toml STEPS > heights.pgm", file=sys.stderr)
    sys.exit(2)
try:
    simulation = voxmelt.Simulation(sys.argv[1])
    simulation.step(int(sys.argv[2]))

    state = simulation.state()  # arrays [z, y, x]; 4096 is a full cell
    liquid = numpy.where(state.liquid, state.amount, 0).sum(axis=1, dtype=int)
    print("P2", state.grid.x, state.grid.z, "255")
    for amount in liquid.flat:
        print(min(255, amount // 256))
except voxmelt.Error as error:
    print(error, file=sys.stderr)
    sys.exit(2)
