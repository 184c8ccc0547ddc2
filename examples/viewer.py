"""The example is the heart of a viewer, without a window. It draws frames from a camera that moves, steps until somebody
stops it, tells what lies under the pointer, and saves the run.

  viewer.py SCENE.toml FRAMES > frames.ppm
"""
import sys
import threading

import voxmelt

if len(sys.argv) != 3:
    print("viewer SCENE.toml FRAMES > frames.ppm", file=sys.stderr)
    sys.exit(2)
try:
    simulation = voxmelt.Simulation(sys.argv[1])
    picture = voxmelt.Picture(camera=simulation.camera(), width=320, height=240)
    for k in range(int(sys.argv[2])):
        frame = simulation.render(picture)
        sys.stdout.buffer.write(b"P6 %d %d 255\n" % (frame.width, frame.height) + frame.rgb.tobytes())
        hit = simulation.pick(160, 120, picture)
        if hit:
            cell = hit.matter
            print(f"in the middle: cell {cell.x} {cell.y} {cell.z}, {hit.depth:g} cells away", file=sys.stderr)
        camera = picture.camera
        picture = picture.replace(camera=camera.replace(azimuth=camera.azimuth + 5, distance=camera.distance * 0.98))

        user = threading.Event()  # stands for a user who presses a key after ten steps
        simulation.step(1000000, stop=user, progress=lambda done, count: user.set() if done == 10 else None)
    simulation.save("viewer.vxc")
    print(f"at step {voxmelt.Simulation('viewer.vxc').steps_done()}, saved", file=sys.stderr)
except voxmelt.Error as error:
    print(error, file=sys.stderr)
    sys.exit(2)
