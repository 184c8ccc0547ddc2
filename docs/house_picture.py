"""What draw_house.py knows, as an SVG: rooms on floors, their boxes, and arrows that run in the gaps."""
from html import escape

WIDTH, MARGIN = 900, 40  # of the picture, and left and right of the rooms; an arrow may run in the margin
GAP, STOREY = 26, 46  # between rooms of a floor, and between floors
PAD, HEAD, LINE = 12, 46, 15  # inside a room, its title, a line of small text
ROOF = 92
BADGE = 84  # what the number of lines takes in a title
GLYPH = 0.565  # mean width of a letter, in sizes

STYLE = """
text { font-family: -apple-system, "Segoe UI", "Noto Sans", "DejaVu Sans", Helvetica, Arial, sans-serif; fill: #24292f; }
.page { fill: #ffffff; } .walls { fill: #f6f8fa; stroke: #afb8c1; stroke-width: 1.5; }
.box { fill: #ffffff; fill-opacity: 0.75; } .title { font-size: 15px; font-weight: 600; } .name { font-size: 12.5px; font-weight: 600; }
.what, .count { font-size: 12px; fill: #57606a; } .house { font-size: 25px; font-weight: 600; }
.app { fill: #ddeaf8; stroke: #2f6fb3; } .bench, .measure { fill: #e9ebee; stroke: #6b7683; } .report { fill: #f3efd2; stroke: #8a7a1c; } .door { fill: #e3e4fa; stroke: #5d5bb8; }
.accuracy { fill: #fbe3e6; stroke: #b5435a; }
.hwmodel { fill: #fbead0; stroke: #b3701c; } .render { fill: #f2e2f3; stroke: #95489c; } .kernel { fill: #d9f0e6; stroke: #1a7f64; }
.arrow { fill: none; stroke-width: 1.9; } .tip { stroke: none; }
.tip.app { fill: #2f6fb3; } .tip.bench, .tip.measure { fill: #6b7683; } .tip.report { fill: #8a7a1c; } .tip.door { fill: #5d5bb8; } .tip.accuracy { fill: #b5435a; }
.tip.hwmodel { fill: #b3701c; } .tip.render { fill: #95489c; } .tip.kernel { fill: #1a7f64; }
"""
DARK = """
text { fill: #e6edf3; } .page { fill: #0d1117; } .walls { fill: #161b22; stroke: #484f58; }
.box { fill: #0d1117; fill-opacity: 0.55; } .what, .count { fill: #a9b4c0; }
.app { fill: #152a42; stroke: #6aa9ee; } .bench, .measure { fill: #23282f; stroke: #8b949e; } .report { fill: #322d0e; stroke: #d3c25a; } .door { fill: #22224a; stroke: #9a98f0; }
.accuracy { fill: #3a1a22; stroke: #ee8499; }
.hwmodel { fill: #38270f; stroke: #e0a04a; } .render { fill: #331d36; stroke: #cf86d6; } .kernel { fill: #10332a; stroke: #4fc3a1; }
.tip.app { fill: #6aa9ee; } .tip.bench, .tip.measure { fill: #8b949e; } .tip.report { fill: #d3c25a; } .tip.door { fill: #9a98f0; } .tip.accuracy { fill: #ee8499; }
.tip.hwmodel { fill: #e0a04a; } .tip.render { fill: #cf86d6; } .tip.kernel { fill: #4fc3a1; }
"""


def wrapped(text, width, size=12):
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and len(longer) * size * GLYPH > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def written(x, y, style, text, more=""):
    return f'<text x="{x:g}" y="{y:g}" class="{style}"{more}>{escape(text.replace("`", ""))}</text>\n'


def thousands(number):
    return f"{number:,}".replace(",", " ")


def counted(right, y, folder, lines):
    more = f' text-anchor="end" data-folder="{folder}" data-lines="{lines}"'
    return written(right, y, "count", thousands(lines), more)


class Room:
    """A card with a title, and below it a grid of boxes."""

    def __init__(self, name, x, width, purposes, folders, lines):
        self.name, self.x, self.width, self.purposes, self.lines = name, x, width, purposes, lines
        self.middle = x + width / 2
        self.wing = name.split("/")[0]
        own = [box for box in lines if box in folders.get(name, ()) or box.rpartition("/")[0] == name]
        self.boxes = sorted(own, key=list(purposes).index)
        self.prefix = 0 if name in folders else len(name) + 1
        columns = max(1, int((width - PAD) / 165))
        rows = -(-len(self.boxes) // columns)
        columns = -(-len(self.boxes) // rows) if rows else 1
        self.purpose = wrapped(purposes[name], width - 2 * PAD)
        self.rows = [self.boxes[n:n + columns] for n in range(0, len(self.boxes), columns)]
        self.heights = [30 + LINE * max(len(self.text(box, row)) for box in row) for row in self.rows]
        self.head = HEAD + LINE * (len(self.purpose) - 1)
        self.height = self.head + sum(self.heights) + PAD * len(self.rows) + 8

    def cell(self, row):
        return (self.width - PAD * (len(row) + 1)) / len(row)

    def text(self, box, row):
        return wrapped(self.purposes[box], self.cell(row) - 16)

    def svg(self):
        out = f'<rect x="{self.x:g}" y="{self.y:g}" width="{self.width:g}" height="{self.height:g}" rx="8" class="{self.wing}"/>\n'
        out += written(self.x + PAD, self.y + 22, "title", self.name)
        out += counted(self.x + self.width - PAD, self.y + 22, self.name, self.lines[self.name])
        for number, line in enumerate(self.purpose):
            out += written(self.x + PAD, self.y + 39 + number * LINE, "what", line)
        top = self.y + self.head + 6
        for row, height in zip(self.rows, self.heights):
            cell = self.cell(row)
            for column, box in enumerate(row):
                x = self.x + PAD + column * (cell + PAD)
                out += f'<rect x="{x:g}" y="{top:g}" width="{cell:g}" height="{height:g}" rx="5" class="box"/>\n'
                out += written(x + 8, top + 18, "name", box[self.prefix:])
                out += counted(x + cell - 8, top + 18, box, self.lines[box])
                for number, line in enumerate(self.text(box, row)):
                    out += written(x + 8, top + 35 + number * LINE, "what", line)
            top += height + PAD
        return out


def spread(wishes, low, high, apart=22):
    """Places in [low, high] near the wishes, in their order, `apart` from each other."""
    places = []
    for wish in wishes:
        places.append(max(wish, low, places[-1] + apart if places else low))
    for number in range(len(places) - 1, -1, -1):
        limit = places[number + 1] - apart if number + 1 < len(places) else high
        places[number] = min(places[number], limit)
    return places


class Arrow:
    """From the bottom of one room to the top of another; past a floor between, through a gap beside its rooms."""

    def __init__(self, one, other, floors_between):
        self.one, self.other, self.gaps = one, other, []
        for floor in floors_between:
            gaps = [room.x + room.width + GAP / 2 for room in floor[:-1]] + [MARGIN * 0.6, WIDTH - MARGIN * 0.6]
            x = min(gaps, key=lambda gap: abs(gap - one.middle) + abs(gap - other.middle))
            self.gaps.append((x, floor[0].y - 4, floor[0].y + floor[0].height + 4))
        shared = max(one.x, other.x) + min(one.x + one.width, other.x + other.width)
        self.start = self.gaps[0][0] if self.gaps else shared / 2
        self.end = self.gaps[-1][0] if self.gaps else shared / 2

    def svg(self):
        stops = [(self.start, self.one.y + self.one.height)]
        for x, top, bottom in self.gaps:
            stops += [(x, top), (x, bottom)]
        stops.append((self.end, self.other.y - 9))
        path = f"M{stops[0][0]:g} {stops[0][1]:g}"
        for (x, y), (to_x, to_y) in zip(stops, stops[1:]):
            bend = (to_y - y) * 0.6
            path += f" V{to_y:g}" if x == to_x else f" C{x:g} {y + bend:g} {to_x:g} {to_y - bend:g} {to_x:g} {to_y:g}"
        return stroked(self.one, path, [(self.end - 5, self.other.y - 10), (self.end + 5, self.other.y - 10), (self.end, self.other.y - 1)])


class Step:
    """Between two neighbours on one floor."""

    def __init__(self, one, other):
        self.one, self.other = one, other

    def svg(self):
        way = 1 if self.other.x > self.one.x else -1
        start = self.one.x + self.one.width if way > 0 else self.one.x
        end, y = (self.other.x if way > 0 else self.other.x + self.other.width), self.one.y + self.one.height / 2
        return stroked(self.one, f"M{start:g} {y:g} H{end - 9 * way:g}",
                       [(end - 10 * way, y - 5), (end - 10 * way, y + 5), (end - way, y)])


def stroked(room, path, tip):
    corners = " ".join(f"{x:g},{y:g}" for x, y in tip)
    return (f'<path d="{path}" class="arrow {room.wing}" style="fill:none"/>\n'
            f'<polygon points="{corners}" class="tip {room.wing}"/>\n')


def keep_apart(arrows, rooms):
    """Arrows leave and reach a room in order and apart."""
    for room in rooms:
        low, high = room.x + 24, room.x + room.width - 24
        for side, place in (("one", "start"), ("other", "end")):
            mine = sorted((a for a in arrows if getattr(a, side) is room),
                          key=lambda a: (getattr(a, place), a.one.middle + a.other.middle))
            for arrow, x in zip(mine, spread([getattr(a, place) for a in mine], low, high)):
                setattr(arrow, place, x)


def picture(floors, purposes, folders, lines, needed):
    storeys, y = [], ROOF + 18
    for floor in ([(name, share) for name, share in floor if name in lines] for floor in floors):
        width = WIDTH - 2 * MARGIN - GAP * (len(floor) - 1)
        shares, x, storey = sum(share for _, share in floor), MARGIN, []
        for name, share in floor:
            room = Room(name, x, width * share / shares, purposes, folders, lines)
            storey.append(room)
            x += room.width + GAP
        for room in storey:
            room.y = y
            room.height = max(other.height for other in storey)
        storeys.append(storey)
        y += storey[0].height + STOREY
    ground = y - STOREY + 30
    rooms = {room.name: room for storey in storeys for room in storey}
    level = {room.name: number for number, storey in enumerate(storeys) for room in storey}
    arrows, steps = [], []
    for one, other in needed:
        if level[one] == level[other]:
            steps.append(Step(rooms[one], rooms[other]))
        else:
            arrows.append(Arrow(rooms[one], rooms[other], storeys[level[one] + 1:level[other]]))
    keep_apart(arrows, list(rooms.values()))
    total = sum(lines[name] for name in rooms)
    out = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {ground + 44:g}" width="{WIDTH}" height="{ground + 44:g}" '
           'role="img" aria-label="The house: folders, their sizes, and which includes which">\n'
           f"<style>{STYLE}@media (prefers-color-scheme: dark) {{{DARK}}}\n</style>\n"
           f'<rect width="{WIDTH}" height="{ground + 44:g}" class="page"/>\n'
           f'<path d="M8 {ground:g} V{ROOF:g} L{WIDTH / 2:g} 8 L{WIDTH - 8} {ROOF:g} V{ground:g} Z" class="walls"/>\n'
           f'<text x="{WIDTH / 2:g}" y="{ROOF - 28:g}" text-anchor="middle" class="house">voxmelt</text>\n'
           f'<text x="{WIDTH / 2:g}" y="{ROOF - 6:g}" text-anchor="middle" class="what">{thousands(total)} lines of C++</text>\n')
    out += "".join(room.svg() for room in rooms.values())
    out += "".join(arrow.svg() for arrow in arrows + steps)
    out += written(MARGIN, ground + 22, "what", "An arrow points from what includes to what is included; one that follows from two others is left out. Numbers are lines of code.")
    return out + "</svg>\n"
