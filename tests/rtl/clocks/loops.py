"""The loops of a part alone: registers that depend on themselves, and the logic between them.

What lies outside of all loops can have further registers, so loops set the clock that a part could reach.
"""


def is_register(cell):
    return "DFF" in cell["type"]  # of a bit: the pin of its clock is C


def bits(cell, direction):
    return [bit for port, way in cell["port_directions"].items() if way == direction and not (is_register(cell) and port == "C")
            for bit in cell["connections"][port] if isinstance(bit, int)]


def drivers_of(cells):
    return {bit: name for name, cell in cells.items() for bit in bits(cell, "output")}


def cone_of(name, cells, drivers):
    """Logic between registers and this one, and the registers at its beginning."""
    logic, registers, left = set(), set(), [name]
    while left:
        for bit in bits(cells[left.pop()], "input"):
            source = drivers.get(bit)
            if source is None or source in logic:
                continue
            if cells[source]["type"].startswith("$mem") or is_register(cells[source]):
                registers.add(source)
            else:
                logic.add(source)
                left.append(source)
    return logic, registers


def in_loops(feeds):
    """Registers that reach themselves. feeds[r] are those that r depends on."""
    def reached(start):
        seen, left = set(), [start]
        while left:
            for one in feeds.get(left.pop(), ()):
                if one not in seen:
                    seen.add(one)
                    left.append(one)
        return seen
    return {one for one in feeds if one in reached(one)}


def loops_of(module):
    """A module `loops` with the ports clk, i and o; None if there are no loops. What comes from outside is i."""
    cells = module["cells"]
    drivers = drivers_of(cells)
    registers = [name for name, cell in cells.items() if is_register(cell)]
    cones = {name: cone_of(name, cells, drivers) for name in registers}
    kept = in_loops({name: feeding for name, (_, feeding) in cones.items()})
    if not kept:
        return None
    kept_cells = {name: cells[name] for name in kept.union(*(cones[name][0] for name in kept))}
    driven = {bit for cell in kept_cells.values() for bit in bits(cell, "output")}
    outside = sorted({bit for cell in kept_cells.values() for bit in bits(cell, "input")} - driven)
    clocks = {cells[name]["connections"]["C"][0] for name in kept}
    assert len(clocks) == 1, "one clock"
    ports = {"clk": {"direction": "input", "bits": list(clocks)},
             "o": {"direction": "output", "bits": [bit for name in sorted(kept) for bit in bits(cells[name], "output")]}}
    if outside:
        ports["i"] = {"direction": "input", "bits": outside}
    return {"attributes": {}, "ports": ports, "cells": kept_cells, "netnames": {}}
