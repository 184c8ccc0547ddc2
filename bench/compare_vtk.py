#!/usr/bin/python3
"""Draws scenes with VTK's fixed-point volume caster and with ours, and compares times and errors.

  xvfb-run -a bench/compare_vtk.py [SCENE ...] [--rounds 12] [--beside build/release/bench/beside_vtk]

It is slow, and no part of any test. It wants the Debian packages python3-vtk9, python3-numpy and xvfb, and
the target beside_vtk. Both draw the same filtered field from the same camera, 512 x 512, on one thread.
VTK draws matter alone, lit, without shadows, ground or antialiasing; ours has all of them. Times are
processor time of the drawing thread, the least of many, taken in turn. What VTK's window costs when it
shows nothing is not counted. Errors are PSNR in dB, of each against its own converged picture: VTK's at a
step of 1/20 cell, ours from the definition in double with the same samples a pixel.

Prints a table, and writes it to bench/performance_vtk.md, from where it comes into docs.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STEPS = (1, 1 / 2)  # in cells
CONVERGED = 1 / 20
RAMP = 1 / 16  # of a full cell's value: the opacity rises from 0 to 1 around half of it
GOALS = {"fast": 15, "normal": 10}
ALLOWANCE = {"avx512": 1, "avx2": 1.3, "sse4.2": 2.5}


def give_up(why):
    print(f"compare_vtk.py: error: {why}", file=sys.stderr)
    sys.exit(2)


def need(module, package):
    try:
        return __import__(module)
    except ImportError:
        give_up(f"{sys.executable} has no module {module}: apt-get install {package}, and use /usr/bin/python3")


class Vtk:
    """One scene in a window of VTK."""

    def __init__(self, vtk, numpy, scene, field):
        from vtk.util import numpy_support
        self.vtk, self.numpy, self.support = vtk, numpy, numpy_support
        image = vtk.vtkImageData()
        image.SetDimensions(*scene["grid"])
        image.SetOrigin(0.5, 0.5, 0.5)  # the middle of a cell
        image.GetPointData().SetScalars(
            numpy_support.numpy_to_vtk(field, deep=True, array_type=vtk.VTK_UNSIGNED_SHORT))
        self.mapper = vtk.vtkFixedPointVolumeRayCastMapper()
        self.mapper.SetInputData(image)
        self.mapper.SetNumberOfThreads(1)
        self.mapper.AutoAdjustSampleDistancesOff()
        self.mapper.IntermixIntersectingGeometryOff()
        self.volume = vtk.vtkVolume()
        self.volume.SetMapper(self.mapper)
        look, half = self.volume.GetProperty(), scene["full"] / 2
        opacity, color = vtk.vtkPiecewiseFunction(), vtk.vtkColorTransferFunction()
        for value, share in ((0, 0), (half * (1 - RAMP), 0), (half * (1 + RAMP), 1), (scene["full"], 1)):
            opacity.AddPoint(value, share)
        color.AddRGBPoint(0, *scene["color"])
        look.SetScalarOpacity(opacity)
        look.SetColor(color)
        look.SetInterpolationTypeToLinear()
        look.ShadeOn()
        look.SetAmbient(0.35)
        look.SetDiffuse(0.65)
        look.SetSpecular(0.4)
        look.SetSpecularPower(40)
        renderer = vtk.vtkRenderer()
        renderer.SetBackground(0.93, 0.94, 0.96)
        renderer.AddVolume(self.volume)
        camera, eye, forward = renderer.GetActiveCamera(), scene["eye"], scene["forward"]
        camera.SetPosition(*eye)
        camera.SetFocalPoint(*(e + 100 * f for e, f in zip(eye, forward)))
        camera.SetViewUp(*scene["up"])
        camera.SetViewAngle(scene["view_angle"])
        renderer.ResetCameraClippingRange()
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetSize(scene["side"], scene["side"])
        self.window.AddRenderer(renderer)
        self.render(1)

    def render(self, step):
        self.mapper.SetSampleDistance(step)
        self.mapper.Modified()
        begin = time.thread_time()
        self.window.Render()
        return 1e3 * (time.thread_time() - begin)

    def render_nothing(self):
        self.volume.VisibilityOff()
        milliseconds = self.render(1)
        self.volume.VisibilityOn()
        return milliseconds

    def picture(self, step):
        self.render(step)
        grab = self.vtk.vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.Update()
        bytes_ = self.support.vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
        return bytes_.astype(self.numpy.float64)

    def error(self, step, converged):
        square = ((self.picture(step) - converged) ** 2).mean()
        return 10 * math.log10(255 ** 2 / square) if square > 0 else math.inf


def compared(name, arguments, vtk, numpy):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "field"
        ours = subprocess.Popen([arguments.beside, name, str(file)], stdin=subprocess.PIPE,
                                stdout=subprocess.PIPE, text=True)
        line = ours.stdout.readline()
        if not line:
            sys.exit(ours.wait() or 1)
        scene = json.loads(line)
        theirs = Vtk(vtk, numpy, scene, numpy.fromfile(file, dtype=numpy.uint16))
        converged = theirs.picture(CONVERGED)
        if arguments.picture:
            show = vtk.vtkWindowToImageFilter()
            show.SetInput(theirs.window)
            show.ReadFrontBufferOff()
            writer = vtk.vtkPNGWriter()
            writer.SetFileName(f"{arguments.picture}_{name}.png")
            writer.SetInputConnection(show.GetOutputPort())
            writer.Write()
        result = {"scene": name, "ours_db": scene["db"],
                  "vtk_db": {step: theirs.error(step, converged) for step in STEPS}}
        least, nothing = dict.fromkeys(STEPS, math.inf), math.inf
        for _ in range(arguments.rounds):
            nothing = min(nothing, theirs.render_nothing())
            for step in STEPS:
                least[step] = min(least[step], theirs.render(step), theirs.render(step))
            ours.stdin.write("draw\n")
            ours.stdin.flush()
            result["ours_ms"] = json.loads(ours.stdout.readline())
        ours.stdin.close()
        ours.wait()
        result["vtk_ms"] = {step: ms - nothing for step, ms in least.items()}
        return result


def report(results):
    rows = ["| scene | drawn by | ms | dB | VTK at step 1/2 takes | goal |", "|---|---|--:|--:|--:|--:|"]
    for of in results:
        title = f"`{of['scene']}`"
        for step in STEPS:
            rows.append(f"| {title} | VTK, step {step:g} | {of['vtk_ms'][step]:.1f} | {of['vtk_db'][step]:.1f} | | |")
            title = ""
        for name, ms in of["ours_ms"].items():
            for setting, goal in GOALS.items():
                times = of["vtk_ms"][1 / 2] / ms[setting]
                rows.append(f"| | {name}, `{setting}` | {ms[setting]:.2f} | {of['ours_db'][setting]:.1f} | "
                            f"{times:.1f} times | {goal / ALLOWANCE.get(name, 1):.1f} |")
    return "\n".join(rows)


def main():
    parser = argparse.ArgumentParser(description="compares the picture with VTK's")
    parser.add_argument("scenes", nargs="*", default=["cello", "goblet"])
    parser.add_argument("--rounds", type=int, default=12)
    parser.add_argument("--beside", default=str(ROOT / "build/release/bench/beside_vtk"))
    parser.add_argument("--picture", help="also write VTK's converged pictures: PICTURE_SCENE.png")
    parser.add_argument("--out", default=str(ROOT / "bench/performance_vtk.md"))
    arguments = parser.parse_args()
    vtk, numpy = need("vtk", "python3-vtk9"), need("numpy", "python3-numpy")
    if not Path(arguments.beside).exists():
        give_up(f"there is no {arguments.beside}: cmake --build --preset release --target beside_vtk")
    if not os.environ.get("DISPLAY"):  # VTK would abort
        give_up("VTK wants a display: apt-get install xvfb, and run this by xvfb-run -a")
    table = report([compared(name, arguments, vtk, numpy) for name in arguments.scenes])
    version = vtk.vtkVersion().GetVTKVersion()
    text = f"{table}\n\nWritten by `bench/compare_vtk.py` with VTK {version} on {date.today()}.\n"
    Path(arguments.out).write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()
