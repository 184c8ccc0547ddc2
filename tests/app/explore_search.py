"""What `voxmelt explore` computes, once more: times and resources of a design, from the parts and coefficients
in its report. tests/app/explore_test.py compares the two."""
import collections
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


class Bus:
    """Reads pass in their order, and between them batches of writes. A refresh stops it."""
    def __init__(self, clocks, turn):
        d = DDR4
        self.burst, self.turn, self.back = clocks * d["beats"], clocks * turn, clocks * (d["cwl"] + d["wtr_s"])
        self.wrote = False
        self.every, self.stop = clocks * d["refi"], clocks * (d["rtp"] + d["rp"] + d["rfc"] + d["rcd"])
        self.free = self.waiting = self.reads = 0

    def after(self, begin, cycles):
        last = begin // self.every * self.every
        begin = max(begin, last + self.stop) if last else begin
        while begin + cycles > last + self.every:
            last += self.every
            cycles, begin = cycles - max(0, last - begin), last + self.stop
        return begin + cycles

    def serve(self, writes, turning):
        self.free = self.after(self.free, writes * self.burst + turning)
        self.waiting, self.reads = self.waiting - writes, 0

    def read(self, bursts, ask):
        if ask > self.free and self.waiting > 8:
            idle = ask - self.free
            writes = min(self.waiting, max(idle / self.burst, min(48, self.waiting - 8)))
            self.serve(writes, (self.turn - min(self.turn - self.back, idle)) * min(1, writes))
        self.free = max(self.free, ask)
        while bursts > 0:
            if self.waiting >= 48 and self.reads >= 48:
                self.serve(min(48, self.waiting - 8), self.turn)
            some = min(bursts, 48 - self.reads) if self.waiting >= 48 else bursts
            self.free = self.after(self.free, some * self.burst)
            self.reads, bursts = self.reads + some, bursts - some
        return self.free

    def hold(self, at):
        """The writer finds no room: at least a batch is written first. A way there and back is paid for 48 reads."""
        if self.waiting <= 192:
            return at
        self.serve(max(self.waiting - 192, min(48, self.waiting - 8)), self.turn * min(1, self.reads / 48))
        return max(at, self.free)


def when(marks, bursts):
    """The cycle in which so many bursts had been used. Marks are (bursts, cycle), the used up ones are dropped."""
    while len(marks) > 1 and marks[1][0] < bursts:
        marks.popleft()
    (b0, c0), (b1, c1) = marks[0], marks[min(1, len(marks) - 1)]
    return c0 if bursts <= b0 or b1 == b0 else c0 + (c1 - c0) * (bursts - b0) / (b1 - b0)


def by_columns(report, parts, content, hw, tiles, streams, fed, lag, interval):
    """The bus serves what is asked for, at most 128 bursts ahead, and the pipeline takes it when it has come."""
    d, (_, high, deep), tiled, coded = DDR4, report["grid"], len(tiles.read) > 1, hw["coded"]
    clocks = hw["clock_mhz"] / d["mhz"]
    plain = high * parts["lanes"] * parts["cell_bits"] / 512
    slot = ceil(high * (coded + parts["lanes"] * parts["cell_bits"]) / 512)
    columns, puts = [], []
    for tile, _ in streams:
        for z, block in itertools.product(range(deep), tiles.read[tile]):
            columns.append(content["coded_columns"][z * tiles.blocks + block] if coded else slot if tiled else plain)
            puts.append(columns[-1] if block in tiles.owned[tile] else 0)
    taken = interval * high
    behind = floor(lag / taken + .5)
    aparts = distances(report, tiles, lag / taken, slot) if tiled or coded else 2 * (lag / taken * plain,)
    state = sum(columns) * 512 / (sum(columns) * 512 + sum(fed))
    of_writes, of_reads = (state * sum(meeting(apart + more) for apart in aparts) / 2 + (1 - state) / d["banks"]
                           for more in (d["batch"], 0))
    turn = (d["rtw"] + d["wtr_s"] + d["cl"]
            + (d["rtp"] + d["rp"] + d["rcd"] - (d["cl"] + d["beats"] - d["cwl"]) - d["rtw"]) * of_writes
            + (d["wr"] + d["rp"] + d["rcd"] - d["wtr_s"]) * of_reads)
    bus, marks = Bus(clocks, turn), collections.deque([(0, 0)])
    opening = clocks * (d["rp"] + d["rcd"]) * min(1, slot / 512) if coded else 0

    def latency():
        """Replies come in order, so all wait for those right behind a write."""
        held = d["cwl"] + d["beats"] + d["wtr_s"] if bus.wrote else 0
        return 2.5 + opening + clocks * (d["cl"] + d["beats"] + d["interface"] + held)

    def room(column, bursts):
        """When the buffer has room for so many bursts more of a column, beside the begins of later ones."""
        return when(marks, asked + bursts + max(len(begun) - column - 1, 0) - 128)

    feeds, first = feed_bursts(parts, tiles, content, streams, deep, interval, high) if fed[0] else ([0] * len(columns), [])
    if fed[1]:
        add_feed(feeds, first, [high * parts["lanes"] / 512] * len(columns), 0)

    def fill(bursts):
        """Feeds fill their buffers side by side, each by so many."""
        some = [min(left, bursts) for left in first]
        first[:] = [left - one for left, one in zip(first, some)]
        return sum(some)

    def early():
        """When the begin of the next column may be asked for: 8 of them are under way."""
        return done[len(begun) - ahead] if len(begun) >= ahead else 0

    def begin(column):
        begun.append(bus.read(1, max(early(), room(column, 1))) + latency())

    done, begun, asked, written, last, ahead = [], [], 0, 0, 0, 8 if coded else 128
    for c in range(len(columns) + behind):
        reads = c < len(columns)
        own, begins = columns[c] if reads else 0, coded and reads
        before = done[c - ahead] if c >= ahead else 0
        if begins:
            while len(begun) <= c:
                begin(c)
            limit = max(begun[c], room(c, 1))
            while len(begun) < min(c + ahead, len(columns)) and early() < limit:
                begin(c)
        ready = 0
        while written + behind < c and done[written + behind] <= last:
            ready, written = ready + puts[written], written + 1
        gate, pieces = (last if not reads else begun[c] if coded else before), max(1, ceil(own / 16))
        for _ in range(pieces):
            ask = max(gate, room(c, 0))
            asked += own / pieces
            ask_last = max(gate, room(c, 0))
            bus.waiting += ready / pieces
            bus.wrote = bus.wrote or ready > 0
            passed = bus.read((own - begins) / pieces + (feeds[c] if c < len(feeds) else 0) / pieces
                              + fill(max(own / pieces, 1 / pieces)), ask)
            come = begun[c] if begins and own <= 1 else max(passed, ask_last) + latency() if reads else passed
            last = bus.hold(max(last + taken / pieces, come + (taken / max(1, own) if reads else 0)))
            if own:
                marks.append((marks[-1][0] + own / pieces, last))
        done.append(last)
    waiting = bus.waiting + sum(puts[written:])
    rest = bus.after(max(last, bus.free), (waiting - 192) * bus.burst) if waiting > 192 else last
    return floor(rest + lag - behind * taken + .5)


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
    content = content_of(report, parts)
    interval, tiled = 2 if hw["fifo_depth"] == 1 else 1, len(tiles.read) > 1
    window, lit = interval * len(streams) * parts["tokens"], 0
    for tile, steps in streams if parts["fed"] else ():
        of_tile = sum(sum(content["lit_columns"][block::tiles.blocks]) for block in tiles.read[tile])
        lit += steps * (of_tile if tiled else content["irradiance_bits"])
    fallen = len(streams) * parts["tokens"] * parts["lanes"] if content["falls"] else 0  # a bit for each cell
    lag, fed = cycles - window, lit + fallen
    return by_columns(report, parts, content, hw, tiles, streams, (lit, fallen), lag, interval)


def token_energy(report, parts, stage):
    """Picojoules of one token in a stage, by Horowitz: 0.1 for 32 bits added, 3.1 for 32 x 32 multiplied, and 10 for
    64 bits into 8 KiB of SRAM or out of it. Larger ones take as much more as the root of their size."""
    f, p, cost = report["family"], parts["lanes"], report["family"]["stages"][stage["name"]]
    added = p * (cost["lut"] + stage["dividers"] * f["divider"]["lut"])
    added += ceil(p / 8) * stage["random_blocks_per_8_lanes"] * f["random_block"]["lut"]
    factors = [cost["multipliers"][min(i, len(cost["multipliers"]) - 1)] for i in range(stage["multipliers"])
               ] if cost["multipliers"] else []
    products = p * sum(3.1 * a * b / 1024 for a, b in factors)
    moved = sum(2 * 10 / 64 * b["lanes"] * b["bits"] * (b["words"] * b["lanes"] * b["bits"] / 65536) ** .5
                for b in stage["model_buffers"])
    return added / 320 + products + moved


def operations(report, parts, hw):
    """Femtojoules of a cell-step, without the memory."""
    tiles, (across, high, deep) = Tiles(report, parts, hw), report["grid"]
    streams = [one for train in trains(report, parts, hw, tiles) for one in train]
    of_step = sum(token_energy(report, parts, stage) for stage in working(report, parts))
    # With the code, masks of 8 columns and one of the writer's, and a burst of each, are read and written.
    held = [(8, high), (1, high), (ceil(high / 512), 512)] if hw["coded"] else []
    coder = sum(2 * 10 / 64 * bits * (words * bits / 65536) ** .5 for words, bits in held)
    return 1000 * parts["tokens"] * sum(k * of_step + coder for _, k in streams) / (across * high * deep * report["steps"])


def pieces(width, of):
    return 1 if width <= of else 1 + ceil((width - of) / (of - 1))


def fixed_of(report, parts, hw):
    """Logic, products, registers and channels: (lut, ff, dsp, lutram, ports)."""
    f, p, t = report["family"], parts["lanes"], hw["cascade"]
    ports = 2 + (t if parts["fed"] else 0) + (1 if may_fall(parts) else 0)
    lut, ff, dsp, lutram = f["base"]["lut"] + ports * f["port"]["lut"], f["base"]["ff"] + ports * f["port"]["ff"], 0, 0
    widths = [(parts["cell_bits"], 1)]
    for stage in parts["stages"]:
        c, blocks = f["stages"][stage["name"]], stage["random_blocks_per_8_lanes"] * blocks_of(p)
        for name in ("lut", "ff"):
            synthesised = c["dsp"][0]
            lanes = p * c[name] * (1 + stage["multipliers"]) // (1 + synthesised) if synthesised else p * c[name]
            cost = lanes + p * stage["dividers"] * f["divider"][name] + blocks * f["random_block"][name] + f["control"][name]
            lut, ff = (lut + t * cost, ff) if name == "lut" else (lut, ff + t * cost)
        a, b = f["product"]
        products, dsps = c["dsp"]
        dsp += t * ceil(p * stage["multipliers"] * dsps / products) if products else 0
        for i in range(stage["multipliers"] if c["multipliers"] and not products else 0):
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


def blocks_of(lanes):
    """Blocks of 8 cells that one token of so many cells touches, wherever it begins."""
    return max(len({x // 8 for x in range(begin, begin + lanes)}) for begin in range(0, 8 * lanes, lanes))


def lutram_of(f, words, bits):
    return min(ceil(words / w) * ceil(bits / b) * luts + bits * ceil((ceil(words / w) - 1) / (f["mux_ways"] - 1))
               for b, w, luts in f["lutram_shapes"])


def parts_of(f, words, bits, shapes):
    """Words that lie behind others fill up what these leave, byte by byte. A choice between words weighs, too."""
    found = []
    for wide, deep in shapes:
        byte, rows_ = min(f["byte_bits"], wide), ceil(words / deep)
        parts = ceil(rows_ * ceil(bits / byte) / (wide // byte))
        found.append((parts * f["part_mux_bits"] + (rows_ - 1) * bits, parts))
    return min(found)[1]


def ways(f, words, bits, times_):
    found = []
    if words <= f["deepest_lutram"]:
        found.append((times_ * lutram_of(f, words, bits), 0, 0))
    for at, shapes in ((1, f["bram_shapes"]), (2, f["uram_shapes"])):
        if shapes:
            n = times_ * parts_of(f, words, bits, shapes)
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
