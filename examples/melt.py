"""The example melts a scene and prints the digest of its state. Equal digests mean equal bits.

  melt.py SCENE.toml STEPS
"""
import sys

import voxmelt

if len(sys.argv) != 3:
    print("melt SCENE.toml STEPS", file=sys.stderr)
    sys.exit(2)
try:
    simulation = voxmelt.Simulation(sys.argv[1])
    simulation.step(int(sys.argv[2]))

    print(simulation.title())
    print(f"step {simulation.steps_done()} digest {simulation.digest():x}")
    sys.exit(0 if simulation.ledgers().balance() else 1)
except voxmelt.Error as error:
    print(error, file=sys.stderr)
    sys.exit(2)
