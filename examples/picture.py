"""The example draws a scene while it melts, into the files picture_0.png, picture_1.png and so on.

  picture.py SCENE.toml PICTURES STEPS_BETWEEN
"""
import sys

import voxmelt

if len(sys.argv) != 4:
    print("picture SCENE.toml PICTURES STEPS_BETWEEN", file=sys.stderr)
    sys.exit(2)
try:
    simulation = voxmelt.Simulation(sys.argv[1])
    picture = voxmelt.Picture(width=320, height=240)
    for k in range(int(sys.argv[2])):
        simulation.draw(f"picture_{k}.png", picture.replace(azimuth=10 * k))
        simulation.step(int(sys.argv[3]))
except voxmelt.Error as error:
    print(error, file=sys.stderr)
    sys.exit(2)
