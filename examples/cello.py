import voxmelt

cello = voxmelt.Simulation("scenes/cello.toml")
cello.step(600)
cello.draw("cello.png")
