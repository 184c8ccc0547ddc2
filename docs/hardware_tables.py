#!/usr/bin/env python3
"""The tables of docs/hardware/ray-caster.md that the model itself gives: wires, memories and units of a pipe.

  hardware_tables.py PROGRAM ROOT           writes them
  hardware_tables.py PROGRAM ROOT --check   fails if the page has others

They are those of the report of one small picture of lava, in mid-melt: it has ground, texture and glow. Of clear
matter there is what ice has more than the same ice drawn as opaque.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

BEGIN, END = "<!-- The model's tables: docs/hardware_tables.py -->\n", "<!-- End of the model's tables -->\n"
LAVA, ICE, OPAQUE = ["lava", "--from", "400"], ["ice", "--from", "200"], ["--set", "look.clear=[0, 0, 0]"]


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


def of_clear_matter(opaque, clear):
    def multipliers(pipe):
        return {u["stage"]: u["multipliers"] for u in pipe["units"]}

    def bits(pipe):
        return {f"{m['stage']}: {m['name']}": m["words"] * m["bits"] for m in pipe["memories"]}

    # Those of both kinds come first, and in the same order.
    wires = [[c["name"], opaque["channels"][i]["bits"] if i < len(opaque["channels"]) else "", c["bits"], c["depth"]]
             for i, c in enumerate(clear["channels"])]
    before = multipliers(opaque) | bits(opaque)
    sides = [[name, before.get(name, ""), after] for of in (bits, multipliers) for name, after in of(clear).items()
             if before.get(name, 0) != after]
    return ("Ice has clear matter. This is what differs from the same ice drawn as opaque.\n\n"
            + table(["channel", "opaque", "clear", "tokens"], [row for row in wires if row[1] != row[2]]) + "\n"
            + table(["memory: bits; stage: multipliers", "opaque", "clear"], sides)
            + "".join(f"\nA pipe has {clear[key]} {what} instead of {opaque[key]}." for key, what in (
                ("channel_bits", "bits of channels"), ("memory_bits", "bits of memories"), ("multipliers", "multipliers")))
            + "\n")


def report_of(program, scene, folder):
    report = Path(folder) / "r.json"
    subprocess.run([program, "verify", scene[0], "--picture", *scene[1:], "--size", "16x16", "--no-compare", "--quiet",
                    "--report", report], check=True, stdout=subprocess.DEVNULL)
    return json.loads(report.read_text())["pipe"]


def main():
    program, root, *check = sys.argv[1:]
    page = Path(root) / "docs/hardware/ray-caster.md"
    with tempfile.TemporaryDirectory() as folder:
        pipes = [report_of(program, scene, folder) for scene in (LAVA, ICE + OPAQUE, ICE)]
    made = tables_of(pipes[0]) + "\n" + of_clear_matter(*pipes[1:])
    before, rest = page.read_text().split(BEGIN)
    old, after = rest.split(END)
    if not check:
        page.write_text(before + BEGIN + "\n" + made + "\n" + END + after)
    elif old != "\n" + made + "\n":
        sys.exit("docs/hardware/ray-caster.md has other tables than the model; docs/hardware_tables.py writes them anew")


main()
