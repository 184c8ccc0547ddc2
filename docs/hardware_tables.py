#!/usr/bin/env python3
"""The tables of docs/hardware-picture.md that the model itself gives: wires, memories and units of a pipe.

  hardware_tables.py PROGRAM ROOT           writes them
  hardware_tables.py PROGRAM ROOT --check   fails if the page has others

They are those of the report of one small picture of lava, in mid-melt: it has ground, texture and glow.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

BEGIN, END = "<!-- The model's tables: docs/hardware_tables.py -->\n", "<!-- End of the model's tables -->\n"
SCENE = ["lava", "--from", "400", "--size", "16x16", "--no-compare"]


def table(head, rows):
    right = [False] + [True] * (len(head) - 1)
    lines = ["| " + " | ".join(head) + " |", "|" + "|".join("--:" if r else "---" for r in right) + "|"]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def tables_of(pipe):
    wires = table(["channel", "bits", "tokens"], [[c["name"], c["bits"], c["depth"]] for c in pipe["channels"]])
    memories = {}
    for one in pipe["memories"]:
        memories.setdefault(one["stage"], []).append(one)
    rows = [[f"{stage}: {one['name']}", one["words"], one["bits"], one["words"] * one["bits"]]
            for stage, all_of in memories.items() for one in all_of]
    units = [[u["stage"], u["multipliers"], u["dividers"]] for u in pipe["units"] if u["multipliers"] + u["dividers"] > 0]
    return (f"{wires}\nAll channels together hold {pipe['channel_bits']} bits.\n\n"
            + table(["memory", "words", "bits", "bits in all"], rows)
            + f"\nAll memories of a pipe together hold {pipe['memory_bits']} bits.\n\n"
            + table(["stage", "multipliers", "dividers"], units)
            + f"\nA pipe has {pipe['multipliers']} multipliers and {pipe['dividers']} dividers.\n")


def main():
    program, root, *check = sys.argv[1:]
    page = Path(root) / "docs/hardware-picture.md"
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "r.json"
        subprocess.run([program, "verify", *SCENE[:1], "--picture", *SCENE[1:], "--quiet", "--report", report],
                       check=True, stdout=subprocess.DEVNULL)
        made = tables_of(json.loads(report.read_text())["pipe"])
    before, rest = page.read_text().split(BEGIN)
    old, after = rest.split(END)
    if not check:
        page.write_text(before + BEGIN + "\n" + made + "\n" + END + after)
    elif old != "\n" + made + "\n":
        sys.exit("docs/hardware-picture.md has other tables than the model; docs/hardware_tables.py writes them anew")


main()
