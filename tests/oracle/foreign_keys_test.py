#!/usr/bin/env python3
"""foreign_keys.py has a row for each key of docs/scenes.md that a rule reads, with the ends that the page states.

  foreign_keys_test.py
"""
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # a folder of bytecode here would fail oracle.independence
from foreign_keys import KEYS, TINY

PAGE = Path(__file__).resolve().parents[2] / "docs/scenes.md"
TABLES = {"The run": [], "Heat": ["heat"], "Flow": ["flow"], "Pieces": ["pieces"], "Vents, drains": ["vent", "drain"]}  # by section
NO_RULE = {"title", "description", "extends", "run.steps", "run.frame_every", "start.fields", "materials.name", "materials.color"}
HAS_ROWS = {"heat_source.keyframes"}  # a table: its keys have rows
NOT_IN_A_TABLE = re.compile(r"heat_source\.keyframes\.|(solid|liquid|inert)\.")  # rows; the page states them elsewhere
RANGE = re.compile(r"(?:whole, )?(-?\d+(?:\.\d+)?)( <)? ?\.\. ?(\d+(?:\.\d+)?)(?: each)?")


def keys_of(page):
    """(name, range) of each key in the sections TABLES."""
    section, tables = None, []
    for line in page.splitlines():
        if line.startswith("## "):
            section = next((name for name in TABLES if line[3:].startswith(name)), None)
            tables = TABLES.get(section, [])
        columns = [column.strip() for column in line.strip("|").split(" | ")]
        if section is None or not line.startswith("| ") or columns[0] == "key":
            continue
        for key in re.findall(r"`([^`]+)`", columns[0]):
            if first := re.match(r"\[+([\w.]+)\]+ (\w+)", key):
                tables, key = [first[1]], first[2]
            of = re.search(r"\((vent|drain)\)", columns[0])
            for table in [of[1]] if of else tables or [""]:
                yield f"{table}.{key}".lstrip("."), columns[2]


def offences(page, rows):
    stated = {name: span for name, span in keys_of(page) if name not in NO_RULE | HAS_ROWS}
    wrong = []
    for name, span in stated.items():
        found = RANGE.fullmatch(span)
        mine = [key for row, key in rows.items() if row.split(" (")[0] == name]
        if not mine:
            wrong.append(f"{name}: a key of the page without a row")
        elif found:
            low, high = TINY if found[2] else float(found[1]), float(found[3])
            if mine[0].ends != (low, high):
                wrong.append(f"{name}: the page says {span}, the row {mine[0].ends}")
    return wrong + [f"{row}: a row whose key is not on the page" for row in rows
                    if row.split(" (")[0] not in stated and not NOT_IN_A_TABLE.match(row)]


def main():
    page = PAGE.read_text()
    wrong = offences(page, KEYS)
    gamma = KEYS["heat.gamma"]
    planted = [(page.replace("| 0 < .. 71 |", "| 0 < .. 72 |"), KEYS), (page.replace("| `convection` |", "| `convection`, `wind` |"), KEYS),
               (page, {name: key for name, key in KEYS.items() if name != "vent.energy"}),
               (page, {**KEYS, "heat.wind": gamma}), (page, {**KEYS, "vent.rate": gamma})]
    for n, (text, rows) in enumerate(planted):
        if len(offences(text, rows)) != 1:
            wrong.append(f"planted offence {n} gives {offences(text, rows)}")
    print("\n".join(wrong) if wrong else f"{len(KEYS)} rows are those of the page")
    sys.exit(1 if wrong else 0)


main()
