#!/usr/bin/env python3
"""`voxmelt explore` beside an exhaustive search of its own: every time and every number of resources again,
from the parts and coefficients in the report.

  explore_test.py PROGRAM
"""
import csv
import itertools
import json
import re
import tempfile
import unittest
from math import ceil, floor, inf
from pathlib import Path

from program import SMALL, voxmelt, write

NAMES = ("lut", "ff", "dsp", "bram", "uram")
# Of the memory's sheet (hwmodel/presets/memories/ddr4-2400.toml), in its cycles.
DDR4 = {"mhz": 1200, "beats": 4, "banks": 4, "cl": 17, "cwl": 12, "rcd": 17, "rp": 17, "rtp": 9, "wr": 18,
        "wtr_s": 3, "rtw": 2, "rfc": 420, "refi": 9360, "interface": 24, "batch": 48}


REACHING = {"conduction", "edges", "corners", "walls", "pattern", "apply", "spread"}  # a cell along x


class Tiles:
    """How the blocks of a grid are cut: of each tile, the blocks that it reads, and those that it owns."""
    def __init__(self, report, parts, hw):
        self.blocks = ceil(report["grid"][0] / parts["lanes"])
        self.halo = ceil(hw["cascade"] * sum(s["name"] in REACHING for s in parts["stages"]) / parts["lanes"])
        self.width, count = hw["tile"] // parts["lanes"] or self.blocks, 1
        if self.width < self.blocks:
            count = self.count(self.width)
            self.width = next(w for w in itertools.count(2 * self.halo + 1) if self.count(w) == count)
        begins = [min(k * (self.width - 2 * self.halo), self.blocks - self.width) for k in range(count)]
        cuts = [0] + [k * (self.width - 2 * self.halo) + self.halo for k in range(1, count)] + [self.blocks]
        self.read = [range(b, b + self.width) for b in begins]
        self.owned = [range(a, b) for a, b in zip(cuts, cuts[1:])]

    def count(self, width):
        """Tiles of this width that cover the grid."""
        return ceil((self.blocks - 2 * self.halo) / (width - 2 * self.halo))

    def shortest_return(self, n, high):
        """Tokens from that with which a block's owner reads it to that with which any tile reads it again."""
        tiles = len(self.read)
        return min((tiles + k - j) * n + (self.read[j][0] - self.read[k][0]) * high
                   for k in range(tiles) for j in range(tiles) if set(self.read[k]) & set(self.owned[j]))


def trains(report, parts, hw, tiles):
    """The (tile, steps) of all streams of each train, and its steps."""
    done, n, every, high = 0, parts["tokens"], report["visibility_every"], report["grid"][1]
    interval = 2 if hw["fifo_depth"] == 1 else 1
    follow = hw["overlap"] and all(s["lag"] < n for s in parts["stages"])
    back = tiles.shortest_return(n, high) - (high - 1 if hw["coded"] else 0)
    found = []
    while done < report["steps"]:
        found.append([])
        while True:
            step = report["first_step"] + done
            k = min(hw["cascade"], report["steps"] - done, every - step % every if every else inf)
            for tile in range(len(tiles.read)):
                if tile and not follow:
                    found.append([])
                found[-1].append((tile, k))
            done += k
            lags = sum(s["lag"] for s in parts["stages"])
            overlaps = follow and interval * back > interval * k * lags + hw["cascade"] * len(parts["stages"]) + 1
            if done == report["steps"] or not overlaps or (every and (report["first_step"] + done) % every == 0):
                break
    return found


def meeting(bursts):
    """How often two streams at this distance need one bank, for two rows: stretches of 128 bursts in 4 groups."""
    def bank(stretch):
        return stretch % 4 ^ stretch // 4 % 4
    whole, part = int(bursts // 512), bursts / 512 % 1
    shares = [sum(s != 0 and bank(q) == bank(q + s) for q in range(16)) / 16 for s in (whole, whole + 1)]
    return (1 - part) * shares[0] + part * shares[1]


def dram(reads, writes, meetings):
    """Cycles of the memory for so many bursts of 64 bytes."""
    d, turns = DDR4, min(reads, writes) / DDR4["batch"]
    opened = ((d["rtp"] + d["rp"] + d["rcd"] - (d["cl"] + d["beats"] - d["cwl"]) - d["rtw"]) * meetings[0]
              + (d["wr"] + d["rp"] + d["rcd"] - d["wtr_s"]) * meetings[1])
    bus = (reads + writes) * d["beats"] + turns * (d["rtw"] + d["wtr_s"] + d["cl"] + opened)
    return bus / (1 - (d["rtp"] + d["rp"] + d["rfc"] + d["rcd"]) / d["refi"])


def distances(report, tiles, columns, slot):
    """Bursts by which the writer is behind the reader: in the other copy, where there are tiles."""
    apart = columns * tiles.blocks / tiles.width * slot
    copy = tiles.blocks * report["grid"][2] * slot if len(tiles.read) > 1 else 0
    return apart - copy, apart + copy


def feed_bursts(parts, tiles, content, streams, deep, interval, high):
    """Bursts that feeds fetch in the time of each column, and of each feed those that it fetches at the begin."""
    lit, n = content["lit_columns"], parts["tokens"]
    waits = [1 + (interval * s["lag"] if s["lag"] < n else interval * (n - 1) + s["lag"] - n + 1) for s in parts["stages"]]
    before = 1 + sum(waits[:[s["name"] for s in parts["stages"]].index("exchange")])
    delays = [floor((t * sum(waits) + before) / (interval * high) + .5) for t in range(streams[0][1])]
    columns = [(z * tiles.blocks + block, steps) for tile, steps in streams
               for z in range(deep) for block in tiles.read[tile]]
    fetched, first = [0] * (len(columns) + delays[-1] + 1), []
    for t, delay in enumerate(delays):
        used = [lit[at] / 512 if t < steps else 0 for at, steps in columns]
        first.append(min(sum(used), 128))
        left = sum(used) - first[-1]
        for at, bursts in enumerate(used):
            fetched[at + delay] += min(left, bursts)
            left -= min(left, bursts)
    return fetched, first


def by_columns(report, parts, content, hw, tiles, streams, fed, lag, interval):
    """The bus serves column after column, the pipeline takes each when it has come."""
    d, (_, high, deep), tiled = DDR4, report["grid"], len(tiles.read) > 1
    ratio = hw["clock_mhz"] / d["mhz"]
    run = 1 - (d["rtp"] + d["rp"] + d["rfc"] + d["rcd"]) / d["refi"]
    plain = high * parts["lanes"] * parts["cell_bits"] / 512
    slot = ceil(high * (hw["coded"] + parts["lanes"] * parts["cell_bits"]) / 512)
    columns, puts = [], []
    for tile, _ in streams:
        for z, block in itertools.product(range(deep), tiles.read[tile]):
            columns.append(content["coded_columns"][z * tiles.blocks + block] if hw["coded"] else slot if tiled else plain)
            puts.append(columns[-1] if block in tiles.owned[tile] else 0)
    taken, behind = interval * high, floor(lag / (interval * high) + .5)
    aparts = distances(report, tiles, lag / taken, slot) if tiled or hw["coded"] else 2 * (lag / taken * plain,)
    state = sum(columns) * 512 / (sum(columns) * 512 + fed)
    of_writes, of_reads = (state * sum(meeting(apart + more) for apart in aparts) / 2 + (1 - state) / d["banks"]
                           for more in (d["batch"], 0))
    turn = (d["rtw"] + d["wtr_s"] + d["cl"]
            + (d["rtp"] + d["rp"] + d["rcd"] - (d["cl"] + d["beats"] - d["cwl"]) - d["rtw"]) * of_writes
            + (d["wr"] + d["rp"] + d["rcd"] - d["wtr_s"]) * of_reads)
    read, write = ratio * d["beats"] / run, ratio * (d["beats"] + turn / d["batch"]) / run
    latency = ratio * (d["rcd"] + d["cl"] + d["beats"] + d["interface"]) * (1 + hw["coded"])
    feeds, first = feed_bursts(parts, tiles, content, streams, deep, interval, high) if fed else ([], [])

    def fill(bursts):
        """Feeds fill their buffers side by side, each by so many."""
        some = [min(left, bursts) for left in first]
        first[:] = [left - one for left, one in zip(first, some)]
        return sum(some)

    done, bus, waiting, asked, freed, written, most = [], 0, 0, 0, 0, 0, 128 + 64
    ahead = 8 if hw["coded"] else 128
    for c in range(len(columns) + behind):
        own = columns[c] if c < len(columns) else 0
        asked += own
        while freed < min(c, len(columns)) and asked > 128:
            asked, freed = asked - columns[freed], freed + 1
        gate = max(done[freed - 1] if freed else 0, done[c - ahead] if c >= ahead else 0)
        start = max(bus, gate if c < len(columns) else done[-1])
        while written + behind < c and done[written + behind] <= start:
            waiting, written = waiting + puts[written], written + 1
        idle = (start - bus) / write
        wrote = min(waiting, idle)
        waiting -= wrote
        if first:
            fill((idle - wrote) * write / read / len(first))
        reads = own + (feeds[c] if c < len(feeds) else 0) + fill(max(own, 1))
        served = max(min(waiting, reads), waiting - most)
        waiting -= served
        bus = start + reads * read + served * write
        come = max(bus, gate + latency + own * read) + taken / max(own, 1) if c < len(columns) else bus
        done.append(max((done[-1] if done else 0) + taken, come))
    waiting += sum(puts[written:])
    return floor(done[-1] + max(waiting - most, 0) * write + .5)


def times(report, parts, hw):
    """Cycles while the memory always answers, and on it. Trains that are alike take the same time."""
    tiles, known, sums = Tiles(report, parts, hw), {}, [0, 0]
    n, stages = parts["tokens"], parts["stages"]
    interval = 2 if hw["fifo_depth"] == 1 else 1
    for streams in trains(report, parts, hw, tiles):
        if tuple(streams) not in known:
            wait = sum(interval * s["lag"] if s["lag"] < n else interval * (n - 1) + s["lag"] - n + 1 for s in stages)
            cycles = interval * (len(streams) * n - 1) + streams[0][1] * wait + hw["cascade"] * len(stages) + 2
            slow = cycles if report["memory"] == "none" else on_memory(report, parts, hw, tiles, streams, cycles)
            known[tuple(streams)] = cycles, slow
        sums = [a + b for a, b in zip(sums, known[tuple(streams)])]
    return sums


def on_memory(report, parts, hw, tiles, streams, cycles):
    """Of a train that takes so many cycles without waiting."""
    d, (_, high, deep) = DDR4, report["grid"]
    content = next(c for c in report["contents"] if c["lanes"] == parts["lanes"])
    interval, tiled = 2 if hw["fifo_depth"] == 1 else 1, len(tiles.read) > 1
    window, fed = interval * len(streams) * parts["tokens"], 0
    for tile, steps in streams if parts["fed"] else ():
        of_tile = sum(sum(content["lit_columns"][block::tiles.blocks]) for block in tiles.read[tile])
        fed += steps * (of_tile if tiled else content["irradiance_bits"])
    lag = cycles - window
    if hw["coded"] or fed:
        return by_columns(report, parts, content, hw, tiles, streams, fed, lag, interval)
    column = high * parts["lanes"] * parts["cell_bits"]
    slot = ceil(column / 512)
    column, alone, ratio = slot * 512 if tiled else column, min(lag, window), hw["clock_mhz"] / d["mhz"]
    state = sum(len(tiles.read[tile]) for tile, _ in streams) * deep * column
    reads, writes = (state + fed) / 512, sum(len(tiles.owned[tile]) for tile, _ in streams) * deep * column / 512
    aparts = distances(report, tiles, lag / (interval * high), slot) if tiled else 2 * (state / 512 * lag / window,)
    share = state / (state + fed)
    meetings = [share * sum(meeting(apart + more) for apart in aparts) / 2 + (1 - share) / d["banks"]
                for more in (d["batch"], 0)]
    return floor(ratio * (d["rcd"] + d["cl"] + d["beats"] + d["interface"]) + lag - alone
                 + max(alone, ratio * dram(reads * alone / window, 0, meetings))
                 + max(window - alone, ratio * dram(reads * (1 - alone / window), writes * (1 - alone / window), meetings))
                 + max(alone, ratio * dram(0, writes * alone / window, meetings)) + .5)


def pieces(width, of):
    return 1 if width <= of else 1 + ceil((width - of) / (of - 1))


def fixed_of(report, parts, hw):
    """Logic, products, registers and channels: (lut, ff, dsp, lutram, ports)."""
    f, p, t = report["family"], parts["lanes"], hw["cascade"]
    ports = 2 + (t if parts["fed"] else 0)
    lut, ff, dsp, lutram = f["base"]["lut"] + ports * f["port"]["lut"], f["base"]["ff"] + ports * f["port"]["ff"], 0, 0
    widths = [(parts["cell_bits"], 1)]
    for stage in parts["stages"]:
        c, blocks = f["stages"][stage["name"]], stage["random_blocks_per_8_lanes"] * ceil(p / 8)
        for name in ("lut", "ff"):
            cost = p * (c[name] + stage["dividers"] * f["divider"][name]) + blocks * f["random_block"][name]
            lut, ff = (lut + t * cost, ff) if name == "lut" else (lut, ff + t * cost)
        a, b = f["product"]
        for i in range(stage["multipliers"] if c["multipliers"] else 0):
            w, v = c["multipliers"][min(i, len(c["multipliers"]) - 1)]
            dsp += t * p * min(pieces(w, a) * pieces(v, b), pieces(w, b) * pieces(v, a))
        ff += t * sum(b["words"] * b["lanes"] * b["bits"] for b in stage["buffers"] if b["words"] <= f["register_words"])
        widths.append((stage["output_bits"], t))
    for bits, times_ in widths + ([(16, t)] if parts["fed"] else []):
        lut, ff = lut + times_ * f["channel"]["lut"], ff + times_ * f["channel"]["ff"]
        if hw["fifo_depth"] <= f["register_words"]:
            ff += times_ * hw["fifo_depth"] * bits * p
        else:
            lutram += times_ * lutram_of(f, hw["fifo_depth"], bits * p)
    if hw["coded"]:
        high = report["grid"][1]
        for words, bits in ((8, high), (1, high), (ceil(high / 512), 512)):
            lutram += lutram_of(f, words, bits) if words > f["register_words"] else 0
            ff += words * bits if words <= f["register_words"] else 0
        lut, ff = lut + 2 * f["coder"]["lut"], ff + 2 * f["coder"]["ff"]
    return lut + lutram, ff, dsp, lutram, ports


def lutram_of(f, words, bits):
    deep = ceil(words / f["lutram_words"])
    return deep * ceil(bits / f["lutram_bits"]) * f["lutram_luts"] + bits * ceil((deep - 1) / (f["mux_ways"] - 1))


def ways(f, words, bits, times_):
    found = []
    if words <= f["deepest_lutram"]:
        found.append((times_ * lutram_of(f, words, bits), 0, 0))
    for at, shapes in ((1, f["bram_shapes"]), (2, f["uram_shapes"])):
        if shapes:
            n = times_ * min(ceil(bits / b) * ceil(words / w) for b, w in shapes)
            found.append((0, n, 0) if at == 1 else (0, 0, n))
    return found


def choices_of(report, parts, hw):
    f, t = report["family"], hw["cascade"]
    ports = fixed_of(report, parts, hw)[4]
    buffers = [ways(f, b["words"], b["lanes"] * b["bits"], t) for s in parts["stages"] for b in s["buffers"]
               if b["words"] > f["register_words"]]
    return buffers + [ways(f, f["port_words"], f["port_bits"], ports)]


def share(used, there):
    return 0 if used == 0 else used / there if there else inf


def fullest(report, fixed, lutram, parts, uram):
    lut, ff, dsp, channels, _ = fixed
    u = report["usable"]
    return max(share(lut + lutram, u["lut"]), share(channels + lutram, report["lutram"]), share(ff, u["ff"]),
               share(dsp, u["dsp"]), share(ceil(parts / report["family"]["bram_parts"]), u["bram"]), share(uram, u["uram"]))


def search(report, fixed, choices):
    """The least that the fullest resource can be: depth first, and no branch that is already fuller."""
    choices = sorted(choices, key=lambda c: -max(max(w) for w in c))
    best = inf

    def down(i, lutram, parts, uram):
        nonlocal best
        full = fullest(report, fixed, lutram, parts, uram)
        if full >= best:
            return
        if i == len(choices):
            best = full
            return
        for a, b, c in sorted(choices[i], key=lambda w: fullest(report, fixed, lutram + w[0], parts + w[1], uram + w[2])):
            down(i + 1, lutram + a, parts + b, uram + c)

    down(0, 0, 0, 0)
    return best


class Explore(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.scene = write(self.folder, SMALL.replace("[12, 10, 12]", "[48, 40, 12]"))

    def explore(self, *arguments, code=0):
        result = voxmelt("explore", *arguments, "--out", "out", cwd=self.folder, timeout=400)
        self.assertEqual(result.returncode, code, result.stderr)
        rows = list(csv.DictReader((self.folder / "out/explore.csv").read_text().splitlines()))
        return json.loads((self.folder / "out/explore.json").read_text()), rows, result.stdout

    def compare(self, report, rows, every):
        """Times of every configuration, and resources of every so many; the best of all."""
        parts = {(p["lanes"], p["substeps"], p["tile"]): p for p in report["parts"]}
        full, known, tried = {}, {}, set()
        best = (0, 0)
        cells = report["grid"][0] * report["grid"][1] * report["grid"][2]
        for i, row in enumerate(rows):
            hw = {k: int(row[k]) for k in ("lanes", "cascade", "substeps", "fifo_depth", "overlap", "coded", "tile", "clock_mhz")}
            part = parts[hw["lanes"], hw["substeps"], hw["tile"]]
            tried.add((hw["lanes"], hw["cascade"], hw["tile"]))
            # Channels of depth 2 and more take the same time.
            same = tuple(v if k != "fifo_depth" else v == 1 for k, v in hw.items())
            known[same] = known.get(same) or times(report, part, hw)
            free, memory = known[same]
            self.assertEqual(free, int(row["cycles"]), hw)
            self.assertAlmostEqual(memory, int(row["cycles_on_memory"]), delta=len(rows), msg=hw)
            speed = int(row["cell_steps_per_second"])
            self.assertAlmostEqual(cells * report["steps"] * hw["clock_mhz"] * 1e6 / memory / speed, 1, delta=1e-3)
            key = hw["lanes"], hw["cascade"], hw["substeps"], hw["fifo_depth"], hw["coded"], hw["tile"]
            if (speed > best[0] or i % every == 0) and key not in full:
                fixed = fixed_of(report, part, hw)
                full[key] = search(report, fixed, choices_of(report, part, hw))
            if key in full:
                self.assertAlmostEqual(min(full[key], 1e300), min(float(row["fullest"]), 1e300), delta=1e-6, msg=hw)
                if full[key] <= 1 and speed > best[0]:
                    best = speed, hw
        for (lanes, cascade), widths in itertools.groupby(sorted(tried), lambda one: one[:2]):
            any_part = next(p for p in report["parts"] if p["lanes"] == lanes)
            uncut = Tiles(report, any_part, {"cascade": cascade, "tile": 0})
            every_width = range(uncut.blocks - 1, 2 * uncut.halo, -1)  # the narrowest last
            narrowest = {uncut.count(width): width * lanes for width in every_width}
            wanted = {0} | {narrowest[n] for n in report["axes"]["tiles"] if n > 1 and n in narrowest}
            self.assertEqual({tile for _, _, tile in widths}, wanted, (lanes, cascade))
        self.assertEqual(report["configurations"], len(rows))
        self.assertEqual(report["best"]["cell_steps_per_second"], best[0])
        return best

    def test_an_exhaustive_search_agrees(self):
        for device, memory in (("zu7ev", "ddr4-2400"), ("ecp5-85f", "none")):
            with self.subTest(device):
                report, rows, said = self.explore(self.scene, "--device", device, "--memory", memory, "--points", 0)
                self.assertGreaterEqual(len(rows), 1000)
                self.compare(report, rows, 97)
                self.assertIn(report["answer"], said)

    def test_the_front_is_what_nothing_beats(self):
        report, rows, _ = self.explore(self.scene, "--device", "ecp5-85f", "--memory", "none", "--points", 0,
                                       "--set", "hw.lanes=4")
        fits = [row for row in rows if row["fits"] == "1"]
        speed = lambda row: int(row["cell_steps_per_second"])
        front = set()
        for axis in (*NAMES, "clock_mhz"):
            so_far = -1
            for amount in sorted({int(row[axis]) for row in fits}):
                fastest = max(speed(row) for row in fits if int(row[axis]) == amount)
                if fastest > so_far:
                    front.add((axis, amount, fastest))
                    so_far = fastest
        shown = [row for row in rows if row["on_front"] == "1"]
        for row in shown:  # on one axis at least
            self.assertTrue(any((axis, int(row[axis]), speed(row)) in front for axis in (*NAMES, "clock_mhz")), row)
        for axis, amount, fastest in front:
            self.assertTrue(any(int(row[axis]) == amount and speed(row) == fastest for row in shown), (axis, amount))
        best = [row for row in fits if speed(row) == report["best"]["cell_steps_per_second"]]
        self.assertGreater(len(best), 1, "the least full of several")
        self.assertAlmostEqual(report["best"]["fullest"], min(float(row["fullest"]) for row in best), delta=1e-6)
        self.assertLessEqual(len(shown), len(front))

    def test_fewer_units_change_the_answer(self):
        tight = ["--device", "ecp5-85f", "--memory", "none", "--points", 0]
        report, rows, _ = self.explore(self.scene, *tight)
        fewer, fewer_rows, _ = self.explore(self.scene, *tight, "--set", "device.bram=40")
        self.compare(fewer, fewer_rows, 97)
        self.assertLess(fewer["best"]["cell_steps_per_second"], report["best"]["cell_steps_per_second"])
        nothing, _, said = self.explore(self.scene, *tight, "--set", "device.dsp=0")
        self.assertIsNone(nothing["best"])
        self.assertIn("fits on ecp5-85f", said)

    def test_the_next_unit_buys_what_it_says(self):
        tight = ["--device", "ecp5-85f", "--memory", "none", "--points", 0]
        report, _, _ = self.explore(self.scene, *tight)
        for name in NAMES:
            one = report["next"][name]
            if one["design"] is None:
                continue
            fill = 0.8 if name in ("lut", "ff") else 1
            # One unit less buys nothing.
            for less, speed in ((0, one["design"]["cell_steps_per_second"]), (1, report["best"]["cell_steps_per_second"])):
                amount = ceil((report["usable"][name] + one["more"] - less) / fill - 1e-9)
                sets = ["--set", f"device.{name}={amount}"]
                if name == "lut":
                    sets += ["--set", f"device.lutram={amount}"]
                again, _, _ = self.explore(self.scene, *tight, *sets)
                self.assertEqual(again["best"]["cell_steps_per_second"], speed, (name, less))

    def test_points_are_simulated(self):
        report, rows, said = self.explore(self.scene, "--device", "zu7ev", "--points", 3, "--set", "hw.clock_mhz=300")
        verified = [p for p in report["front"] if p["state"] == "verified"]
        self.assertEqual(len(verified), 3)
        self.assertEqual(report["best"]["state"], "verified")
        for point in verified:
            s = point["simulated"]
            self.assertEqual(s["cycles"], s["predicted_cycles"])
            self.assertGreaterEqual(s["compared_cells"], 48 * 40 * 12 * s["steps"])
            self.assertLess(abs(s["error"]), 0.1)  # of a run of a thousand cycles: its ends count
        self.assertEqual(sum(int(row["verified"]) for row in rows), 3)
        self.assertEqual(said.count("verified,"), 4)  # with the sentence
        self.assertTrue((self.folder / "out/explore.svg").read_text().startswith("<svg"))

    def test_tiles_where_no_plane_fits(self):
        """A plane of 512 x 40 cells takes more than all the memories of this device."""
        wide = write(self.folder, SMALL.replace("[12, 10, 12]", "[512, 40, 4]"), "wide.toml")
        some = ["--device", "ecp5-85f", "--set", "hw.cascade=1", "--set", "hw.clock_mhz=100", "--set", "hw.fifo_depth=2"]
        report, rows, said = self.explore(wide, *some, "--points", 2)
        self.compare(report, rows, 1)
        self.assertEqual({row["fits"] for row in rows if row["tile"] == "0"}, {"0"})
        best = report["best"]
        self.assertGreater(best["hw"]["tile"], 0)
        self.assertEqual(best["state"], "verified")
        self.assertEqual(best["simulated"]["cycles"], best["simulated"]["predicted_cycles"])
        self.assertLess(abs(best["simulated"]["error"]), 0.05)
        self.assertIn(f"tiles of {best['hw']['tile']} columns", said)
        none, _, said = self.explore(wide, *some, "--points", 0, "--set", "hw.tile=0")
        self.assertIsNone(none["best"])
        one, rows, _ = self.explore(wide, *some, "--points", 0, "--set", "hw.tile=128")
        self.assertEqual({row["tile"] for row in rows}, {"128"})
        self.assertEqual(one["axes"]["tile"], 128)

    def test_bad_usage(self):
        for arguments, message in (
                (["--device", "zu7ev", "--set", "hw.tile=1", "--set", "hw.lanes=2"], "hw.tile = 1: no lanes and steps"),
                (["--device", "zu9eg"], 'no device "zu9eg"; there are ecp5-85f, zu7ev'),
                (["--device", "zu7ev", "--memory", "sram"], "there are none, ddr4-2400, hbm2, lpddr4-3200"),
                (["--device", "zu7ev", "--set", "device.brams=3"], "device.brams"),
                (["--device", "zu7ev", "--set", "hw.lanes=3"], "not among those that are tried: 1, 2, 4"),
                (["--device", "zu7ev", "--set", "hw.clock_mhz=301"], "hw.clock_mhz"),
                (["--device", "missing.toml"], "missing.toml")):
            result = voxmelt("explore", self.scene, *arguments, "--points", 0, cwd=self.folder)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(message, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)


class SizedChannels(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.scene = write(self.folder, SMALL)

    def verify(self, *arguments):
        result = voxmelt("verify", self.scene, "--steps", 4, *arguments, "--report", "r.json", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return json.loads((self.folder / "r.json").read_text()), result.stdout

    def test_depths_lose_no_cycle_and_are_read_again(self):
        coded = ["--set", "hw.memory=hbm2", "--set", "hw.coded=1"]
        for sets in (["--set", "hw.stall_seed=5"], ["--set", "hw.memory=ddr4-2400", "--set", "hw.lanes=8"], coded):
            deep, _ = self.verify(*sets, "--set", "hw.cascade=2", "--set", "hw.fifo_depth=1024")
            sized, said = self.verify(*sets, "--set", "hw.cascade=2", "--size-fifos", "fifos.toml")
            memory = [s for s in sets if "memory" in s]
            (self.assertLessEqual if memory else self.assertEqual)(sized["cycles"], deep["cycles"])
            self.assertEqual(sized["digest"], deep["digest"])
            again, _ = self.verify("--hw", "fifos.toml", *(["--set", *memory] if memory else []))
            self.assertEqual(again["cycles"], sized["cycles"])
            self.assertEqual([c["depth"] for c in again["channels"]], [c["depth"] for c in sized["channels"]])
            self.assertLess(max(c["depth"] for c in sized["channels"]), 1024)
            self.assertIn("one less costs", said)

    def test_the_table_says_what_the_channels_cost(self):
        sized, said = self.verify("--set", "hw.stall_seed=5", "--set", "hw.lanes=8", "--size-fifos", "fifos.toml")
        rows = {row[0]: row for row in re.findall(r"^(step \d+: \S+ -> \S+) +(\d+) +\d+ +(\d+) +(\d+) cycles$", said, re.M)}
        channels = [c for c in sized["channels"] if c["name"] in rows]
        self.assertGreater(len(channels), 3)
        for channel in channels:
            self.assertEqual(int(rows[channel["name"]][1]), channel["depth"])
            self.assertEqual(int(rows[channel["name"]][2]), channel["depth"] * channel["bits"] * 8)
        text = (self.folder / "fifos.toml").read_text()
        deep = max(channels, key=lambda c: c["depth"])
        entry = f'name = "{deep["name"]}"\ndepth = '
        self.assertIn(f'{entry}{deep["depth"]}\n', text)
        write(self.folder, text.replace(f'{entry}{deep["depth"]}\n', f'{entry}{deep["depth"] - 1}\n'), "less.toml")
        less, _ = self.verify("--hw", "less.toml")
        self.assertEqual(less["cycles"] - sized["cycles"], int(rows[deep["name"]][3]))

    def test_a_memory_sees_the_irradiance_of_every_step(self):
        result = voxmelt("verify", "proving_ground", "--steps", 3, "--set", "heat.visibility_every=1", "--set", "hw.lanes=8",
                         "--set", "hw.memory=ddr4-2400", "--set", "hw.clock_mhz=600", "--size-fifos", "slow.toml",
                         cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_a_memory_costs_cycles_and_no_bits(self):
        free, _ = self.verify("--set", "hw.lanes=16")
        slow, _ = self.verify("--set", "hw.lanes=16", "--set", "hw.memory=ddr4-2400", "--set", "hw.clock_mhz=600")
        self.assertGreater(slow["cycles"], free["cycles"])
        self.assertEqual(slow["digest"], free["digest"])
        tiles, _ = self.verify("--set", "hw.lanes=1", "--set", "hw.memory=ddr4-2400", "--set", "hw.tile=9")
        self.assertGreater(tiles["tiles"]["count"], 1)
        self.assertEqual(tiles["digest"], free["digest"])
        for report in (slow, tiles):
            for stage in report["stages"]:
                self.assertEqual(sum(stage["cycles"].values()), report["cycles"])
            self.assertGreater(report["stages"][0]["cycles"]["memory"], 0)
        self.assertEqual(free["stages"][0]["cycles"]["memory"], 0)

    def test_bad_files(self):
        write(self.folder, "[hw]\n[[hw.channel]]\nname = \"reader -> moon\"\ndepth = 3\n", "moon.toml")
        write(self.folder, "[hw]\n[[hw.channel]]\nname = \"reader -> moon\"\ndepth = 0\n", "zero.toml")
        for arguments, message in ((["--hw", "moon.toml"], 'no channel "reader -> moon"'),
                                   (["--hw", "zero.toml"], "depth"),
                                   (["--set", "hw.memory=sram"], "no memory"),
                                   (["--size-fifos", "f.toml", "--plant", "gravity-room"], "--size-fifos")):
            result = voxmelt("verify", self.scene, *arguments, cwd=self.folder)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(message, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)


class Search(unittest.TestCase):
    def test_by_every_product(self):
        """The search of this file finds what trying every product finds."""
        report = {"usable": {"lut": 900, "ff": 9, "dsp": 9, "bram": 7, "uram": 3}, "lutram": 700,
                  "family": {"bram_parts": 2}}
        fixed = (100, 1, 1, 10, 2)
        choices = [[(300, 0, 0), (0, 5, 0), (0, 0, 2)], [(100, 0, 0), (0, 9, 0)], [(90, 0, 0), (0, 3, 0), (0, 0, 1)]]
        every = min(fullest(report, fixed, *(sum(w[k] for w in one) for k in range(3)))
                    for one in itertools.product(*choices))
        self.assertEqual(search(report, fixed, choices), every)


if __name__ == "__main__":
    unittest.main(argv=["explore_test"], verbosity=1)
