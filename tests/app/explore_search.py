"""What `voxmelt explore` computes, once more: times and resources of a design, from the parts and coefficients
in its report. tests/app/explore_test.py compares the two."""
import itertools
from math import ceil, floor, inf

# Of the memory's sheet (hwmodel/memory/sheets/ddr4-2400.toml), in its cycles.
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


def content_of(report, parts):
    return next(c for c in report["contents"] if c["lanes"] == parts["lanes"])


def may_fall(parts):
    """Tells if pieces may fall: then the software looks at the state before each step."""
    return any(s["name"] == "fall" for s in parts["stages"])


def working(report, parts):
    """The stages that work in a step. Whether pieces fall is as in the first one."""
    falls = content_of(report, parts)["falls"]
    return [s for s in parts["stages"] if falls or s["name"] != "fall"]


def trains(report, parts, hw, tiles):
    """The (tile, steps) of all streams of each train, and its steps."""
    done, n, every, high = 0, parts["tokens"], report["visibility_every"], report["grid"][1]
    interval = 2 if hw["fifo_depth"] == 1 else 1
    stages, alone = working(report, parts), may_fall(parts)
    follow = hw["overlap"] and all(s["lag"] < n for s in stages)
    back = tiles.shortest_return(n, high) - (high - 1 if hw["coded"] else 0)
    found = []
    while done < report["steps"]:
        found.append([])
        while True:
            step = report["first_step"] + done
            k = min(1 if alone else hw["cascade"], report["steps"] - done, every - step % every if every else inf)
            for tile in range(len(tiles.read)):
                if tile and not follow:
                    found.append([])
                found[-1].append((tile, k))
            done += k
            lags = sum(s["lag"] for s in stages)
            overlaps = follow and interval * back > interval * k * lags + hw["cascade"] * len(parts["stages"]) + 1
            if done == report["steps"] or alone or not overlaps or (every and (report["first_step"] + done) % every == 0):
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


def add_feed(fetched, first, used, delay):
    """A feed fetches as much as is used, less what it fetches at the begin."""
    first.append(min(sum(used), 128))
    left = sum(used) - first[-1]
    for at, bursts in enumerate(used):
        fetched[at + delay] += min(left, bursts)
        left -= min(left, bursts)


def feed_bursts(parts, tiles, content, streams, deep, interval, high):
    """Bursts that feeds of irradiance fetch in the time of each column, and of each those that it fetches at the begin."""
    lit, n = content["lit_columns"], parts["tokens"]
    waits = [1 + (interval * s["lag"] if s["lag"] < n else interval * (n - 1) + s["lag"] - n + 1) for s in parts["stages"]]
    before = 1 + sum(waits[:[s["name"] for s in parts["stages"]].index("exchange")])
    delays = [floor((t * sum(waits) + before) / (interval * high) + .5) for t in range(streams[0][1])]
    columns = [(z * tiles.blocks + block, steps) for tile, steps in streams
               for z in range(deep) for block in tiles.read[tile]]
    fetched, first = [0] * (len(columns) + delays[-1] + 1), []
    for t, delay in enumerate(delays):
        add_feed(fetched, first, [lit[at] / 512 if t < steps else 0 for at, steps in columns], delay)
    return fetched, first


def by_columns(report, parts, content, hw, tiles, streams, fed, lag, interval):
    """The bus serves column after column, the pipeline takes each when it has come. Irradiance is fed, and what falls."""
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
    state = sum(columns) * 512 / (sum(columns) * 512 + sum(fed))
    of_writes, of_reads = (state * sum(meeting(apart + more) for apart in aparts) / 2 + (1 - state) / d["banks"]
                           for more in (d["batch"], 0))
    turn = (d["rtw"] + d["wtr_s"] + d["cl"]
            + (d["rtp"] + d["rp"] + d["rcd"] - (d["cl"] + d["beats"] - d["cwl"]) - d["rtw"]) * of_writes
            + (d["wr"] + d["rp"] + d["rcd"] - d["wtr_s"]) * of_reads)
    read, write = ratio * d["beats"] / run, ratio * (d["beats"] + turn / d["batch"]) / run
    latency = ratio * (d["rcd"] + d["cl"] + d["beats"] + d["interface"]) * (1 + hw["coded"])
    feeds, first = feed_bursts(parts, tiles, content, streams, deep, interval, high) if fed[0] else ([0] * len(columns), [])
    if fed[1]:
        add_feed(feeds, first, [high * parts["lanes"] / 512] * len(columns), 0)

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
    n, stages = parts["tokens"], working(report, parts)
    interval = 2 if hw["fifo_depth"] == 1 else 1
    for streams in trains(report, parts, hw, tiles):
        if tuple(streams) not in known:
            wait = sum(interval * s["lag"] if s["lag"] < n else interval * (n - 1) + s["lag"] - n + 1 for s in stages)
            cycles = interval * (len(streams) * n - 1) + streams[0][1] * wait + hw["cascade"] * len(parts["stages"]) + 2
            slow = cycles if report["memory"] == "none" else on_memory(report, parts, hw, tiles, streams, cycles)
            known[tuple(streams)] = cycles, slow
        sums = [a + b for a, b in zip(sums, known[tuple(streams)])]
    return sums


def on_memory(report, parts, hw, tiles, streams, cycles):
    """Of a train that takes so many cycles without waiting."""
    d, (_, high, deep) = DDR4, report["grid"]
    content = content_of(report, parts)
    interval, tiled = 2 if hw["fifo_depth"] == 1 else 1, len(tiles.read) > 1
    window, lit = interval * len(streams) * parts["tokens"], 0
    for tile, steps in streams if parts["fed"] else ():
        of_tile = sum(sum(content["lit_columns"][block::tiles.blocks]) for block in tiles.read[tile])
        lit += steps * (of_tile if tiled else content["irradiance_bits"])
    fallen = len(streams) * parts["tokens"] * parts["lanes"] if content["falls"] else 0  # a bit for each cell
    lag, fed = cycles - window, lit + fallen
    if hw["coded"] or lit:
        return by_columns(report, parts, content, hw, tiles, streams, (lit, fallen), lag, interval)
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
    ports = 2 + (t if parts["fed"] else 0) + (1 if may_fall(parts) else 0)
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
    feeds = ([(16, t)] if parts["fed"] else []) + ([(1, 1)] if may_fall(parts) else [])
    for bits, times_ in widths + feeds:
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
