#!/usr/bin/env python3
"""The DRAM model beside DRAMsim3 (github.com/umd-memsys/DRAMsim3), on traces that both run as fast as they can.

  beside_dramsim3.py BUILD DRAMSIM3MAIN [MEMORY...]

DRAMsim3 is built as its page says. Its configuration is written from our sheet, and so has the same numbers. Prints the
tables of docs/hardware/memory.md, for ddr4-2400 and hbm2 if no memory is named.
"""
import json
import random
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
EPOCH = 200  # cycles: DRAMsim3 does not say when it was done, but what it did in each epoch
FAR, TWO_BANKS = 1 << 27, 1 << 16  # another row of the same banks; the bank after the next
BATCH = 48  # requests of a drain: ours
BEHIND = 128  # reads that DRAMsim3 sees, eight for each bank
REQUESTS = 100000
PROTOCOL = {"ddr4-2400": "DDR4", "hbm2": "HBM", "lpddr4-3200": "LPDDR4"}


def streams(*bases):
    return [(base + 64 * i, kind) for i in range(REQUESTS // len(bases)) for base, kind in bases]


def made(rng, space):
    place = lambda: rng.randrange(space // 64) * 64
    mixed = lambda share: [(place(), "RW"[rng.random() < share]) for _ in range(REQUESTS)]
    return {
        "a stream of reads": streams((0, "R")),
        "a stream of writes": streams((0, "W")),
        "two readers, other banks": streams((0, "R"), (FAR + TWO_BANKS, "R")),
        "two readers, same banks": streams((0, "R"), (FAR, "R")),
        "reads, every fourth burst": [(256 * i, "R") for i in range(REQUESTS)],
        "reads anywhere": mixed(0),
        "writes anywhere": mixed(1),
        "anywhere, 10 % writes": mixed(0.1),
        "anywhere, 30 % writes": mixed(0.3),
        "a reader and a writer, other banks": streams((0, "R"), (FAR + TWO_BANKS, "W")),
        "a reader and a writer, same banks": streams((0, "R"), (FAR, "W")),
    }


def verified(build, folder, memory):
    """What the pipeline asks for in two time steps of a melting cello."""
    trace = folder / "pipeline.trace"
    subprocess.run([build / "app/voxmelt", "verify", "cello", "--from", "200", "--steps", "2", "--quiet", "--set", "pieces.fall=false",
                    "--set", f"hw.memory={memory}", "--set", f"hw.memory_trace={trace}"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return [(int(address, 16), kind) for address, kind in map(str.split, trace.read_text().splitlines())][:REQUESTS]


def configuration(memory, m, power):
    one = power["rail"][0]
    size = m["width_bits"] // 8 * m["columns"] * m["rows"] * m["groups"] * m["banks"] * m["ranks"] >> 20
    return f"""[dram_structure]
protocol = {PROTOCOL[memory]}
bankgroups = {m["groups"]}
banks_per_group = {m["banks"]}
rows = {m["rows"]}
columns = {m["columns"] // (2 if memory == "hbm2" else 1)}
device_width = {m["width_bits"] // power["parts"]}
BL = {m["transfers"]}
num_dies = 4
[timing]
tCK = {1000 / m["mhz"]}
CL = {m["cl"] + m["read_more"]}
CWL = {m["cwl"] + m["write_more"]}
tRCD = {m["rcd"]}
tRCDRD = {m["rcd"]}
tRCDWR = {m["rcd"]}
tRP = {m["rp"]}
tRAS = {m["ras"]}
tRFC = {m["rfc"]}
tREFI = {m["refi"]}
tRRD_S = {m["rrd_s"]}
tRRD_L = {m["rrd_l"]}
tWTR_S = {m["wtr_s"]}
tWTR_L = {m["wtr_l"]}
tFAW = {m["faw"]}
tWR = {m["wr"]}
tRTP = {m["rtp"]}
tRTP_L = {m["rtp"]}
tRTP_S = {m["rtp"]}
tCCD_S = {m["ccd_s"]}
tCCD_L = {m["ccd_l"]}
tPPD = {m.get("ppd", 0)}
tRTRS = {m["read_to_write"]}
[power]
VDD = {one["volts"]}
IDD0 = {one["idd0"]}
IDD2N = {one["idd2n"]}
IDD3N = {one["idd3n"]}
IDD4R = {one["idd4r"]}
IDD4W = {one["idd4w"]}
IDD5AB = {one["idd5"]}
[system]
channel_size = {size}
channels = 1
bus_width = {m["width_bits"]}
address_mapping = robabgracoch
queue_structure = PER_BANK
row_buf_policy = OPEN_PAGE
cmd_queue_size = 8
trans_queue_size = {BATCH * 64 // (m["width_bits"] // 8 * m["transfers"])}
[other]
epoch_period = {EPOCH}
output_level = 1
"""


class Result:
    def __init__(self, cycles, turns, opened, energy):
        self.cycles, self.turns, self.opened, self.energy = cycles, turns, opened, energy


def ours(build, folder, *reads):
    said = subprocess.run([build / "tests/hwmodel/replay_trace", folder / "memory.toml", folder / "ours.trace", folder / "theirs.trace", *reads],
                          check=True, capture_output=True, text=True).stdout
    found = re.search(r"(\d+) cycles, (\d+) turns.*; (\d+) rows opened, ([\d.]+) nJ", said)
    return Result(int(found[1]), int(found[2]), int(found[3]), float(found[4]))


def theirs(dramsim, folder, m, limit):
    """DRAMsim3 takes bursts: a request of 64 bytes is one or two of them."""
    burst, lines = m["width_bits"] // 8 * m["transfers"], []
    for line in (folder / "theirs.trace").read_text().splitlines():
        address, kind = line.split()
        word = {"R": "READ", "W": "WRITE"}[kind]
        lines += [f"0x{int(address, 16) + at:x} {word} 0" for at in range(0, 64, burst)]
    (folder / "bursts.trace").write_text("\n".join(lines) + "\n")
    subprocess.run([dramsim, folder / "memory.ini", "-c", str(limit), "-t", folder / "bursts.trace", "-o", folder], check=True, capture_output=True)
    epochs = json.loads((folder / "dramsim3epoch.json").read_text())
    last = max(i for i, epoch in enumerate(epochs) if epoch["num_read_cmds"] + epoch["num_write_cmds"])
    done, sums = epochs[:last + 1], lambda key: sum(epoch[key] for epoch in epochs[:last + 1])
    energy = sum(sums(key) for key in ("act_energy", "read_energy", "write_energy", "ref_energy"))
    energy += sum(epoch[key]["0"] for epoch in done for key in ("act_stb_energy", "pre_stb_energy"))
    bursts = sums("num_read_cmds") + sums("num_write_cmds")
    assert bursts >= 0.999 * len(lines), f"{bursts} of {len(lines)} bursts within {limit} cycles"
    return Result(EPOCH * len(done), None, sums("num_act_cmds"), energy / m["mhz"])  # volts, mA and cycles to nJ


def beside(build, dramsim, memory):
    sheet = (ROOT / f"hwmodel/memory/sheets/{memory}.toml").read_text()
    sheet = re.sub(r"^channels = \d+", "channels = 1", sheet, flags=re.M)
    numbers = tomllib.loads(sheet)
    m, power = numbers["memory"], numbers["power"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "memory.toml").write_text(sheet)
        (folder / "memory.ini").write_text(configuration(memory, m, power))
        traces = {**made(random.Random(1), 1 << 28), "the pipeline, a melting cello": verified(build, folder, memory)}
        print(f"\n`{memory}`\n\n| trace | requests | our cycles | DRAMsim3's | ours beside them | ours with {BEHIND} reads in sight | nJ a request, ours | DRAMsim3's |")
        print("|---|--:|--:|--:|--:|--:|--:|--:|")
        for trace, requests in traces.items():
            (folder / "ours.trace").write_text("".join(f"0x{address:08x} {kind}\n" for address, kind in requests))
            own, deep = ours(build, folder), ours(build, folder, str(BEHIND))
            other = theirs(dramsim, folder, m, 2 * own.cycles)
            print(f"| {trace} | {len(requests):,} | {own.cycles:,} | {other.cycles:,} | {100 * (own.cycles / other.cycles - 1):+.2f} % "
                  f"| {100 * (deep.cycles / other.cycles - 1):+.2f} % | {own.energy / len(requests):.2f} | {other.energy / len(requests):.2f} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    for memory in sys.argv[3:] or ("ddr4-2400", "hbm2"):
        beside(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), memory)
