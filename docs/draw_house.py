#!/usr/bin/env python3
"""Draws docs/house.svg: the folders, what each is for, how large it is, and which room includes which.

  draw_house.py ROOT             writes docs/house.svg
  draw_house.py ROOT --check     says whether it is old
  draw_house.py ROOT --inside    how many rooms, floors and arrows hwmodel has
  draw_house.py --self-test

Arrows are taken from the includes. An arrow that follows from two others through a floor between is left out.
No folders may include each other in a circle, at no level, and hwmodel may not become larger inside than
house_arrows.py says.
"""
import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import house_arrows  # noqa: E402
from house_picture import picture  # noqa: E402

# One row per folder with a box: what it is for. A folder below takes part in the count of the box above it.
PURPOSES = {
    "door": "the library, for other programs",
    "include/voxmelt": "what they include",
    "library": "what it is made of",
    "library/journal": "changes by hand, as text",
    "python": "the library in Python",
    "examples": "programs of a page",
    "app": "the voxmelt program, one file per subcommand",
    "app/view": "a page in the browser",
    "app/runs": "many runs, one table",
    "app/vdb": "OpenVDB, in a program of its own",
    "bench": "benchmarks and their scripts",
    "measure": "what `voxmelt bench` times and checks",
    "measure/baseline": "the paper's program, plainly written",
    "accuracy": "how well it does physics, against analytic answers",
    "accuracy/front": "speed against error",
    "accuracy/formats": "the same in other numbers",
    "accuracy/picture": "picture in double",
    "report": "what these print: SVG, HTML, tables",
    "report/svg": "axes, marks, pages",
    "report/hardware": "pages of the hardware",
    "report/accuracy": "pages and tables of errors",
    "report/bench": "tables and plot of speeds",
    "report/runs": "pages of many runs",
    "hwmodel": "the hardware in SystemC: a pipeline, a ray caster",
    "hwmodel/fabric": "clock, channels, line buffers, wires",
    "hwmodel/check": "what checks any machine",
    "hwmodel/memory": "when a DRAM gives and takes",
    "hwmodel/pipeline": "the automaton's stream, a stage per phase",
    "hwmodel/caster": "draws pictures, from bricks",
    "hwmodel/machine": "both machines on one memory",
    "hwmodel/rtl": "stages of the pipeline as circuits",
    "hwmodel/explore": "which hardware is best for a device",
    "render": "the pictures",
    "render/rule": "the picture in integers",
    "render/cells": "cells as boxes, in false colours",
    "render/density": "amounts to a filtered field",
    "render/ground": "the ground's heights and rock",
    "render/light": "volumes of light",
    "render/device": "the picture on a graphics card",
    "render/brick": "what bricks of places hold",
    "render/packet": "rays in packets, and pictures by them",
    "render/textures": "what a graphics processor draws from",
    "render/reference": "the picture, in plain loops",
    "render/image": "PNG, sheet, film",
    "render/visibility": "rays by Embree",
    "render/frames": "files beside the steps",
    "kernel/run": "the run loop",
    "kernel/run/io": "exports and output folders",
    "kernel/run/checkpoint": "runs as files",
    "kernel/run/trial": "the fastest one here",
    "kernel/run/opening": "from files to runs",
    "kernel/scene": "what a file says",
    "kernel/scene/text": "documents and their readers",
    "kernel/scene/shape": "solids, meshes, height fields to voxels",
    "kernel/scene/mesh_file": "readers of meshes",
    "kernel/vdb": "how we speak with it",
    "kernel/scene/voxel_file": "readers of volumes",
    "kernel/engine": "who executes it",
    "kernel/engine/cpu": "16-bit lanes, one file per instruction set",
    "kernel/engine/scalar": "the reference, in plain loops",
    "kernel/engine/simd": "every phase once, for any instruction set",
    "kernel/engine/parallel": "threads, and what sleeps",
    "kernel/engine/gpu": "whole steps on a device",
    "kernel/engine/visibility": "what each surface cell sees",
    "kernel/automaton": "what it is: the definition",
    "kernel/automaton/rule": "the rules, scalar and constexpr",
    "kernel/automaton/state": "bit planes, fields, digest, ledgers",
    "kernel/automaton/step": "the order of phases",
}
# From the roof to the ground: the rooms of each floor, from left to right, with their widths.
FLOORS = [
    [("app", 1)],
    [("door", 3), ("report", 4), ("bench", 2)],
    [("accuracy", 4), ("measure", 2)],
    [("hwmodel", 5), ("render", 4)],
    [("kernel/run", 3), ("kernel/scene", 5)],
    [("kernel/engine", 1)],
    [("kernel/automaton", 4), ("kernel/vdb", 1)],
]
# A room is a folder, or else several.
FOLDERS = {"door": ("include/voxmelt", "library", "python", "examples")}
NOT_DRAWN = ("build", "out", "docs", "scenes", "tests")
ROOMS = [room for floor in FLOORS for room, _ in floor]
FLOOR_OF = {room: number for number, floor in enumerate(FLOORS) for room, _ in floor}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+/[^">]+)[">]', re.M)
COUNT = re.compile(r'data-folder="([^"]+)" data-lines="(\d+)"')


def room_of(folder):
    return next((room for room in ROOMS for part in FOLDERS.get(room, (room,)) if f"{folder}/".startswith(f"{part}/")), None)


def box_of(folder, room):
    if room in FOLDERS:
        return next(part for part in FOLDERS[room] if f"{folder}/".startswith(f"{part}/"))
    return "/".join(folder.split("/")[:room.count("/") + 2])


def sources(root):
    """Folder and text of each."""
    tops = [p for p in root.iterdir() if p.is_dir() and p.name not in NOT_DRAWN and not p.name.startswith(".")]
    for path in sorted(p for top in tops for p in top.rglob("*") if p.suffix in (".h", ".cpp")):
        yield path.relative_to(root).parent.as_posix(), path.read_text()


def included_folders(text):
    return [Path(f"include/{included}" if included.startswith("voxmelt/") else included).parent.as_posix()
            for included in INCLUDE.findall(text)]


def folders_and_includes(root):
    """All folders with code, and the pairs of which the first includes the second."""
    texts = list(sources(root))
    return ({folder for folder, _ in texts},
            {(folder, other) for folder, text in texts for other in included_folders(text)
             if room_of(other) is not None and other != folder})


def survey(root):
    """Lines of code per box, and the pairs of rooms of which the first includes the second."""
    lines, arrows, problems = {}, set(), []
    for folder, text in sources(root):
        room = room_of(folder)
        if room is None:
            problems.append(f"{folder}: on no floor; FLOORS in docs/draw_house.py gives it a place")
            continue
        for counted in {box_of(folder, room), room}:
            lines[counted] = lines.get(counted, 0) + text.count("\n")
        for other in map(room_of, included_folders(text)):
            if other not in (None, room):
                arrows.add((room, other))
    problems += [f"{box}: has no purpose; PURPOSES in docs/draw_house.py gives it one" for box in sorted(set(lines) - set(PURPOSES))]
    problems += [f"{one} includes {other}, which is on a floor above" for one, other in sorted(arrows)
                 if FLOOR_OF[one] > FLOOR_OF[other]]
    problems += [f"{one} includes {other}, which is on its floor, but not next to it" for one, other in sorted(arrows)
                 if FLOOR_OF[one] == FLOOR_OF[other] and abs(ROOMS.index(one) - ROOMS.index(other)) != 1]
    problems += house_arrows.problems(*folders_and_includes(root))
    return lines, arrows, sorted(set(problems))


def needed(arrows):
    """Without those that follow from two others through a floor between."""
    def reaches(one, other):
        return (one, other) in arrows or any(reaches(middle, other) for start, middle in arrows
                                             if start == one and FLOOR_OF[one] < FLOOR_OF[middle] < FLOOR_OF[other])
    return sorted((one, other) for one, other in arrows
                  if not any(reaches(one, middle) and reaches(middle, other) for middle in ROOMS
                             if FLOOR_OF[one] < FLOOR_OF[middle] < FLOOR_OF[other]))


def drawn(lines, arrows):
    return picture(FLOORS, PURPOSES, FOLDERS, lines, needed(arrows))


def why_old(drawing, lines, arrows, readme="docs/house.svg"):
    """A count may drift by a tenth before the drawing is old; everything else has to agree exactly."""
    if "docs/house.svg" not in readme:
        return "README.md does not show it"
    shown = {folder: int(count) for folder, count in COUNT.findall(drawing)}
    if set(shown) != set(lines) or drawn(shown, arrows) != drawing:
        return "folders, purposes, arrows or the drawing itself have changed"
    drifted = [f"{box} shows {shown[box]} lines and has {lines[box]}" for box in lines
               if abs(shown[box] - lines[box]) > max(20, lines[box] / 10)]
    return "; ".join(drifted)


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for box in set(PURPOSES) - set(FOLDERS):
            (root / box).mkdir(parents=True, exist_ok=True)
            (root / box / "a.h").write_text("\n" * 300)
        (root / "app/a.h").write_text('#include "kernel/run/a.h"\n#include "render/a.h"\n' + "\n" * 298)
        (root / "library/a.h").write_text('#include "voxmelt/a.h"\n#include "render/a.h"\n' + "\n" * 298)
        (root / "bench/a.h").write_text('#include <voxmelt/a.h>\n' + "\n" * 299)
        lines, arrows, problems = survey(root)
        assert lines["app"] == 1200 and lines["kernel/engine"] == 2100 and lines["door"] == 1500, lines
        assert arrows == {("app", "kernel/run"), ("app", "render"), ("door", "render"), ("bench", "door")}, arrows
        assert problems == ["bench includes door, which is on its floor, but not next to it"], problems
        (root / "bench/a.h").write_text("\n" * 300)
        lines, arrows, problems = survey(root)
        assert problems == [], problems
        drawing = drawn(lines, arrows)
        assert drawn(*survey(root)[:2]) == drawing and why_old(drawing, lines, arrows) == ""
        assert why_old(drawing, {**lines, "app": 1330}, arrows) == ""
        assert why_old(drawing, {**lines, "app": 1340}, arrows) == "app shows 1200 lines and has 1340"
        assert why_old(drawing, lines, arrows | {("render", "kernel/scene")}) != ""
        assert why_old(drawing, {**lines, "app/new": 5}, arrows) != ""
        assert why_old(drawing, lines, arrows, "no picture") != ""
        assert why_old(drawing.replace("stroke", "strike", 1), lines, arrows) != ""
        for planted, said in {"kernel/engine/new": "has no purpose", "cellar": "on no floor"}.items():
            (root / planted).mkdir()
            (root / planted / "a.cpp").write_text("\n")
            assert any(planted in problem and said in problem for problem in survey(root)[2]), planted
        (root / "kernel/run/b.h").write_text('#include "app/a.h"\n')
        assert any("floor above" in problem for problem in survey(root)[2])
    chain = {("app", "render"), ("render", "kernel/scene"), ("app", "kernel/scene"), ("app", "kernel/run")}
    assert needed(chain) == [("app", "kernel/run"), ("app", "render"), ("render", "kernel/scene")], needed(chain)
    house_arrows.self_test()
    print("planted folders, arrows, circles and counts are noticed")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    house = Path(sys.argv[1])
    if sys.argv[2:] == ["--inside"]:
        for name in house_arrows.MOST:
            print("{}: {} rooms, {} floors, {} arrows".format(name, *house_arrows.inside(name, *folders_and_includes(house))))
        sys.exit(0)
    found_lines, found_arrows, wrong = survey(house)
    if wrong:
        sys.exit("\n".join(wrong))
    target = house / "docs/house.svg"
    if sys.argv[2:] == ["--check"]:
        reason = why_old(target.read_text() if target.exists() else "", found_lines, found_arrows,
                         (house / "README.md").read_text())
        sys.exit(f"docs/house.svg is old or hidden ({reason}); python3 docs/draw_house.py . draws it" if reason else 0)
    target.write_text(drawn(found_lines, found_arrows))
