#!/usr/bin/env python3
"""Writes docs/results/grid.md from accuracy/grid_template.md, the cases of the grid and the program stair_steps.

    accuracy/write_grid.py                                 runs both from build/release, some minutes
    accuracy/write_grid.py --from accuracy.json stairs.csv    takes what they wrote before
"""
import csv
import io
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TEMPLATE = ROOT / "accuracy/grid_template.md"
CASES = ("round_disc", "round_ball", "straight_front")
TILTS = ("0", "2", "5", "10", "20", "30", "45")


def table(head, rows):
    lines = [head, ["---"] + ["--:"] * (len(head) - 1)] + rows
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def signed(value, digits):
    return f"{value:+.{digits}f}"


class Cases:
    def __init__(self, report):
        self.rows = report["cases"]

    def of(self, case, setting):
        return [row for row in self.rows if row["name"] == case and row["setting"] == setting]

    def settings(self, case):
        return list(dict.fromkeys(row["setting"] for row in self.rows if row["name"] == case))


def discs(cases):
    """A row for each law, a column for each radius."""
    rows, sizes = {}, []
    for setting in cases.settings("round_disc"):
        mass, four, eight, rest = cases.of("round_disc", setting)
        radius = re.search(r"radius ([\d.]+)", four["note"])[1]
        law, cells = setting.rsplit(", ", 1)
        sizes.append(cells)
        percent = [signed(100 * row["value"], 1) for row in (mass, four, eight)]
        rows.setdefault(law, []).append(" / ".join([radius] + percent + [f"{rest['value']:.2f}"]))
    head = ["law"] + list(dict.fromkeys(sizes))
    return table(head, [[law] + cells + ["–"] * (len(head) - 1 - len(cells)) for law, cells in rows.items()])


def balls(cases):
    """A row for each radius and direction, a column for each part that has melted."""
    rows, parts = {}, []
    for setting in cases.settings("round_ball"):
        radius, part = re.match(r"radius (\d+), (\d+) %", setting).groups()
        parts.append(part + " %")
        for row in cases.of("round_ball", setting):
            where = re.match(r"reach along (.*) over", row["quantity"])[1]
            rows.setdefault((where, radius), []).append(signed(100 * (row["value"] - 1), 2))
    head = ["melted"] + list(dict.fromkeys(parts))
    return table(head, [[f"{where}, radius {radius}"] + cells for (where, radius), cells in sorted(rows.items())])


def fronts(cases):
    kept = {}
    for setting in cases.settings("straight_front"):
        film, degrees = re.match(r"(.*), (\d+) degrees", setting).groups()
        speed, rough = cases.of("straight_front", setting)
        kept.setdefault(film, []).append((degrees, speed["value"], rough["value"]))
    angles = [degrees for degrees, _, _ in next(iter(kept.values()))]
    head = ["film"] + [f"speed, {a}°" for a in angles] + [f"rms, {a}°" for a in angles]
    return table(head, [[film] + [f"{s:.3f}" for _, s, _ in all_] + [f"{r:.2f}" for _, _, r in all_] for film, all_ in kept.items()])


def stairs(rows):
    """Planes by their tilt, worst of all azimuths, and balls by their radius."""
    table_rows = []
    for kind in dict.fromkeys(row["kind"] for row in rows):
        mine = [row for row in rows if row["kind"] == kind]
        cells = []
        for tilt in TILTS:
            planes = [r for r in mine if r["surface"] == "plane" and r["size"] == tilt]
            rms = (sum(float(r["rms"]) ** 2 for r in planes) / len(planes)) ** 0.5
            cells.append(f"{rms:.1f} / {max(float(r['largest']) for r in planes):.1f}")
        balls_ = [r for r in mine if r["surface"] == "ball"]
        table_rows.append([kind] + cells + [f"{float(r['rms']):.1f} / {float(r['largest']):.1f}" for r in balls_])
    return table(["cells"] + [t + "°" for t in TILTS] + [f"ball {r['size']}" for r in balls_], table_rows)


def measured():
    out = ROOT / "out/grid"
    wanted = [word for case in CASES for word in ("--case", case)]
    done = subprocess.run([ROOT / "build/release/app/voxmelt", "accuracy", *wanted, "--out", out])
    if done.returncode > 1:  # 1 says that a gate is missed: the page says so, too
        sys.exit(done.returncode)
    seen = subprocess.run([ROOT / "build/release/accuracy/picture/stair_steps"], check=True, stdout=subprocess.PIPE, text=True)
    return (out / "accuracy.json").read_text(), seen.stdout


def main():
    if sys.argv[1:2] == ["--from"]:
        report, surfaces = (Path(name).read_text() for name in sys.argv[2:4])
    else:
        report, surfaces = measured()
    report = json.loads(report)
    cases = Cases(report)
    words = {"discs": discs(cases), "balls": balls(cases), "fronts": fronts(cases),
             "stairs": stairs(list(csv.DictReader(io.StringIO(surfaces))))}
    page = TEMPLATE.read_text()
    for name, text in words.items():
        page = page.replace("{{" + name + "}}", text)
    (ROOT / "docs/results/grid.md").write_text(page)
    print("written: docs/results/grid.md")


if __name__ == "__main__":
    main()
