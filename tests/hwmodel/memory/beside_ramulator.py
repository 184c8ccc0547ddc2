#!/usr/bin/env python3
"""The DRAM model beside Ramulator 1.0 (github.com/CMU-SAFARI/ramulator), on traces that both run as fast as they can.

  beside_ramulator.py BUILD RAMULATOR

Ramulator is built by `make`, with the scheduler FRFCFS_PriorHit (a line of src/Scheduler.h): rows with a waiting hit
stay open, as here. Both have the grade 16-16-16, which is in its table. Prints the tables of docs/hardware/memory.md.
"""
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
GRADE = {"cl": 16, "rcd": 16, "rp": 16, "rp_all": 16, "rc": 55}
CONFIGURATION = "standard = DDR4\nchannels = 1\nranks = 1\nspeed = DDR4_2400R\norg = DDR4_8Gb_x8\nrecord_cmd_trace = off\nprint_cmd_trace = off\n"
FAR, TWO_BANKS = 1 << 30, 1 << 16  # another row of the same banks; the bank after the next
TURN = 21  # writes: Ramulator begins them above 25, four fifths of 32, and ends below 6, a fifth


def streams(apart):
    return [request for i in range(200000) for request in ((64 * i, "R"), (apart + 64 * i, "W"))]


def made(rng):
    place = lambda: rng.randrange(1 << 26) * 64
    return {
        "a stream of reads": [(64 * i, "R") for i in range(400000)],
        "a stream of writes": [(64 * i, "W") for i in range(400000)],
        "reads anywhere": [(place(), "R") for _ in range(200000)],
        "anywhere, 30 % writes": [(place(), "RW"[rng.random() < 0.3]) for _ in range(200000)],
        "a reader and a writer, other banks": streams(FAR + TWO_BANKS),
        "a reader and a writer, same banks": streams(FAR),
    }


def picture(build, folder):
    trace = folder / "picture.trace"
    subprocess.run([build / "app/voxmelt", "verify", "cello", "--picture", "--from", "200", "--size", "128x128", "--no-compare", "--quiet",
                    "--set", "pieces.fall=false", "--set", "hw.memory=ddr4-2400", "--set", f"hw.memory_trace={trace}"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return [(int(address, 16), kind) for address, kind in map(str.split, trace.read_text().splitlines())]


def cycles(build, ramulator, folder, requests):
    ours, theirs, stats = folder / "ours.trace", folder / "theirs.trace", folder / "stats"
    ours.write_text("".join(f"0x{address:08x} {kind}\n" for address, kind in requests))
    said = subprocess.run([build / "tests/hwmodel/replay_trace", folder / "memory.toml", ours, theirs], check=True, capture_output=True, text=True).stdout
    subprocess.run([ramulator, folder / "ddr4.cfg", "--mode=dram", "--stats", stats, theirs], check=True, capture_output=True)
    own, turns = map(int, re.search(r"(\d+) cycles, (\d+) turns", said).groups())
    return own, int(re.search(r"ramulator\.dram_cycles\s+(\d+)", stats.read_text())[1]), turns


def main(build, ramulator):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sheet = (ROOT / "hwmodel/memory/sheets/ddr4-2400.toml").read_text()
        for key, value in GRADE.items():
            sheet, changed = re.subn(rf"^{key} = \d+", f"{key} = {value}", sheet, flags=re.M)
            assert changed == 1, key
        (folder / "memory.toml").write_text(sheet)
        (folder / "ddr4.cfg").write_text(CONFIGURATION)
        found, traces = {}, {"a picture of the cello": picture(build, folder), **made(random.Random(1))}
        print("| trace | requests | our cycles | Ramulator's | ours beside them | our turns to writes |\n|---|--:|--:|--:|--:|--:|")
        for trace, requests in traces.items():
            own, theirs, turns = found[trace] = cycles(build, ramulator, folder, requests)
            print(f"| {trace} | {len(requests):,} | {own:,} | {theirs:,} | {round(100 * (own / theirs - 1), 2) + 0.0:.2f} % | {turns:,} |", flush=True)
        print("\n| trace | our cycles a pair of turns | Ramulator's |\n|---|--:|--:|")
        own_reads, their_reads, _ = found["a stream of reads"]
        for trace in (name for name in traces if name.startswith("a reader")):
            own, theirs, turns = found[trace]
            print(f"| {trace} | {(own - own_reads) / turns:.1f} | {(theirs - their_reads) / (200000 / TURN):.1f} |")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
