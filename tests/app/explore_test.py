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


def trains(report, parts, hw):
    """(passes, steps of the first pass, steps) of each train."""
    done, n, every = 0, parts["tokens"], report["visibility_every"]
    interval = 2 if hw["fifo_depth"] == 1 else 1
    while done < report["steps"]:
        passes, first, begin = 0, 0, done
        while True:
            step = report["first_step"] + done
            k = min(hw["cascade"], report["steps"] - done, every - step % every if every else inf)
            passes, first, done = passes + 1, first or k, done + k
            lags = sum(s["lag"] if s["lag"] < n else n - 1 + (s["lag"] - n + 1) / interval for s in parts["stages"])
            channels = hw["cascade"] * len(parts["stages"]) + 1
            held = report["grid"][1] - 1 if hw["coded"] else 0
            overlaps = hw["overlap"] and interval * (n - held) > interval * k * lags + channels
            if done == report["steps"] or not overlaps or (every and (report["first_step"] + done) % every == 0):
                break
        yield passes, first, done - begin


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


def by_columns(report, parts, hw, passes, steps, lag, interval):
    """The coded state: the bus serves column after column, the pipeline takes each when it has come."""
    d, high = DDR4, report["grid"][1]
    ratio = hw["clock_mhz"] / d["mhz"]
    run = 1 - (d["rtp"] + d["rp"] + d["rfc"] + d["rcd"]) / d["refi"]
    columns = parts["coded_columns"] * passes
    bits, fed = sum(columns) * 512, parts["irradiance_bits"] * steps
    apart = lag / (interval * high) * ceil(high * (1 + parts["lanes"] * parts["cell_bits"]) / 512)
    state = bits / (bits + fed)
    of_writes, of_reads = (state * meeting(at) + (1 - state) / d["banks"] for at in (apart + d["batch"], apart))
    turn = (d["rtw"] + d["wtr_s"] + d["cl"]
            + (d["rtp"] + d["rp"] + d["rcd"] - (d["cl"] + d["beats"] - d["cwl"]) - d["rtw"]) * of_writes
            + (d["wr"] + d["rp"] + d["rcd"] - d["wtr_s"]) * of_reads)
    read, write = ratio * d["beats"] / run, ratio * (d["beats"] + turn / d["batch"]) / run
    latency = ratio * (d["rcd"] + d["cl"] + d["beats"] + d["interface"])
    taken, behind = interval * high, floor(lag / (interval * high) + .5)
    fed = fed / 512 / len(columns)
    done, bus, waiting, asked, freed, written, most = [], 0, 0, 0, 0, 0, 128 + 64
    for c, own in enumerate(columns):
        asked += own
        while freed < c and asked > 128:
            asked, freed = asked - columns[freed], freed + 1
        gate = max(done[freed - 1] if freed else 0, done[c - 8] if c >= 8 else 0)
        start = max(bus, gate)
        while written + behind < c and done[written + behind] <= start:
            waiting, written = waiting + columns[written], written + 1
        waiting -= min(waiting, (start - bus) / write)
        served = max(min(waiting, own), waiting - most)
        waiting -= served
        bus = start + (own + fed) * read + served * write
        come = max(bus, gate + 2 * latency + own * read)
        done.append(max((done[-1] if done else 0) + taken, come + taken / max(own, 1)))
    end, left = done[-1], lag
    while left > 0:
        step, left = min(left, taken), left - taken
        end += step
        waiting, written = waiting + (columns[written] if written < len(columns) else 0), written + 1
        waiting -= min(waiting, step / write)
        end, waiting = end + max(waiting - most, 0) * write, min(waiting, most)
    return floor(end + .5)


def times(report, parts, hw):
    free = memory = 0
    n, stages = parts["tokens"], parts["stages"]
    interval = 2 if hw["fifo_depth"] == 1 else 1
    for passes, first, steps in trains(report, parts, hw):
        wait = sum(interval * s["lag"] if s["lag"] < n else interval * (n - 1) + s["lag"] - n + 1 for s in stages)
        cycles = interval * (passes * n - 1) + first * wait + hw["cascade"] * len(stages) + 2
        free += cycles
        if report["memory"] == "none":
            memory += cycles
            continue
        window, cells = interval * passes * n, n * parts["lanes"]
        if hw["coded"]:
            memory += by_columns(report, parts, hw, passes, steps, cycles - window, interval)
            continue
        lag = cycles - window
        alone = min(lag, window)
        bits = passes * cells * parts["cell_bits"]
        reads, writes = (bits + parts["irradiance_bits"] * steps) / 512, bits / 512
        ratio = hw["clock_mhz"] / DDR4["mhz"]
        apart = writes * lag / window
        state = writes / reads
        meetings = [state * meeting(d) + (1 - state) / DDR4["banks"] for d in (apart + DDR4["batch"], apart)]
        memory += round(ratio * (DDR4["rcd"] + DDR4["cl"] + DDR4["beats"] + DDR4["interface"]) + lag - alone
                        + max(alone, ratio * dram(reads * alone / window, 0, meetings))
                        + max(window - alone, ratio * dram(reads * (1 - alone / window), writes * (1 - alone / window), meetings))
                        + max(alone, ratio * dram(0, writes * alone / window, meetings)))
    return free, memory


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
        parts = {(p["lanes"], p["substeps"]): p for p in report["parts"]}
        full = {}
        best = (0, 0)
        cells = report["grid"][0] * report["grid"][1] * report["grid"][2]
        for i, row in enumerate(rows):
            hw = {k: int(row[k]) for k in ("lanes", "cascade", "substeps", "fifo_depth", "overlap", "coded", "clock_mhz")}
            part = parts[hw["lanes"], hw["substeps"]]
            free, memory = times(report, part, hw)
            self.assertEqual(free, int(row["cycles"]), hw)
            self.assertAlmostEqual(memory, int(row["cycles_on_memory"]), delta=len(rows), msg=hw)
            speed = int(row["cell_steps_per_second"])
            self.assertAlmostEqual(cells * report["steps"] * hw["clock_mhz"] * 1e6 / memory / speed, 1, delta=1e-3)
            key = hw["lanes"], hw["cascade"], hw["substeps"], hw["fifo_depth"], hw["coded"]
            if (speed > best[0] or i % every == 0) and key not in full:
                fixed = fixed_of(report, part, hw)
                full[key] = search(report, fixed, choices_of(report, part, hw))
            if key in full:
                self.assertAlmostEqual(min(full[key], 1e300), min(float(row["fullest"]), 1e300), delta=1e-6, msg=hw)
                if full[key] <= 1 and speed > best[0]:
                    best = speed, hw
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

    def test_bad_usage(self):
        for arguments, message in (
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
            self.assertEqual(sized["cycles"], deep["cycles"])
            self.assertEqual(sized["digest"], deep["digest"])
            memory = [s for s in sets if "memory" in s]
            again, _ = self.verify("--hw", "fifos.toml", *(["--set", *memory] if memory else []))
            self.assertEqual(again["cycles"], deep["cycles"])
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
