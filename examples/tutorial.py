"""A first half hour with voxmelt in Python. Editors that know `# %%` run it cell by cell."""
# %% The scene is a file; docs/scenes.md has all its keys. Keys can be changed when it is opened.
import sys
from pathlib import Path

import numpy
import voxmelt

scenes = Path(sys.argv[1] if len(sys.argv) > 1 else "scenes")
bunny = voxmelt.Simulation(scenes / "bunny_small.toml", overrides=["heat.gamma=0.1"])
print(bunny.title())
print(bunny.grid(), "on", bunny.threads(), "threads of", bunny.implementation())

# %% It melts. A state is good until the next step, and its fields are arrays [z, y, x] of one's own.
steps, heights, molten = [], [], []
for state in bunny.run(400, every=20):
    solid = state.solid
    rows = numpy.flatnonzero(solid.any(axis=(0, 2)))  # y is up
    steps.append(bunny.steps_done())
    heights.append(int(rows[-1]) + 1 if rows.size else 0)
    molten.append(state.liquid.sum() / max(1, state.liquid.sum() + solid.sum()))
print("top of the solid:", heights)
print("melting front: half is liquid after step", steps[int(numpy.searchsorted(molten, 0.5))])

# %% The books balance to the unit: 4096 is a full cell.
books = bunny.ledgers()
assert books.balance()
print("mass", books.mass.held / 4096, "cells;", {term.name: term.value for term in books.mass.terms})

# %% Pictures are arrays, too, and files.
x, y, z = bunny.grid().x, bunny.grid().y, bunny.grid().z
side = voxmelt.Picture(width=320, height=240, camera=voxmelt.Camera((x / 2, y / 3, z / 2), distance=90, azimuth=60))
frame = bunny.render(side)
print("picture", frame.rgb.shape, "mean colour", frame.rgb.mean(axis=(0, 1)).round())
bunny.draw("bunny.png", side)

# %% What acts from outside may change between two steps. Then the run goes back to its beginning.
bunny.restart()
bunny.set_heat_sources([voxmelt.HeatSource.fixed((x + 20, y, z / 2), power=900)])
bunny.pour((x / 2, y - 3, z / 2), radius=2.5, temperature=0.9)
bunny.step(100)
warm = bunny.state().heat.max(axis=1)  # seen from above
print("from the side: hottest column at z, x =", numpy.unravel_index(warm.argmax(), warm.shape))

# %% A checkpoint goes on elsewhere, with the same bits.
bunny.save("bunny.vxc")
again = voxmelt.Simulation("bunny.vxc")
again.step(50)
bunny.step(50)
assert again.digest() == bunny.digest()
print(f"step {again.step_number()} digest {again.digest():016x}")

# %% The front as a plot, where matplotlib is there (apt-get install python3-matplotlib).
try:
    import matplotlib
except ImportError:
    print("no matplotlib: no plot")
else:
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.5))
    left.plot(steps, heights, label="top of the solid, cells")
    left.plot(steps, numpy.array(molten) * max(heights), label="liquid, of all matter")
    left.set_xlabel("step")
    left.legend()
    right.imshow(frame.rgb)
    right.axis("off")
    figure.savefig("front.png", dpi=100)
