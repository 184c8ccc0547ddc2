"""All numbers of one pixel, as docs/picture*.md define them: a second way, which knows no code of ours.

It is plain and slow. It knows boxes of solid and liquid without filter, ground, obstacles or glow, and a ray that meets matter.
"""
import math
from itertools import product

AIR = -32640


def fixed(value, bits):
    return math.floor(value * 2 ** bits + 0.5)


def rounded(a, n):
    return (a + (1 << (n - 1))) >> n


def clamp(value, low, high):
    return max(low, min(value, high))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def times(a, b):
    return rounded(a * b, 12)


def mixed(a, b, w):
    return [mixed(p, q, w) for p, q in zip(a, b)] if isinstance(a, list) else a + times(b - a, w)


def smooth(low, high, v):
    t = clamp((4096 * (v - low)) // (high - low), 0, 4096)
    return (t * t * (12288 - 2 * t)) >> 24


def blended(a, b, w):
    return (a * (256 - w) + b * w + 128) >> 8


def cosine(a, b):
    return dot(a, b) >> 14


def whole(b):
    return b + (b >> 7)


def sine_cosine(a):
    """docs/picture/definition.md 2"""
    quarter = a // 5898240
    x = rounded((a - 5898240 * quarter) * 1228166276394, 32)
    t, s, c = 1 << 30, 0, 1 << 30
    for n in range(1, 18):
        t = ((t * x) >> 30) // n
        s += {1: t, 3: -t}.get(n % 4, 0)
        c += {0: t, 2: -t}.get(n % 4, 0)
    return [(s, c), (c, -s), (-s, -c), (-c, s)][quarter % 4]


def root_entry(i):
    return (math.isqrt((1 << 39) // i) + 1) >> 1


def place(p):
    """Cell and weight of a position along an axis: docs/picture/definition.md 6"""
    s = p - (1 << 19) + (1 << 11)
    return s >> 20, (s >> 12) % 256


class Pixel:
    def __init__(self, scene, x, y):
        self.scene, self.x, self.y, self.cells = scene, x, y, scene["grid"]["size"]
        self.rows, self.brick = [], None  # rows: (stage, name, numbers)

    def tell(self, stage, name, *numbers):
        flat = []
        for number in numbers:
            flat += number if isinstance(number, (list, tuple)) else [number]
        self.rows.append((stage, name, flat))

    def all_rows(self):
        look, self.sample_row = self.scene["look"], []
        assert look["smooth"] == look["smooth_solid"] == 0 and not look.get("glow") and "inert" not in self.scene
        self.make_field()
        self.view()
        self.materials()
        self.light_volume()
        self.tell("picture", "cells of light", self.count)
        self.tell("picture", "s", self.s)
        self.ray()
        self.crossing()
        self.surface()
        return self.rows

    def at(self, table, cell, beside):
        inside = all(0 <= c < n for c, n in zip(cell, self.cells))
        return table[cell] if inside else beside

    # docs/picture/field.md 2 and 6, and docs/picture/definition.md 6
    def make_field(self):
        self.solid, self.liquid = {}, {}
        for cell in product(*map(range, self.cells)):
            inside = lambda shape: all(abs(c + 0.5 - a) < s / 2 for c, a, s in zip(cell, shape["at"], shape["size"]))
            is_solid = any(map(inside, self.scene["solid"]))
            self.solid[cell] = 65280 if is_solid else 0
            self.liquid[cell] = 65280 if not is_solid and any(map(inside, self.scene["liquid"])) else 0
        self.intensity = {c: self.solid[c] + self.liquid[c] for c in self.solid}
        for axis in (2, 1, 0):  # of the channels of matter: one pass is the least
            self.solid, self.liquid = (self.along(of, axis, lambda a, b, c: (a + 2 * b + c + 2) >> 2)
                                       for of in (self.solid, self.liquid))
        table = self.intensity
        for axis in range(3):
            table = self.along(table, axis, lambda a, b, c: (43 * a + 170 * b + 43 * c + 128) >> 8)
        self.levels = {c: table[c] - 32640 for c in table}

    def along(self, table, axis, new):
        """Each cell with its neighbours along an axis; the cells at the ends repeat themselves."""
        def near(cell, by):
            moved = list(cell)
            moved[axis] = clamp(cell[axis] + by, 0, self.cells[axis] - 1)
            return table[tuple(moved)]
        return {c: new(near(c, -1), table[c], near(c, 1)) for c in table}

    def unit(self, g, of_any_length=False):
        """docs/picture/definition.md 8"""
        bits = max(map(abs, g)).bit_length()
        if of_any_length and bits > 15:
            g = [c >> (bits - 14) for c in g]
        self.tell("unit", "vector", g)
        g = [c << (15 - max(map(abs, g)).bit_length()) for c in g]
        q = dot(g, g)
        e = 1 if q < 1 << 30 else 0
        m = q * 4 ** e
        i = m >> 23
        r = root_entry(i) - rounded((root_entry(i) - root_entry(i + 1)) * (m % (1 << 23)), 23)
        of = [rounded(c * r * 2 ** e, 16) for c in g]
        for name, numbers in (("g", g), ("q", q), ("e", e), ("m", m), ("i", i), ("R", [root_entry(i), root_entry(i + 1)]),
                              ("r", r), ("unit", of)):
            self.tell("unit", name, numbers)
        return of

    def silently(self, function, *arguments):
        rows = list(self.rows)
        result = function(*arguments)
        self.rows = rows
        return result

    # docs/picture/definition.md 3
    def view(self):
        camera, tell = self.scene["camera"], lambda name, numbers: self.tell("picture", name, numbers)
        (sa, ca), (se, ce), (sf, cf) = (sine_cosine(fixed(v, 16)) for v in (
            camera["azimuth"], camera["elevation"], camera["field_of_view"] / 2))
        by = lambda a, b: rounded(a * b, 30)
        back = [by(sa, ce), se, by(ca, ce)]
        forward = [-c for c in back]
        right, up = [ca, 0, -sa], [-by(sa, se), ce, -by(ca, se)]
        tangent = ((1 << 30) * sf) // cf
        eye = [fixed(t, 20) + ((b * fixed(camera["distance"], 12)) >> 22) for t, b in zip(camera["target"], back)]
        wide, high = [(c * tangent) >> 30 for c in right], [(c * tangent) >> 30 for c in up]
        half = 1 << 19
        depths = [dot([(c - e) >> 16 for c, e in zip(corner, eye)], forward) >> 30
                  for corner in product(*[(-half, (n << 20) + half) for n in self.cells])]
        near = max(0, min(depths) - 3)
        self.eye, self.forward, self.wide, self.high, self.near = eye, forward, wide, high, near
        self.near_wide = [(c * near) // (512 * camera["height"]) for c in wide]
        self.near_high = [(c * near) // (512 * camera["height"]) for c in high]
        self.e = 2 - min(2, tangent * near // ((15 << 25) * camera["height"]))  # docs/picture/definition.md 10
        for name, numbers in (("eye", eye), ("forward", forward), ("right", right), ("up", up), ("wide", wide), ("high", high),
                              ("near", near), ("near_wide", self.near_wide), ("near_high", self.near_high), ("e", self.e)):
            tell(name, numbers)

    # docs/picture/light.md 1 and 2
    def materials(self):
        look, light, tell = self.scene["look"], self.scene["light"], lambda name, numbers: self.tell("picture", name, numbers)
        color = {name: [fixed(c, 12) for c in look[name]] for name in ("solid", "liquid", "ground")}
        specular, metallic, ambient = (fixed(v, 12) for v in (look["specular"], look["metallic"], light["ambient"]))
        power = max(math.frexp(abs(c))[1] for c in light["direction"] if abs(c) == max(map(abs, light["direction"])))
        self.to_light = self.silently(self.unit, [fixed(c, 24 - power) for c in light["direction"]], True)
        self.to_strip = self.silently(self.unit, [-self.to_light[0], 5734, -self.to_light[2]], True)
        self.lamp = [times(c, times(4915, 4096 - ambient)) for c in (4342, 4096, 3768)]
        self.from_below = [times(times(c, 3686), ambient) for c in color["ground"]]
        self.from_above = [times(c, ambient) for c in (3850, 4096, 4424)]

        def material(of, shine, metal):
            d = times(shine, 328)
            return {"diffuse": [times(c, 4096 - times(metal, 3482)) for c in of], "mirror": mixed([d] * 3, of, metal),
                    "highlight": [times(times(c, l), shine) for c, l in zip(mixed([4096] * 3, of, metal), self.lamp)],
                    "gloss": times(mixed(times(shine, 4915), 4096, metal), 2867)}
        self.material = {"solid": material(color["solid"], times(specular, 2867), metallic),
                         "liquid": material(color["liquid"], specular, metallic),
                         "obstacle": material(mixed(color["ground"], [4096] * 3, 492), 123, 0)}
        for name in ("to_light", "to_strip", "lamp", "from_below", "from_above"):
            tell(name, getattr(self, name))
        for name, of in self.material.items():
            for part, numbers in of.items():
                tell(f"{name} {part}", numbers)
        self.shininess = max(1, fixed(look["shininess"], 0))
        self.blur = clamp(24576 // (self.shininess + 6), 205, 4096)
        self.ground = color["ground"]
        self.low, self.lamp_high = 3523 - times(1229, self.blur), 3809 + times(287, self.blur)
        self.strip = 3277 - times(1229, self.blur)
        tell("lamp low", self.low), tell("lamp high", self.lamp_high), tell("strip low", self.strip)

    def highlight(self, c):
        def entry(i):
            x, result = 32 * min(i, 1024), 1 << 15
            for bit in bin(self.shininess)[2:]:
                result = rounded(result * result, 15)
                result = rounded(result * x, 15) if bit == "1" else result
            return result >> 3
        i = c >> 4
        return entry(i) + (((entry(i + 1) - entry(i)) * (c % 16)) >> 4)

    def surroundings(self, i):
        h, edge = 4 * (i - 1024), times(1229, self.blur)
        sky = mixed([3768, 3850, 3973], [901, 1065, 1352], smooth(-times(819, self.blur), 3072 + times(1229, self.blur), h))
        below = mixed([times(c, 3072) for c in self.ground], [times(c, 1024) for c in self.ground], smooth(0, 2867, -h))
        seen = mixed(below, sky, smooth(-246 - edge, 246 + edge, h))
        return [clamp((c * m + 2048) >> 12, 0, m) * k for c, m, k in zip(seen, (2047, 2047, 1023), (2, 2, 4))]

    # docs/picture/light.md 4 and 5
    def light_volume(self):
        cells = self.cells[0] * self.cells[1] * self.cells[2]
        self.s = next(s for s in range(1, 30) if cells <= 1 << (19 + 3 * s))
        self.count = [(n + (1 << self.s) - 1) >> self.s for n in self.cells]
        sums = dict.fromkeys(product(*map(range, self.count)), 0)
        for cell, value in self.intensity.items():
            sums[tuple(c >> self.s for c in cell)] += value
        self.loss = {c: clamp(3 * ((v >> (3 * self.s + 8)) - 12) // 2, 0, 256) for c, v in sums.items()}
        self.light = {c: [0] * 13 for c in sums}
        self.sweep_lamp()
        for side in range(6):
            self.sweep_open(side)

    def slices(self, axis, from_high):
        """How a sweep goes: the slices' numbers, and cell(slice, u, v)."""
        u, v = (a for a in range(3) if a != axis)

        def cell(s, a, b):
            of = [0, 0, 0]
            of[axis] = self.count[axis] - 1 - s if from_high else s
            of[u], of[v] = a, b
            return tuple(of)
        return self.count[axis], self.count[u], self.count[v], u, v, cell

    def sweep_lamp(self):
        d = self.to_light
        axis = next(a for a in (1, 0, 2) if abs(d[a]) == max(map(abs, d)))
        n, nu, nv, u_axis, v_axis, cell = self.slices(axis, d[axis] > 0)
        slopes = [((1 << 14) * d[a]) // abs(d[axis]) for a in (u_axis, v_axis)]
        ways = lambda s: [((s * slope) >> 6) for slope in slopes]
        last = [way >> 8 for way in ways(n)]
        kept = [range(min(0, c) - 1, m + max(0, c) + 3) for c, m in zip(last, (nu, nv))]
        rays = {key: 255 for key in product(*kept)}
        for s in range(n):
            (cu, pu), (cv, pv) = ((way >> 8, way % 256) for way in ways(s))
            ray = lambda a, b: rays.get((a, b), 255)
            loss = lambda a, b: self.loss.get(cell(s, a, b), 0) if 0 <= a < nu and 0 <= b < nv else 0
            for a, b in product(range(nu), range(nv)):
                self.light[cell(s, a, b)][0] = blended(blended(ray(a + cu, b + cv), ray(a + cu + 1, b + cv), pu),
                                                       blended(ray(a + cu, b + cv + 1), ray(a + cu + 1, b + cv + 1), pu), pv)
            lost = lambda a, b: blended(blended(loss(a - cu, b - cv), loss(a - cu - 1, b - cv), pu),
                                        blended(loss(a - cu, b - cv - 1), loss(a - cu - 1, b - cv - 1), pu), pv)
            rays = {(a, b): (r * (256 - lost(a, b)) + 128) >> 8 for (a, b), r in rays.items()}
            rays = {(a, b): (ray_of(rays, a - 1, b) + 30 * r + ray_of(rays, a + 1, b) + 16) >> 5 for (a, b), r in rays.items()}
            rays = {(a, b): (ray_of(rays, a, b - 1) + 30 * r + ray_of(rays, a, b + 1) + 16) >> 5 for (a, b), r in rays.items()}

    def sweep_open(self, side):
        n, nu, nv, _, _, cell = self.slices(side // 2, side % 2 == 0)
        arrives = {key: 255 for key in product(range(nu), range(nv))}
        spread = lambda e: (e[0] + 2 * (e[1] + e[2] + e[3]) + e[4] + 4) >> 3
        for s in range(n):
            for (a, b), value in arrives.items():
                self.light[cell(s, a, b)][1 + side] = value
            leaves = {(a, b): (value * (256 - self.loss[cell(s, a, b)]) + 128) >> 8 for (a, b), value in arrives.items()}
            along = {(a, b): spread([ray_of(leaves, a + i, b) for i in range(-2, 3)]) for a, b in leaves}
            both = {(a, b): spread([ray_of(along, a, b + i) for i in range(-2, 3)]) for a, b in along}
            arrives = {key: value + ((255 - value + 7) >> 3) for key, value in both.items()}

    # docs/picture/definition.md 4 and 5
    def ray(self):
        camera = self.scene["camera"]
        w, h = camera["width"], camera["height"]
        across, down = 64 * self.x + 32, 64 * self.y + 32
        u, v = across - 32 * w, 32 * h - down
        direction = [f * 32 * h + a * u + b * v for f, a, b in zip(self.forward, self.wide, self.high)]
        self.start = [e + ((f * self.near) >> 14) + ((a * u + b * v) >> 10)
                      for e, f, a, b in zip(self.eye, self.forward, self.near_wide, self.near_high)]
        most = max(map(abs, direction))
        b = next(b for b in range(99) if most <= 1 << b)
        self.step = [rounded(c, b - 20 + 2 + self.e) for c in direction]
        self.tell("pixel", "pixel", self.x, self.y)
        for name, numbers in (("place", [across, down]), ("direction", direction), ("start", self.start), ("step", self.step)):
            self.tell("ray", name, numbers)
        first, last = 0, 1 << 60
        for start, step, n in zip(self.start, self.step, self.cells):
            low, high = -(1 << 19) - (1 << 11), (n << 20) + (1 << 19) - (1 << 11)
            inside = [k for k in range(0, 4096) if low <= start + k * step < high]
            first, last = max(first, inside[0]), min(last, inside[-1])
        self.range = first, last
        self.tell("ray", "range", first, last)

    def read_at(self, position):
        brick = [(place(p)[0] + 2) // 8 for p in position]
        if brick != self.brick:
            self.brick = brick
            self.tell("brick", "brick", brick)

    def look_up(self, stage, position, shift=0):
        if stage != "light":
            self.read_at(position)
        places = [place(p >> shift) for p in position]
        self.tell(stage, "position", position)
        self.tell(stage, "cell", [c for c, _ in places])
        self.tell(stage, "weight", [w for _, w in places])
        corners = [tuple(c + d for (c, _), d in zip(places, reversed(zyx))) for zyx in product((0, 1), repeat=3)]
        return corners, [w for _, w in places]

    def sample(self, position):
        corners, (wx, wy, wz) = self.look_up("sample", position)
        levels = [self.at(self.levels, c, AIR) for c in corners]
        along_x = [blended(levels[i], levels[i + 1], wx) for i in (0, 2, 4, 6)]
        along_y = [blended(along_x[i], along_x[i + 1], wy) for i in (0, 2)]
        level = blended(*along_y, wz)
        for name, numbers in (("fetched", levels), ("along x", along_x), ("along y", along_y), ("level", level)):
            self.tell("sample", name, numbers)
        return level

    # docs/picture/definition.md 7
    def crossing(self):
        position = lambda k: [s + k * d for s, d in zip(self.start, self.step)]
        for k in range(self.range[0], self.range[1] + 1):
            self.tell("sample", "k", k)
            if self.sample(position(k)) >= 0:
                break
        self.tell("crossing", "samples", k - 1, k)
        outside, inside = position(k - 1), position(k)
        a, b, e = self.sample(outside), self.sample(inside), 0
        for i in range(3):
            middle = [p + ((q - p) >> 1) for p, q in zip(outside, inside)]
            self.tell("crossing", "middle", i + 1)
            level = self.sample(middle)
            e = 2 * e + (1 if level < 0 else 0)
            if level < 0:
                outside, a = middle, level
            else:
                inside, b = middle, level
        f = (-a * 256) // (b - a)
        self.p = [p + (((q - p) * f) >> 8) for p, q in zip(outside, inside)]
        for name, numbers in (("A", outside), ("B", inside), ("a", a), ("b", b), ("e", e), ("f", f), ("sample", k),
                              ("part", 256 * e + f), ("crossing", self.p)):
            self.tell("crossing", name, numbers)
        z = dot([(p - q) >> 8 for p, q in zip(self.p, self.eye)], self.forward) >> 30
        self.tell("met", "on ground", 0)
        self.tell("met", "depth", clamp((z - 256 * self.near) >> 7, 0, 65534))

    # docs/picture/definition.md 8
    def normal(self):
        self.read_at(self.p)
        s = [p + (1 << 11) for p in self.p]
        cell = [c >> 20 for c in s]
        values, slopes = [], []
        for c in s:
            u = (c >> 12) % 256
            t = 256 - u
            low, high = (t * t) >> 9, (u * u) >> 9
            values.append([low, 256 - low - high, high]), slopes.append([-t, t - u, u])
        self.tell("normal", "position", self.p)
        self.tell("normal", "cell", cell)
        for axis in range(3):
            self.tell("normal", f"weights along {'xyz'[axis]}", values[axis], slopes[axis])
        level = lambda x, y, z: self.at(self.levels, (cell[0] + x, cell[1] + y, cell[2] + z), AIR)
        fetched = [[[level(x, y, z) for x in (-1, 0, 1)] for y in (-1, 0, 1)] for z in (-1, 0, 1)]
        value, slope = lambda of, axis: rounded(dot(of, values[axis]), 8), lambda of, axis: rounded(dot(of, slopes[axis]), 9)
        along_x = [[(slope(row, 0), value(row, 0)) for row in plane] for plane in fetched]
        along_y = [(value([s for s, _ in plane], 1), slope([v for _, v in plane], 1), value([v for _, v in plane], 1))
                   for plane in along_x]
        g = [value([p[0] for p in along_y], 2), value([p[1] for p in along_y], 2), slope([p[2] for p in along_y], 2)]
        self.tell("normal", "fetched", [n for plane in fetched for row in plane for n in row])
        self.tell("normal", "along x", [n for plane in along_x for pair in plane for n in pair])
        self.tell("normal", "along y", [n for three in along_y for n in three])
        self.tell("normal", "slope", g)
        normal = self.unit([-c for c in g])
        self.tell("normal", "normal", normal)
        return normal

    # docs/picture/light.md 3
    def matter(self, position):
        among = [clamp(p, 1 << 19, (n << 20) - (1 << 19)) for p, n in zip(position, self.cells)]
        corners, weights = self.look_up("matter", among)

        def bytes_of(cell):
            if self.at(self.levels, cell, AIR) == AIR:
                return [0, 0, 0]
            s, l = self.solid[cell], self.liquid[cell]
            return [(255 * l) // (s + l) if s + l else 0, 0, 0]
        fetched = [bytes_of(c) for c in corners]
        self.tell("matter", "fetched", *fetched)
        of = eight(fetched, weights)
        for name, number in zip(("liquid", "heat", "obstacle"), of):
            self.tell("matter", name, number)
        return of

    # docs/picture/light.md 5 to 8
    def surface(self):
        n, p = self.normal(), self.p
        liquid = self.matter(p)[0]
        obstacle = self.matter([a + (c << 5) for a, c in zip(p, n)])[2]
        corners, weights = self.look_up("light", [a + (c << (6 + self.s)) for a, c in zip(p, n)], self.s)
        fetched = [self.light[tuple(clamp(c, 0, m - 1) for c, m in zip(corner, self.count))] for corner in corners]
        self.tell("light", "fetched", *fetched)
        light = eight(fetched, weights)
        lamp, open_, glow = light[0], light[1:7], light[7:]
        self.tell("light", "lamp", lamp), self.tell("light", "open", open_), self.tell("light", "glow", glow)
        e = self.unit([-c for c in self.step], True)
        self.tell("met", "to_eye", e)

        l, w = 16 * liquid + (liquid >> 4), clamp(73 * (obstacle - 148), 0, 4096)
        self.tell("material", "l", l), self.tell("material", "w", w)
        of = {name: mixed(mixed(self.material["solid"][name], self.material["liquid"][name], l),
                          self.material["obstacle"][name], w) for name in self.material["solid"]}
        for name, numbers in of.items():
            self.tell("material", name, numbers)
        self.tell("material", "emission", 0, 0, 0)

        def seen(sides, r):
            total = sum(((c * c) >> 14) * sides[2 * a + (1 if c < 0 else 0)] for a, c in enumerate(r))
            return min(total >> 14, 255)
        facing = cosine(n, self.to_light)
        lit = (((max(facing + 2458, 0) * 14247) >> 14) * whole(lamp)) >> 8
        ambient = [b + (((a - b) * (n[1] + (1 << 14))) >> 15) for a, b in zip(self.from_above, self.from_below)]
        arriving = [((a * whole(seen(open_, n))) >> 8) + ((b * lit) >> 14) for a, b in zip(ambient, self.lamp)]
        for name, numbers in (("lamp", whole(lamp)), ("facing", facing), ("lit", lit), ("seen open", seen(open_, n)),
                              ("seen glow", 0), ("ambient", ambient), ("arriving", arriving)):
            self.tell("arriving", name, numbers)

        half = self.unit([a + b for a, b in zip(self.to_light, e)], True)
        shine = clamp(cosine(n, half), 0, 1 << 14)
        unlit = self.highlight(shine)
        peak = (((unlit * smooth(0, 1024, facing >> 2)) >> 12) * whole(lamp)) >> 8
        eye = clamp(cosine(n, e), 0, 1 << 14)
        a = (1 << 14) - eye
        a2 = (a * a) >> 14
        a4 = (a2 * a2) >> 14
        graze = (a4 * a) >> 14
        more = (graze * of["gloss"]) >> 14
        twice = (2 * dot(n, e)) >> 14
        r = [((c * twice) >> 14) - d for c, d in zip(n, e)]
        for name, numbers in (("half", half), ("shine", shine), ("unlit peak", unlit), ("peak", peak), ("eye", eye), ("a2", a2),
                              ("a4", a4), ("graze", graze), ("more", more), ("r", r)):
            self.tell("mirror", name, numbers)
        entry = clamp(r[1] + (1 << 14), 0, 1 << 15) >> 4
        by_lamp = smooth(self.low, self.lamp_high, cosine(r, self.to_light) >> 2)
        by_strip = smooth(self.strip, 3973, cosine(r, self.to_strip) >> 2)
        around = [s + ((m * by_lamp) >> 12) + ((t * by_strip) >> 12)
                  for s, m, t in zip(self.surroundings(entry), (9830, 9626, 9216), (2867, 3072, 3482))]
        free = 614 + ((whole(seen(open_, r)) * whole(seen(open_, n)) * 3482) >> 16)
        for name, numbers in (("entry", entry), ("surroundings", self.surroundings(entry)), ("lamp", by_lamp), ("strip", by_strip),
                              ("around", around), ("seen open by r", seen(open_, r)), ("free", free)):
            self.tell("mirror", name, numbers)
        fresnel = [m + (((4096 - m) * more) >> 12) for m in of["mirror"]]
        back = [(((c * free) >> 12) * f) >> 12 for c, f in zip(around, fresnel)]
        colour = [((c * d) >> 12) + ((h * peak) >> 12) + m
                  for c, d, h, m in zip(arriving, of["diffuse"], of["highlight"], back)]
        for name, numbers in (("fresnel", fresnel), ("mirrored", back), ("own", [0, 0, 0]), ("colour", colour)):
            self.tell("colour", name, numbers)
        light = [pressed(c) for c in colour]
        limits = [math.ceil(4096 * decoded((b + 0.5) / 255)) for b in range(255)]
        self.tell("pixel", "pressed", light)
        self.tell("pixel", "samples", 1)
        self.tell("pixel", "light", light)
        self.tell("pixel", "bytes", [sum(limit <= c for limit in limits) for c in light])


def eight(values, weights):
    """Bytes between eight cells, the first eight along x fastest."""
    for weight in weights:
        values = [[blended(p, q, weight) for p, q in zip(values[i], values[i + 1])] for i in range(0, len(values), 2)]
    return values[0]


def ray_of(rays, a, b):
    return rays.get((a, b), 255)


def pressed(c):
    """docs/picture/light.md 7"""
    c, left = clamp(c, 0, 12287), 1 << 30
    for _ in range(2868, c + 1):
        left = rounded(left * 1072868508, 30)
    return c if c <= 2867 else 4096 - rounded(1229 * left, 30)


def decoded(s):
    """sRGB's light"""
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4
