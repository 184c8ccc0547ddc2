#!/usr/bin/env python3
"""The ranges that docs/scenes.md states are those that the program enforces: both ends are accepted, what lies beyond is refused.

  scene_ranges_test.py VOXMELT ROOT
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

# It has every table whose keys are tried, and one entry of every list.
SCENE = """
grid.size = [8, 8, 8]
[heat.air]
exchange = 0.1
bottom = 0.2
[[materials]]
name = "other"
melting_point = 0.0625
[[heat_source]]
at = [1, 2, 3]
power = 5
[flow.thermal]
reference = 0.5
doubling = 0.1
[[vent]]
at = [4, 4, 4]
radius = 2
rate = 0.1
[[drain]]
at = [4, 1, 4]
radius = 2
rate = 0.1
[[liquid]]
shape = "box"
size = [2, 2, 2]
at = [2, 2, 2]
[[change]]
step = 3
do = ["vent.0.rate 0.2"]
"""
WITH = {"material.latent_heat": ["material.melting_point=0.000001"],  # at most 1 together
        "material.freezing_point": ["material.melting_point=1", "materials.0.melting_point=1"],
        "materials.0.conductivity": ["heat.gamma=0.001"],  # gamma x conductivity has a bound
        "heat_source.0.radius": ['heat_source.0.kind="sphere"'],
        "flow.viscous": ['flow={law="viscous", viscous={kappa=1}}']}
NOT_TRIED = {"start.step"}  # needs an export
LEAST = 45  # numbers of keys that the page gives ranges for
NUMBER = r"-?\d+(?:\.\d+)?"
RANGE = re.compile(rf"(?P<whole>whole, )?(?:(?P<low>{NUMBER})|0 (?P<above><) )\.\.\s?(?P<high>{NUMBER})(?P<each> each)?")


def rows(page):
    """(path of a key, its range) of the tables whose third column is the range."""
    table, ranged = "", False
    for line in page.splitlines():
        if line.startswith("## "):
            lists = re.findall(r"\[\[(\w+)\]\]", line)
            table = {"solid": "liquid.0", "vent": "vent.0"}.get(lists[0], "") if lists else ""
            table = "heat" if line.startswith("## Heat") else table
        if not line.startswith("|"):
            ranged = False
            continue
        columns = [column.strip() for column in line.strip("|").split(" | ")]
        if columns[0] == "key":
            ranged = True
        elif ranged and len(columns) > 2:
            for key in re.findall(r"`([^`]+)`", columns[0]):
                if prefix := re.match(r"\[+([\w.]+)\]+ (\w+)", key):
                    listed = key.startswith("[[")
                    table, key = prefix[1] + (".0" if listed else ""), prefix[2]
                if found := RANGE.fullmatch(columns[2]):
                    yield f"{table}.{key}", found


def number(text):
    return float(text) if "." in text else int(text)


def ends(found):
    """Values at the ends of a range, and values just beyond them."""
    high = number(found["high"])
    near = 0.0005 if isinstance(high, float) or high == 1 and not found["whole"] else 1
    if found["above"]:
        return [high, near], [high + near, 0]
    low = number(found["low"])
    return [high, low], [high + near, low - (near if low == 0 else 1 if isinstance(low, int) else low / 2)]


def accepted(voxmelt, scene, path, value, others):
    sets = [argument for one in [*others, f"{path}={value}"] for argument in ("--set", one)]
    return subprocess.run([voxmelt, "digest", scene, "--steps", "0", "--quiet", *sets], capture_output=True).returncode == 0


def main():
    voxmelt, root = sys.argv[1], Path(sys.argv[2])
    wrong, tried = [], 0
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.toml"
        scene.write_text(SCENE)
        for path, found in rows((root / "docs/scenes.md").read_text()):
            if path in NOT_TRIED:
                continue
            tried += 1
            inside, outside = ends(found)
            others = WITH.get(path) or WITH.get(path.rpartition(".")[0], [])
            for values, expected in ((inside, True), (outside, False)):
                for value in values:
                    text = f"[{value}, {value}, {value}]" if found["each"] else value
                    if accepted(voxmelt, scene, path, text, others) != expected:
                        wrong.append(f"docs/scenes.md: {path} = {text} is {'refused' if expected else 'accepted'}")
    if tried < LEAST:
        wrong.append(f"only {tried} ranges found in docs/scenes.md")
    print("\n".join(wrong) if wrong else f"{tried} ranges are those of the program")
    sys.exit(1 if wrong else 0)


main()
