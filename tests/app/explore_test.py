#!/usr/bin/env python3
"""`voxmelt explore` beside an exhaustive search of its own: times and numbers of resources again, from the parts and
coefficients in the report.

  explore_test.py PROGRAM          a seventh of all times, and those near the best
  explore_test.py PROGRAM --all    every time, and a larger device (slow: minutes of plain Python)
"""
import csv
import itertools
import json
import re
import sys
import tempfile
import unittest
from math import ceil
from pathlib import Path

from explore_search import DDR4, Tiles, choices_of, fixed_of, fullest, operations, search, times, trains
from program import SMALL, voxmelt, write

EVERY_TIME = 1 if "--all" in sys.argv else 7
NAMES = ("lut", "ff", "dsp", "bram", "uram")
STOP = sum(DDR4[name] for name in ("rtp", "rp", "rfc", "rcd"))  # cycles of a refresh, with its rows
AXES = (*NAMES, "clock_mhz", "femtojoules")


PLENTY = ("--set", "device.lut=400000", "--set", "device.ff=400000")  # of logic, so that something else bounds


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
        """Times of a part of the configurations, and resources of every so many; the best of all."""
        near = report["best"]["cell_steps_per_second"]
        parts = {(p["lanes"], p["substeps"], p["tile"]): p for p in report["parts"]}
        full, known, tried = {}, {}, set()
        best = (0, 0)
        cells = report["grid"][0] * report["grid"][1] * report["grid"][2]
        for i, row in enumerate(rows):
            hw = {k: int(row[k]) for k in ("lanes", "cascade", "substeps", "fifo_depth", "overlap", "coded", "tile", "clock_mhz")}
            part = parts[hw["lanes"], hw["substeps"], hw["tile"]]
            tried.add((hw["lanes"], hw["cascade"], hw["tile"]))
            speed = int(row["cell_steps_per_second"])
            if i % EVERY_TIME == 0 or abs(speed - near) < 0.02 * near:
                # Channels of depth 2 and more take the same time.
                same = tuple(v if k != "fifo_depth" else v == 1 for k, v in hw.items())
                known[same] = known.get(same) or times(report, part, hw)
                free, memory = known[same]
                self.assertEqual(free, int(row["cycles"]), hw)
                # The program takes what does not wait at one clock not to wait at a lower one. A pass may meet a
                # refresh there all the same.
                passes = sum(map(len, trains(report, part, hw, Tiles(report, part, hw))))
                refreshes = 0 if report["memory"] == "none" else passes
                on_memory = int(row["cycles_on_memory"])
                self.assertAlmostEqual(memory, on_memory, delta=2 + refreshes * STOP * hw["clock_mhz"] / 1200, msg=hw)
                energy = int(row["femtojoules"]) - int(row["memory_femtojoules"])
                self.assertAlmostEqual(operations(report, part, hw) / energy, 1, delta=1e-4, msg=hw)
                self.assertAlmostEqual(cells * report["steps"] * hw["clock_mhz"] * 1e6 / on_memory / speed, 1, delta=1e-3)
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
        # On a memory three passes, because the program follows no more of them.
        machines = (("ecp5-85f", "none", 32), ("zu7ev", "ddr4-2400", 3))
        for device, memory, steps in machines if EVERY_TIME == 1 else machines[:1]:
            with self.subTest(device):
                report, rows, said = self.explore(self.scene, "--device", device, "--memory", memory, "--points", 0,
                                                  "--steps", steps)
                self.assertGreaterEqual(len(rows), 1000)
                self.compare(report, rows, 97)
                self.assertIn(report["answer"], said)

    def test_an_exhaustive_search_agrees_where_pieces_fall(self):
        """A cube that hangs in the air falls in the first step, and so in all. One that stands does not."""
        for at, lit in (("[6, 20, 6]", True), ("[6, 20, 6]", False), ("[6, 4, 6]", True)):
            with self.subTest(at=at, lit=lit):
                text = self.scene.read_text().replace("at = [6, 4, 6]", f"at = {at}").replace("[flow]", "[pieces]\n[flow]")
                scene = write(self.folder, text if lit else text.replace("power = 30", "power = 0"), "falls.toml")
                report, rows, _ = self.explore(scene, "--device", "zu7ev", "--points", 0, "--set", "hw.fifo_depth=2",
                                               "--set", "hw.clock_mhz=300", "--set", "hw.lanes=4", "--steps", 4)
                self.assertEqual({c["falls"] for c in report["contents"]}, {at == "[6, 20, 6]"})
                self.compare(report, rows, 97)

    def test_nothing_is_said_of_parts_that_a_device_does_not_have(self):
        for device, memory, none in (("ecp5-85f", "none", []), ("zu7ev", "ddr4-2400", ["--set", "device.uram=0"])):
            report, _, said = self.explore(self.scene, "--device", device, "--memory", memory, "--points", 0, "--set",
                                           "device.bram=40", "--set", "hw.lanes=2", *PLENTY, *none)
            self.assertNotIn("more URAM", said)
            self.assertIn("more BRAM", said)
            self.assertIsNone(report["next"]["uram"]["more"])
            self.assertNotIn(" -0.0 ", said)

    def test_the_front_is_what_nothing_beats(self):
        report, rows, _ = self.explore(self.scene, "--device", "ecp5-85f", "--memory", "none", "--points", 0,
                                       "--set", "hw.lanes=4", *PLENTY)
        fits = [row for row in rows if row["fits"] == "1"]
        speed = lambda row: int(row["cell_steps_per_second"])
        front = set()
        for axis in AXES:
            so_far = -1
            for amount in sorted({int(row[axis]) for row in fits}):
                fastest = max(speed(row) for row in fits if int(row[axis]) == amount)
                if fastest > so_far:
                    front.add((axis, amount, fastest))
                    so_far = fastest
        shown = [row for row in rows if row["on_front"] == "1"]
        for row in shown:  # on one axis at least
            self.assertTrue(any((axis, int(row[axis]), speed(row)) in front for axis in AXES), row)
        for axis, amount, fastest in front:
            self.assertTrue(any(int(row[axis]) == amount and speed(row) == fastest for row in shown), (axis, amount))
        frugal = report["frugal"]["femtojoules_per_cell_step"]["all"]
        self.assertEqual(frugal, min(int(row["femtojoules"]) for row in fits))
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
        shown = list(csv.DictReader((self.folder / "out/explore.csv").read_text().splitlines()))
        least = min(shown, key=lambda row: (float(row["fullest"]), int(row["lut"])))
        self.assertIn(f'{least["lanes"]} lanes x {least["cascade"]} steps at', said)
        self.assertIn(f'takes {least["dsp"]} DSP, where 0 are usable', said)

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
        # Three passes, because the program follows no more of them and takes the others to be like the second.
        some = ["--device", "ecp5-85f", "--steps", 3, "--set", "hw.cascade=1", "--set", "hw.clock_mhz=100", "--set", "hw.fifo_depth=2"]
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

    def test_only_what_is_written(self):
        """With --rtl the answer is a pipeline that `voxmelt rtl` writes, and no other one is tried."""
        asked = ["--device", "zu7ev", "--memory", "none", "--points", 0, "--set", "hw.fifo_depth=2"]
        every, rows, _ = self.explore(self.scene, *asked)
        self.assertIn("6", {row["lanes"] for row in rows})
        report, rows, _ = self.explore(self.scene, *asked, "--rtl")
        self.assertEqual({row["lanes"] for row in rows}, {"1", "2", "4", "8", "16"})
        self.assertEqual({row["cascade"] for row in rows}, {str(n) for n in range(1, 17)})
        self.assertEqual({row["tile"] for row in rows}, {"0"})
        self.assertLessEqual(report["best"]["cell_steps_per_second"], every["best"]["cell_steps_per_second"])
        self.compare_best_of(report, [row for row in rows if row["fits"] == "1"])
        sets = [word for key in ("lanes", "cascade", "fifo_depth") for word in ("--set", f"hw.{key}={report['best']['hw'][key]}")]
        written = voxmelt("rtl", self.scene, *sets, "--out", "rtl", cwd=self.folder, timeout=400)
        self.assertEqual(written.returncode, 0, written.stderr)
        falls = write(self.folder, self.scene.read_text().replace("[flow]", "[pieces]\n[flow]"), "falls.toml")
        _, rows, _ = self.explore(falls, *asked, "--rtl")
        self.assertEqual({row["cascade"] for row in rows}, {"1"})

    def compare_best_of(self, report, rows):
        self.assertEqual(report["best"]["cell_steps_per_second"], max(int(row["cell_steps_per_second"]) for row in rows))

    def test_bad_usage(self):
        for arguments, message in (
                (["--device", "zu7ev", "--rtl", "--set", "hw.lanes=3"], "writes no such pipeline: hw.lanes is 1, 2, 4, 8 or 16"),
                (["--device", "zu7ev", "--rtl", "--set", "hw.tile=64"], "writes no such pipeline: it writes no tiles"),
                (["--device", "zu7ev", "--rtl", "--set", "device.chain=2"], "which `voxmelt rtl` does not write"),
                (["--device", "zu7ev", "--set", "hw.tile=1", "--set", "hw.lanes=2"], "hw.tile = 1: no lanes and steps"),
                (["--device", "zu9eg"], 'no device "zu9eg"; there are alveo-u280, artix-200t, ecp5-85f, zu7ev'),
                (["--device", "zu7ev", "--memory", "sram"], "there are none, ddr4-2400, ddr5-4800, gddr6, hbm2-stack, hbm2, hbm3, lpddr4-3200"),
                (["--device", "zu7ev", "--set", "device.brams=3"], "device.brams"),
                (["--device", "zu7ev", "--set", "hw.lanes=33"], "not among those that are tried: 1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 24"),
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
