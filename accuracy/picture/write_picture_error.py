#!/usr/bin/env python3
"""Writes docs/results/picture-error.md and docs/gallery/picture-error.svg from a run of picture_error.

  write_picture_error.py [PICTURE_ERROR] [--causes-views 2] [further options of picture_error]
  write_picture_error.py --from MAIN.csv CAUSES.csv

The first form measures: 20 views of six scenes, then the causes on the first few views. It takes some
minutes. The second one takes results that picture_error has printed before.
"""
import math
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TEMPLATE = ROOT / "accuracy/picture/picture_error_template.md"
SETTINGS, STEPS = ("fast", "normal", "best"), ("1/2", "1/4", "1/8")
OWN_STEP = {"fast": "1/4", "normal": "1/4", "best": "1/8"}
GOALS = {"fast": None, "normal": 47, "best": 53}


class Rows:
    """Lines of picture_error: by drawing, and by drawing and scene."""

    def __init__(self, text):
        self.of, self.scene, self.samples, self.ms = (defaultdict(list) for _ in range(4))
        self.views, self.scenes, self.drawings = set(), [], []
        lines = text.splitlines()
        names = lines[0].split(",")
        for line in lines[1:]:
            scene, view, azimuth, elevation, drawing, *rest = line.split(",")
            numbers = dict(zip(names[5:], rest))
            if scene not in self.scenes:
                self.scenes.append(scene)
            if drawing not in self.drawings:
                self.drawings.append(drawing)
            self.views.add(int(view))
            one = (float(numbers["db"]), f"{scene}, azimuth {float(azimuth) % 360:.0f}, elevation {elevation}")
            self.of[drawing].append(one)
            self.scene[drawing, scene].append(one)
            self.samples[drawing].append(float(numbers["samples"]))
            if "ms" in numbers:
                self.ms[drawing].append(float(numbers["ms"]))

    @staticmethod
    def mean(numbers):
        return sum(numbers) / len(numbers)

    def error(self, key):
        rows = self.scene[key] if isinstance(key, tuple) else self.of[key]
        return self.mean([db for db, _ in rows]), min(rows)

    def time(self, drawing):
        return f"{self.mean(self.ms[drawing]):.1f}" if self.ms[drawing] else "–"


def table(head, rows, left=1):
    marks = ["---"] * left + ["--:"] * (len(head) - left)
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, *rows]).replace(
        "\n", "\n|" + "|".join(marks) + "|\n", 1)


def goals(main):
    rows = []
    for setting, goal in GOALS.items():
        drawing = f"{setting} {OWN_STEP[setting]}"
        mean, (worst, where) = main.error(drawing)
        rows.append([f"`{setting}`", OWN_STEP[setting], f"{mean:.1f}", f"{worst:.1f}", where,
                     str(goal) if goal else "–", "–" if not goal else "yes" if mean >= goal else "**no**",
                     "–" if not goal else "yes" if worst >= goal else "**no**"])
    return table(["setting", "step", "mean dB", "worst dB", "worst view", "goal", "mean holds", "worst holds"], rows, 2)


def scenes(main):
    rows = []
    for scene in main.scenes:
        cells = []
        for setting in SETTINGS:
            mean, (worst, _) = main.error((f"{setting} {OWN_STEP[setting]}", scene))
            cells.append(f"{mean:.1f} / {worst:.1f}")
        rows.append([scene, *cells])
    return table(["scene", *(f"`{s}`" for s in SETTINGS)], rows)


def steps(main):
    rows = []
    for setting in SETTINGS:
        for step in STEPS:
            drawing = f"{setting} {step}"
            mean, (worst, _) = main.error(drawing)
            rows.append([f"`{setting}`", step, f"{mean:.2f}", f"{worst:.2f}",
                         f"{main.mean(main.samples[drawing]):.2f}", main.time(drawing)])
    return table(["setting", "step", "mean dB", "worst dB", "samples a pixel", "ms"], rows, 2)


def causes(run):
    rows = []
    for drawing in run.drawings:
        mean, (worst, _) = run.error(drawing)
        rows.append([drawing, f"{mean:.2f}", f"{worst:.2f}", f"{run.mean(run.samples[drawing]):.2f}"])
    return table(["picture", "mean dB", "worst dB", "samples a pixel"], rows)


def plot(main):
    """Mean error against time, or against samples a pixel until times are measured."""
    timed = any(main.ms.values())
    points = []
    for setting in SETTINGS:
        for step in STEPS:
            drawing = f"{setting} {step}"
            across = main.mean(main.ms[drawing] if timed else main.samples[drawing])
            points.append((setting, step, across, main.error(drawing)[0]))
    low = 2 ** math.floor(math.log2(min(p[2] for p in points)))
    high = 2 ** math.ceil(math.log2(max(p[2] for p in points)) + 0.01)
    bottom, top = 5 * math.floor(min(p[3] for p in points) / 5), 5 * math.ceil(max(53.5, *(p[3] for p in points)) / 5)

    def x(value):
        return 60 + 480 * math.log(value / low) / math.log(high / low)

    def y(db):
        return 300 - 270 * (db - bottom) / (top - bottom)

    colour = {"fast": "#c2603a", "normal": "#3a6ac2", "best": "#3a9a5a"}
    svg = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 350" font-family="sans-serif" font-size="12">',
           '<rect width="640" height="350" fill="white"/>']
    for db in range(bottom, top + 1, 5):
        svg.append(f'<path d="M60 {y(db):.1f}H540" stroke="#ddd"/><text x="52" y="{y(db) + 4:.1f}" text-anchor="end">{db}</text>')
    tick = low
    while tick <= high:
        svg.append(f'<path d="M{x(tick):.1f} 300v5" stroke="#444"/><text x="{x(tick):.1f}" y="318" text-anchor="middle">{tick:g}</text>')
        tick *= 2
    for setting, goal in GOALS.items():
        if goal:
            svg.append(f'<path d="M60 {y(goal):.1f}H540" stroke="{colour[setting]}" stroke-dasharray="4 3"/>'
                       f'<text x="545" y="{y(goal) + 4:.1f}" fill="{colour[setting]}">goal of {setting}</text>')
    for setting in SETTINGS:
        mine = [p for p in points if p[0] == setting]
        svg.append(f'<path d="M{"L".join(f"{x(p[2]):.1f} {y(p[3]):.1f}" for p in mine)}" fill="none" stroke="{colour[setting]}"/>')
        svg += [f'<circle cx="{x(p[2]):.1f}" cy="{y(p[3]):.1f}" r="{2 + 2 * STEPS.index(p[1])}" fill="{colour[setting]}" '
                f'fill-opacity="0.6"><title>{p[0]}, step {p[1]}: {p[3]:.2f} dB</title></circle>' for p in mine]
        svg.append(f'<text x="{x(mine[-1][2]) + 10:.1f}" y="{y(mine[-1][3]) + 4:.1f}" fill="{colour[setting]}">{setting}</text>')
    svg.append(f'<text x="300" y="340" text-anchor="middle">{"ms a picture" if timed else "samples a pixel"}'
               '; larger dots are finer steps</text><text x="12" y="20">dB</text></svg>')
    return "\n".join(svg) + "\n"


def measured(arguments):
    program = str(ROOT / "build/release/accuracy/picture/picture_error")
    if arguments and not arguments[0].startswith("--"):
        program = arguments.pop(0)
    views = "2"
    if "--causes-views" in arguments:
        i = arguments.index("--causes-views")
        views = arguments[i + 1]
        del arguments[i:i + 2]

    def run(*options):
        return subprocess.run([program, *arguments, *options], check=True, stdout=subprocess.PIPE, text=True).stdout
    return run(), run("--causes", "--views", views)


def main():
    arguments = sys.argv[1:]
    if arguments and arguments[0] == "--from":
        texts = [Path(name).read_text() for name in arguments[1:3]]
    else:
        texts = measured(arguments)
    all_views, few = Rows(texts[0]), Rows(texts[1])
    words = {"goals": goals(all_views), "scenes": scenes(all_views), "steps": steps(all_views), "causes": causes(few),
             "views": str(len(all_views.views)), "few_views": str(len(few.views)), "few": "first view" if few.views == {0} else f"first {len(few.views)} views"}
    page = TEMPLATE.read_text()
    for name, text in words.items():
        page = page.replace("{{" + name + "}}", text)
    (ROOT / "docs/results/picture-error.md").write_text(page)
    (ROOT / "docs/gallery/picture-error.svg").write_text(plot(all_views))
    print("written: docs/results/picture-error.md, docs/gallery/picture-error.svg")


if __name__ == "__main__":
    main()
