#!/usr/bin/env python3
"""One step of small viscous states, as docs/automaton.md gives them by hand: every implementation and the oracle find the same.

  hand_runs_test.py VOXMELT ORACLE [--all]

Nothing conducts here (weights of 0). With kappa = 0.05 mobility_parameter is 47721859. Then raw is 11110, 13443,
186414, 288546 and 745654 for M = 1000, 1100, 4096, 5096 and 8192, and no limit cuts it. With kappa = 1
mobility_parameter is 954437177. Where nothing else is said, all four cells beside a pair across an axis are blocked:
p = 4, so that s is 24576 between level beds, and drive = 24 drop.
D(0) = 0, D(1) = 32768, D(2) = 16384, D(3) = 49152, D(6) = 24576 and D(13) = 45056.
"""
import json
import struct
import subprocess
import sys
import tempfile
from pathlib import Path
from machines import of_hand_tests

FIELDS = {"solid": "B", "liquid": "B", "inert": "B", "amount": "H", "energy": "H", "heat": "H"}
VISCOUS = 'flow = { law = "viscous", viscous = { kappa = 0.05, substeps = 1 } }\nheat = { gamma = 1e-9 }\n'
# At heat 0 the mobility is 2^-15 of that at the reference.
DEEP = 'flow = { law = "viscous", viscous = { kappa = 71, substeps_max = 1024 }, ' \
       'thermal = { reference = 1, doubling = 0.0667 } }\nheat = { gamma = 1e-9 }\n'
# Tm = L = 20000. A whole solid lacks 20000 of heat; k = 1, w = 40000 and scale = 6711.
MELTING = "material = { melting_point = 0.305181, latent_heat = 0.305181 }\n"
AIR, HIGH, LOW, FLAT = ("air", 0, 0), ("inert", 3840, 0), ("inert", 240, 0), ("inert", 2048, 0)


def viscous(kappa, more=""):
    keys = more if "substeps" in more else f"{more}, substeps = 1".lstrip(", ")
    return VISCOUS.replace("0.05, substeps = 1", f"{kappa}, {keys}")


def thermal(kappa, more=""):
    """The mobility is that of kappa at the heat of 2048, and doubles with every 2048 more (mobility_rate is 2048)."""
    return viscous(kappa, more).replace(" } }\nheat", " }, thermal = { reference = 0.031251, doubling = 0.03125 } }\nheat")


def sunlit(power):
    """Under a sun straight above, of this power: each cell receives floor(power / 256) of parameters.json."""
    return VISCOUS + f'heat_source = [{{ kind = "directional", direction = [0, 1, 0], power = {power} }}]\n'


def liquid(amount, heat):
    return "liquid", amount, heat


def solid(amount, heat):
    return "solid", amount, heat


def column(*cells, air=0):
    return [1, len(cells) + air, 1], [liquid(*cell) for cell in cells] + [AIR] * air


def at_heat(parameters, raw, h):
    """raw with thermal viscosity, of a run of this mean heat."""
    flow = parameters["flow"]
    x = (h - flow["mobility_reference"]) * flow["mobility_rate"] >> 6
    n, f = divmod(max(-2**21, min(2**19 - 1, x)), 65536)
    e = 4096 + (f * (43057 + (22479 * f >> 16)) >> 20)
    return raw * e >> 12 - n


# The mobility at the mean heat of 2047: this is what the flank of the case gets per cell.
def thermal_flank(parameters):
    # A run of two full cells: M = 8192, so that min(M, 2^18)^2 >> 8 is 262144.
    free = (parameters["flow"]["viscous"]["mobility"] * 262144 + (1 << 23)) >> 24
    raw = at_heat(parameters, free, 2047)
    # Below a = (4096 + 0 + 1) >> 1 and D = D(1, 0, 4) = 32768. Above the air shows no bed, and D + D(1) wraps to 0.
    low = ((raw * 2048 >> 12) * 12288 + 1024 * 32768) >> 26
    high = (raw * 12288) >> 26
    return [(4096 - low, 2047), (low + high, 2048), (4096 - high, 2048), (0, 0)]


def counted_when_deep(parameters):
    raw = at_heat(parameters, 16 * 67765039559, 0)
    n = -(-raw // (256 * 201))
    return 64 * n, 262144 * n, 0, 0


# The giver is in front on the left and the taker behind on the right, both on beds of 256; beside them are air over a
# bed of 767, and an inert cell.
DIAGONAL = [2, 2, 2], [("inert", 4095, 0), ("inert", 0, 0), AIR, liquid(2122, 7000),
                       ("inert", 0, 0), FLAT, liquid(4096, 30000), FLAT]

# Name, size, cells (x fastest, then y), scene, first step, expected amounts and heats of the cells that are not inert,
# and for some the counters.
CASES = [
    # down_1 = 2048: (4096 x 2000 + 2048 x 3000) / 6144 = 2333.3; then down_0 = 2048: (2048 x 1000 + 2048 x 2333) / 4096.
    ("a deficit moves down, from the top on", *column((2048, 1000), (4096, 2000), (4096, 3000)), VISCOUS, 0,
     [(4096, 1666), (4096, 2333), (2048, 3000)]),
    # With D = 32768 half a cell is added: 2333.8, and then (2048 x 3333 + 2048) / 4096 = 1667.
    ("each flow is dithered", *column((2048, 1000), (4096, 2000), (4096, 3000)), VISCOUS, 1,
     [(4096, 1667), (4096, 2333), (2048, 3000)]),
    # up_0 = 5904: (100 x 1000 + 5904 x 50000) / 6004 = 49183.9; up_1 = 1908 of that.
    ("an excess moves up, from the bottom on", *column((10000, 50000), (100, 1000), air=2), VISCOUS, 0,
     [(4096, 50000), (4096, 49183), (1908, 49183), (0, 0)]),
    # up_1 = 6144: (100 x 9000 + 6144 x 2000) / 6244 = 2112.1; up_2 = 2148 of that; down_0 = 2048: (1000 + 2000) / 2.
    ("up and down in one run", *column((2048, 1000), (12288, 2000), (100, 9000), air=3), VISCOUS, 0,
     [(4096, 1500), (4096, 2000), (4096, 2112), (2148, 2112), (0, 0), (0, 0)]),
    # up_0 = 1024 comes first: (2048 x 1000 + 1024 x 1001) / 3072 = 1000.3; then down_1 = 1024: (3072 x 1000 + 1024 x 1003)
    # / 4096 = 1000.75. The other way round it would be 1001.
    ("up before down into one cell", *column((5120, 1001), (2048, 1000), (4096, 1003)), VISCOUS, 0,
     [(4096, 1001), (4096, 1000), (3072, 1003)]),
    # e_0 = e_1 = 61439: (4096 x 20000 + 61439 x 40000) / 65535 = 38749.98.
    ("an excess of AMAX - ONE keeps the order", *column((65535, 40000), (4096, 20000), air=15), VISCOUS, 0,
     [(4096, 40000)] + [(4096, 38749)] * 15 + [(4095, 38749)]),
    # e_1 = 61440: (65535 x 40000 + 4097 x 20000) / 69632 = 38823.2.
    ("one more mixes the run", *column((65535, 40000), (4097, 20000), air=15), VISCOUS, 0, [(4096, 38823)] * 17),
    # e_29 = 61441 - 30 ONE = -61439, M = 65537. Only cell 0 is of another heat than what comes down.
    ("a deficit of AMAX - ONE keeps the order",
     *column((2048, 1000), *[(2048, 2000)] * 28, (2049, 2000), (4096, 2000)), VISCOUS, 0,
     [(4096, 1500)] + [(4096, 2000)] * 15 + [(1, 2000)] + [(0, 0)] * 14, (17, 65537, 17, 65537)),
    # e_29 = -61440: (2048 x 1000 + 63488 x 2000) / 65536 = 1968.75.
    ("one less mixes the run", *column((2048, 1000), *[(2048, 2000)] * 29, (4096, 2000)), VISCOUS, 0,
     [(4096, 1968)] * 16 + [(0, 0)] * 15),
    # over = 4096 comes to lie in the upper cell: (8192 x 1000 + 4096 x 4000) / 12288 = 2000.
    ("a run under a ceiling is mixed", [1, 2, 1], [liquid(8192, 1000), liquid(4096, 4000)], VISCOUS, 0,
     [(4096, 2000), (8192, 2000)]),
    # Beds 736 and 286: t = 23 - 8 = 15, so A_i alone counts. q = 225, root = 8719, plane = 4639, s = 4639 + 4 x 579 = 6955,
    # drive = 6955 x 512 >> 10 = 3477, c = 186414 + 17638. R = D(0) + D(1) = 32768: (204052 x 3477 + 1024 R) >> 26 = 11, and
    # not 10.572. The heat: (11340 + 77) / 1271 = 8.98.
    ("a slope slows the flow along x", [2, 3, 1], [HIGH, LOW, liquid(4096, 7), liquid(1260, 9), AIR, AIR], VISCOUS, 0,
     [(4085, 7), (1271, 8), (0, 0), (0, 0)]),
    # R = D(1) + D(1) mod 65536 = 0: 204052 x 3477 >> 26 = 10. The heat: (11340 + 70 + 635) / 1270 = 9.48.
    ("a flow is dithered", [2, 3, 1], [HIGH, LOW, liquid(4096, 7), liquid(1260, 9), AIR, AIR], VISCOUS, 1,
     [(4086, 7), (1270, 9), (0, 0), (0, 0)]),
    # Beds 736 and 0: t = 23 and q = 511, not 529. Heads 1248 and 637, root = 5468, plane = 1824, s = 1824 + 4 x 228 = 2736,
    # drive = 2736 x 512 >> 10 = 1368, c = 186414 + 288546, R = D(1): (474960 x 1368 + 1024 R) >> 26 = 10.
    ("a slope of more than 1.41 is cut", [2, 2, 1],
     [HIGH, liquid(4096, 9), liquid(4096, 7), liquid(1000, 9)], VISCOUS, 0,
     [(4096, 9), (4086, 7), (1010, 8)]),
    # Beds 736, 512 and 286. +z to the air on a flat bed: t = 7. Of the cells beside the pair three are blocked, the fourth
    # is the taker of the diagonal, 8 lower than the air: q = 49 + 64, root = 11366, plane = 7884, s = 7884 + 3 x 985 = 10839,
    # drive = 10839 x 512 >> 10 = 5419, R = 40960 + D(1) - 65536 = 8192: (186414 x 5419 + 1024 R) >> 26 = 15.
    # +x+z: t = 15, one corner is blocked: q = 225 >> 1, root = 11397, plane = 7927, drive = 7927 x 724 >> 10 = 5604,
    # R = 57344 + D(1) - 65536: (197524 x 5604 + 4096 R) >> 28 = 4.
    ("a slope slows the flow along a diagonal", [2, 2, 2],
     [HIGH, FLAT, liquid(4096, 7), FLAT, FLAT, LOW, AIR, liquid(1000, 9)], VISCOUS, 6,
     [(4077, 7), (15, 7), (1004, 9)]),
    # Beds 512, 512 and, in front of the giver, 286: a rise of 8 beside every pair along an axis, and between the corners
    # of +x+z. To +x: t = 0, q = 64, root = 13107, plane = 10485, s = 10485 + 2 x 1310 = 13105, drive = 13105 x 375 >> 10 =
    # 4799, c = 199857 x 2598 >> 12 = 126764: w = 9.065 + 0.5. To +z: t = 8, q = 128, root = 10922, plane = 7280, s = 9100,
    # drive = 4550: w = 186414 x 4550 / 2^26 = 12.64 + 0.75. To +x+z: q = 32, root = 14563, plane = 12944, drive = 6472,
    # c = 93207: w = 2.247 + 0. The other run gives 0.047 + 0.75 and 0.062 + 0.25. The heat: (9900 + 63) / 1109 = 8.98.
    ("a slope across slows the flow", [2, 2, 2],
     [FLAT, FLAT, liquid(4096, 7), liquid(1100, 9), LOW, FLAT, AIR, AIR], VISCOUS, 0,
     [(4072, 7), (1109, 8), (13, 7), (2, 7)]),
    # Head 1760. Both cells beside it lie over air: t = 0, but they show no bed, and A_i alone counts.
    # 745654 x 12288 / 2^26 = 136.53, and D(1) and D(2) add 0.5 and 0.25. Then both flows fall.
    ("a flank above air shows no bed", [2, 3, 1], [HIGH, AIR, liquid(4096, 7), AIR, liquid(4096, 7), AIR], VISCOUS, 0,
     [(137, 7), (3959, 7), (136, 7), (3960, 7), (0, 0)]),
    # t = 15 at both heights: (745654 + 11110) x 3477 / 2^26 = 39.21, and D(1) and D(2) add 0.5 and 0.25. Into the run:
    # (9000 + 273) / 1039 = 8.9. What comes above it then falls: (1039 x 8 + 39 x 7) / 1078 = 7.96.
    ("a cell above a run shows its bed", [2, 3, 1],
     [HIGH, LOW, liquid(4096, 7), liquid(1000, 9), liquid(4096, 7), AIR], VISCOUS, 0,
     [(4057, 7), (1078, 7), (4057, 7), (0, 0)]),
    # One of the four cells beside the pair is blocked: s = 16384 + 2048, drop = 512 - 250 and drive = 4716. The yield
    # gives dead = 200 in the giver and 269 in the others of 3048, so nothing else flows. m = 256 x 6553 + 888889, a = 3048,
    # c = 1909804, and w = 134.2.
    ("an axis has an eighth for a blocked diagonal", [2, 1, 3],
     [liquid(3048, 7), FLAT, liquid(4096, 7), liquid(2000, 7), liquid(3048, 7), liquid(3048, 7)],
     viscous(1, "yield = 0.390625"), 0, [(3048, 7), (3962, 7), (2134, 7), (3048, 7), (3048, 7)]),
    # The mean is 2047.5, and D(1) would add 0.5. raw is 1118481 at the heat of 2048, which is above 256 x 4369, and 1118071
    # at 2047. 204 of heat 2048 fall on 102 of heat 2047: their mean is 2047.67, and D(1) does add 0.5.
    ("the mobility goes by the mean heat without dither", [2, 2, 1],
     [liquid(4096, 2047), AIR, liquid(4096, 2048), AIR], thermal(0.075), 1, thermal_flank, (2, 8192, 0, 0)),
    # x = -32 x 1024: n = -1, f = 32768 and e = 4096 + (32768 x (43057 + 11239) >> 20) = 5792. mobility_parameter is
    # 47721858844, and raw = 186413511 x 5792 >> 13 = 131800177: 78.6 times 256 x 6553.
    ("the mobility goes by a power of two", [1, 1, 1], [liquid(4096, 1024)],
     thermal(50, 'substeps = "auto", substeps_max = 79'), 0, [(4096, 1024)], (79, 4096 * 79, 0, 0)),
    # The scene moves the reference by 0.02 octaves, to 2089, where the mobility is nearly 2^36. x = 32 x 18391 is nine
    # doublings, and is cut: n = 7, f = 65535 and e = 8191. M^2 >> 8 = 2, and raw = 8191 x 8191 >> 5 = 2096640, below 256 x
    # 13107. Without the cut it would be 4135431, and take two sub-steps.
    ("the mobility grows by 2^8 at most", [1, 1, 1], [liquid(24, 20480)],
     thermal(71, 'substeps = "auto"'), 0, [(24, 20480)], (1, 24, 0, 0)),
    # Beds 543, 512 and 511: t = 16 - 16 = 0 on the left, and 16 - 15 = 1 on the right. m = 256 x 13107 + 713614 for both,
    # and R = D(1). On the left a = 5888 >> 1 = 2944, c = 2924598 and drive = 6144: w = 268.3. On the right A_i counts:
    # c = 4068012, s = 16257 + 4 (16256 >> 3) = 24384, drive = 24384 x 288 >> 10 = 6858, and w = 416.2.
    ("between level beds both amounts count", [3, 2, 1],
     [("inert", 2303, 0), FLAT, ("inert", 2047, 0), liquid(1792, 7), liquid(4095, 7), liquid(1792, 7)], viscous(1), 0,
     [(2060, 7), (3411, 7), (2208, 7)]),
    # The limit of the middle is 13107 / 5 = 2621, and m = 512 x 2621. The drops are 3 and 2: c drive / 2^26 is 1.440 and
    # 0.960, in the highest layer 1.436 and 0.958. D(2) + D(y) adds 0.25, 0.75 and 0.5 from below, and wraps to 0 on top.
    ("the layers of a pool round in turn", [3, 5, 1],
     [liquid(4096, 7)] * 9 + [liquid(4072, 7), liquid(4096, 7), liquid(4080, 7)] + [AIR] * 3, viscous(1), 2,
     [(4097, 7), (4094, 7), (4097, 7), (4098, 7), (4093, 7), (4097, 7),
      (4097, 7), (4094, 7), (4097, 7), (4073, 7), (4095, 7), (4080, 7)] + [(0, 0)] * 3),
    # The parameter is 12900, and depth 256: dead = (25800 + 128) / 256 = 101. The drop on the left is 101, which rests.
    # On the right it is 102: m = 186414 + 119538, a = 7377 >> 1 = 3688, c = 275476, drive = 2448, and w = 10.05.
    ("a yield is a drop in 1/512 cell", [3, 1, 1], [liquid(3288, 7), liquid(4096, 7), liquid(3280, 7)],
     viscous(0.05, "yield = 0.19684"), 0, [(3288, 7), (4086, 7), (3290, 7)]),
    # over = 100, so the head is 524 + 7 (100 >> 3) = 608, and drop = 96. The limit is 13107 / 2 / 8 = 819, and
    # m = 195627 + 186414 is below 512 x 819. a = 8293 >> 1 = 4146, c = 386704, drive = 2304, and w = 13.28.
    ("a run under a ceiling is stiff", [2, 1, 1], [liquid(4196, 7), liquid(4096, 7)], VISCOUS, 0,
     [(4183, 7), (4109, 7)]),
    # The excesses are 64 and, of the two cells on the right, -64. Heads 736 + 520 + 7 x 8 = 1312 and 1016: the left one
    # would give, but both are shut. They count all the same. The lower cell on the right lies beside an inert one.
    ("two shut runs give each other nothing", [2, 2, 1], [HIGH, liquid(4096, 9), liquid(4160, 7), liquid(4032, 9)],
     viscous(1), 0, [(4096, 9), (4160, 7), (4032, 9)], (3, 12288, 3, 12288)),
    # The excess on the left is 65, so that only the right one is shut. Head 520 + 7 (65 >> 3) = 576, and drop = 64.
    # m = 192375 + 186414 is below 512 x 819, a = 8258 >> 1 = 4129, c = 381840, drive = 1536, and w = 8.74.
    ("an excess of 65 is not shut, and gives to a shut run", [2, 1, 1], [liquid(4161, 7), liquid(4096, 7)], VISCOUS, 0,
     [(4153, 7), (4104, 7)]),
    # The left run is full, but air lies above it. The right one lacks 56 and has an inert cell above it: it is shut.
    # drop = 512 - 505, m is cut to 512 x 6553, a = 8137 >> 1 = 4068, c = 3332200, drive = 168, and w = 8.34.
    ("a full run below air is not shut", [2, 2, 1], [liquid(4096, 7), liquid(4040, 7), AIR, FLAT], viscous(1), 0,
     [(4088, 7), (4048, 7), (0, 0)]),
    # The left and the middle are shut. The drop to the left is 8, by which 9.52 would flow. To the right it is 9:
    # m = 512 x 6553, a = 8128 >> 1 = 4064, c = 3328924, drive = 216, and w = 10.71.
    ("a run that lacks 64 is shut, and one that lacks 65 is not", [3, 1, 1],
     [liquid(4032, 7), liquid(4096, 7), liquid(4031, 7)], viscous(1), 0, [(4032, 7), (4086, 7), (4041, 7)]),
    # kappa 1: limits 3276 and 6553. Run to run m = 256 (3276 + 6553), above the right run exposed = 2^21 and 256 x 6553:
    # both are cut to 512 x 3276. Between the runs a = 4096, and 1677312 x 12288 >> 26 = 307. Above the right run a = 2048,
    # and (838656 x 12288 + 1024 D(1)) >> 26 = 154. At the top no bed shows: (2^21 x 12288 + 1024 D(2)) >> 26 = 384, which
    # falls on the 154.
    ("a pair has the limit of its giver", [2, 4, 1],
     [liquid(4096, 7), liquid(4096, 7), liquid(4096, 7), AIR, liquid(4096, 7), AIR, AIR, AIR], viscous(1), 0,
     [(3789, 7), (4403, 7), (3942, 7), (538, 7), (3712, 7), (0, 0), (0, 0), (0, 0)], (4, 16384, 4, 16384)),
    # Limit 4369; m = 256 x 4369 + 888889 and m = 512 x 4369; a = 6097 >> 1 = 3048 and 8097 >> 1 = 4048: w = 273 below and
    # 405 above. There the room is 96, and 96 x 13107 >> 16 = 19. Of the 4019 above then 1823 fall.
    ("a cell takes at most a fifth of its room", [2, 2, 1],
     [liquid(4096, 7), liquid(2000, 7), liquid(4096, 7), liquid(4000, 7)], viscous(1), 0,
     [(3823, 7), (4096, 7), (4077, 7), (2196, 7)], (3, 10192, 2, 8192)),
    # drop = 537 - 250, drive = 6888. Below m = 256 x 6553 + 888889, a = 3048, c = 1909804, and w = 196. Above it is
    # m = 2^21 + 888889, a = 1100, c = 801915, and w = 82, but 200 x 13107 >> 16 = 39. Of the 2039 above then 1900 fall.
    ("a cell gives at most a fifth of its own", [2, 2, 1],
     [liquid(4096, 7), liquid(2000, 7), liquid(200, 7), liquid(2000, 7)], viscous(1), 0,
     [(3900, 7), (4096, 7), (161, 7), (139, 7)]),
    # raw = 3728270 of the giver > 2 x 256 x 6553, so n = 3. The flow goes along +x-z (axis 3), whose R begins with
    # u + 2, and D = D(1, 3, 4) + D(1) = 49152: R = 60074, 16384, 38229, and B = 32768, 0, 49152. The air beside both has
    # head 767, the giver at most 768. a = 3109, c = 1196461, 1192502, 1188818, drive = 3952, 3872, 3808 and f = 18, 17, 17
    # by (c drive + 4096 R) >> 28.
    ("three sub-steps, as counted", *DIAGONAL, viscous(1, 'substeps = "auto"'), 1,
     [(0, 0), (2174, 7549), (4044, 30000)], (6, 18654, 0, 0)),
    ("three sub-steps, as given", *DIAGONAL, viscous(1, "substeps = 3, substeps_max = 1"), 1,
     [(0, 0), (2174, 7549), (4044, 30000)], (6, 18654, 0, 0)),
    # raw = 3726450 <= 2 x 256 x 13107, so n = 2. R = 22528, 55296, and B = 45056, 12288.
    # m = 2032413, 1931292 and a = 5330 >> 1 = 2665: c = 1322358, 1256565, drive = 8568, 7560 and f = 169, 142.
    ("two sub-steps, as counted", [2, 1, 1], [liquid(4095, 20000), liquid(1234, 8000)],
     viscous(1, 'substeps = "auto"'), 13, [(3784, 20000), (1545, 10416)], (4, 10658, 0, 0)),
    # raw = 1864135 > 256 x 6553 in the first of two, as three would be needed. R = 16384, 49152, and B = 32768, 0.
    # m = 1677568 + 11719, 1726578 + 25486 and a = 4422 >> 1 = 2211: c = 911868, 945755, drive = 11328, 10392 and
    # f = 154, 147.
    ("two sub-steps at most", [2, 1, 1], [liquid(4096, 20000), liquid(325, 9000)],
     viscous(1, 'substeps = "auto", substeps_max = 2'), 1, [(3795, 20000), (626, 14289)], (4, 8842, 1, 4096)),
    # What the vent fills in this step would need three sub-steps, but n = 1: a = 2048, c = 2^20, 2^20 x 12288 >> 26 = 192.
    ("sub-steps are counted before the vents", [2, 1, 1], [AIR, AIR],
     viscous(1, 'substeps = "auto"') + "vent = [{ at = [0.5, 0.5, 0.5], radius = 0.5, rate = 1 }]\n", 0,
     [(3904, 0), (192, 0)], (1, 4096, 1, 4096)),
    # raw = 1677722 and the limit is 13107 / 4 / 8 = 409, so n = 17. Then pace = 2807168 and raw = 98690.
    ("sub-steps under a ceiling", [1, 2, 1], [liquid(8192, 1000), liquid(4096, 4000)],
     viscous(0.05, 'substeps = "auto"'), 0, [(4096, 2000), (8192, 2000)], (34, 208896, 0, 0)),
    # mobility_parameter is 960 and raw 16 times that. The limit is 13107 / 1648 / 8 = 0, so 1 counts, and n = 60. Then
    # pace = 16 and raw = 256, which is not above the limit.
    ("a limit is at least 1", [1, 103, 1], [liquid(65535, 7)] * 103, viscous("1.0058e-6", 'substeps = "auto"'), 0,
     [(65535, 7)] * 103, (6180, 405006300, 0, 0)),
    # kappa 71: mobility_parameter is 67765039559, and raw 16 times that without thermal viscosity. The limit is 201.
    ("the deepest and the stiffest", [1, 64, 1], [liquid(4096, 0)] * 64, DEEP, 0, [(4096, 0)] * 64, counted_when_deep),
    # N = 3 by raw = 3728270, so two stages: reach 3, bits 2, and the limits are 4914 and 9830, which cut nothing. m = 3751708,
    # a = 2211, c = 2025152, and k = (1977 x 24576 >> 16) x 43690 >> 14 = 1975. I_1 = 32767 and 22698: 303 are levelled, and
    # W = -+909, D = -455 and 454. drop = 30208 - 909 = 29299, drive = 21974, R = D(1), and
    # ((c drive >> 10) + 65536) / 2^17 = 332.06. One stage would let 155 flow.
    ("two columns relax in two stages", [2, 1, 1], [liquid(4096, 20000), liquid(325, 9000)],
     viscous(1, "substeps = 1, stages_max = 16"), 1, [(3764, 20000), (657, 14559)], (2, 4421, 0, 0)),
    # kappa 2: N = 5, so three stages: reach 6, bits 3, times 10922, 32768 and 65536. m = 9416476 and 2070983, a = 3098 and
    # 1300, c = 7122129 and 657294, k = 3474 and 319. I_1 = 16383, 13716 and 11583: 141 and 10, so that W = -423, 393, 30 and
    # D = -212, 196, 15. I_2 = 48940, 41348 and 34767: 402 and 32, W = -2433, 2243, 190 and D = -1023, 943, 78. drop = 14034
    # and 13665, drive = 10525 and 10248, and c drive / 2^27 = 558.50 and 50.19.
    ("three in a row relax in three stages", [3, 1, 1], [liquid(4096, 20000), liquid(2100, 9000), liquid(500, 3000)],
     viscous(2, "substeps = 1, stages_max = 3"), 0, [(3538, 20000), (2608, 11353), (550, 3545)], (3, 6696, 0, 0)),
    # The same numbers of stages. The middle is higher by 2 than the left, and by 450 than the right: m = 14854940 and
    # 7567587, a = 4088 and 2298, c = 14825926 and 4245682, k = 7237 and 2071. I_1 = 16361, 16383 and 11583: 2 and 151.
    # D = 3, -230, 226. I_2 = 49091, 48922 and 34978: 18 of d = 169 come back, and 440 of 13944 flow on. W = -84, -2569, 2653
    # and D = -25, -1087, 1110. The drops are -934 and 26603: drive = 700 and 19952, and 77.32 come back, 631.14 flow on.
    ("a relaxed pair flows back", [3, 2, 1], [liquid(4080, 20000), liquid(4096, 9000), liquid(500, 3000)] + [AIR] * 3,
     viscous(2, "substeps = 1, stages_max = 3"), 0,
     [(4003, 20000), (3542, 9239), (1131, 6347)] + [(0, 0)] * 3, (3, 8676, 0, 0)),
    # The same without the air: the left and the middle are shut. So 151 of 4800 are levelled and then 440 of 13947, between
    # the middle and the right alone: W = -453, 453 and -2653, 2653, D = -1112 and 1110. drop = 28800 - 2222 = 26578,
    # drive = 19933, and c drive / 2^27 = 630.54. Its heat: (500 x 3000 + 630 x 9000) / 1130 = 6345.1.
    ("two shut cells do not relax", [3, 1, 1], [liquid(4080, 20000), liquid(4096, 9000), liquid(500, 3000)],
     viscous(2, "substeps = 1, stages_max = 3"), 0, [(4080, 20000), (3466, 9000), (1130, 6345)], (3, 8676, 0, 0)),
    # N = 14, but two stages at most. The left limit is 4369 x 3 >> 2 = 3276, and its mobility 1024 x 3276 = 3354624. Below,
    # m = 7082894 is cut to 2048 x 3276 = 6709248: c is the same, k = 6551. I_1 = 43690 and 32767, and d = 10923 is cut to
    # 10922: 1091 are levelled. D = -1637 and 1636, drop = 29495, drive = 22121, and c drive / 2^27 = 1105.8, cut to a
    # fifth: 819. Above, the taker shows the limit of the run below: m = 2097152 + 3728270 is cut to 1024 (3276 x 43690 >> 16)
    # = 1024 x 2183, a = 2048, c = 1117696, drop = 64 x 512, drive = 24576, and c drive / 2^27 + D(1) / 65536 = 205.2.
    ("a taker on top of a run does not relax", [2, 2, 1], [liquid(4096, 20000), liquid(4096, 9000), liquid(4096, 20000), AIR],
     viscous(1, "substeps = 1, stages_max = 2"), 0,
     [(3277, 20000), (4915, 10832), (3891, 20000), (205, 20000)], (3, 12288, 2, 8192)),
    # N = 14, but three stages at most; n = 2. The limits are 3276, 4914 and 4914, and cut two mobilities to 6709248 and
    # 10063872. On the left m = 16773120 is cut to 4096 x 3276. Below a = 4096: c = 13418496 and 15619413, k = 2 x 6551 and
    # 2 x 7623. Above a = 4000 and 2404: c = 13104000 and 9167253, k = 2 x 6397 and 2 x 4474. The heads less 512 (y - 2) are
    # 2048, 2024, 1649 below, and 512 less above. Stage 2 levels 51 and 930 below, 49 and 546 above; stage 3 401, 2160, 281
    # and 1424. D = -797, -5129, 5923 below and -592, -3148, 3737 above. drop = 5868, 12948, 4092 and 17115,
    # drive = 4401, 9711, 3069 and 12836. Below R = D(1), above D(1) + D(1) - 65536 = 0: w = 440.5, 1130.6, 299.6 and 876.7.
    # 1130 is cut to 819, a fifth of 4096, and 876 to 780, a fifth of 3904.
    ("each layer relaxes by itself", [3, 2, 1],
     [liquid(4096, 20000), liquid(4096, 9000), liquid(4096, 3000), liquid(4096, 20000), liquid(3904, 9000), liquid(904, 3000)],
     viscous(1, "substeps = 1, stages_max = 3"), 1,
     [(3656, 20000), (3717, 10302), (4915, 4000), (3797, 20000), (3423, 9961), (1684, 5779)], (6, 21192, 4, 16192)),
    # Under a ceiling M = 81919 and 77919: both limits are 13107 / 20 = 655, then 491, and m = 2048 x 491 = 1005568. Below the
    # top a = 4096: c = m, and k = 5 x 981 = 4905; I_1 differ by 10666 or 10667, and 798 are levelled. D = -1197 and 1197,
    # drop = 32000 - 2394 = 29606, drive = 22204, and c drive / 2^27 = 166.35; D(1) and D(2) add 0.5 and 0.25, D(3) 0.75. In
    # the top a = 127070 >> 1 = 63535, c = 15597842, and k = 5 x 15231 is cut to 65535: 10665 of 10666, so that
    # D = -15998 and 15997, drop = 5, drive = 3 and w = 0.47.
    ("a pair levels no more than its difference", [2, 5, 1],
     [liquid(4096, 20000), liquid(4096, 9000)] * 4 + [liquid(65535, 20000), liquid(61535, 9000)],
     viscous(1, "stiffness = 1, substeps = 1, stages_max = 2"), 0,
     [(3930, 20000), (4262, 9428)] * 3 + [(3929, 20000), (4263, 9430), (65535, 20000), (61535, 9000)],
     (10, 159838, 10, 159838)),
    # N = 5 and K = 2, so that two stages do. The first sub-step is that of the first case, but R = 16384: w = 331.8, and the
    # heat is 14550 with B = 0. Then m = 3149995 + 95630, c = 1751971, k = 1709, I_1 = 31871 and 23594: 215 are levelled.
    # drop = 24187, drive = 18140, R = 49152 and w = 237.5.
    ("two sub-steps of two stages", [2, 1, 1], [liquid(4096, 20000), liquid(325, 9000)],
     viscous(2, 'substeps = "auto", substeps_max = 2, stages_max = 16'), 1, [(3528, 20000), (893, 15996)], (4, 8842, 0, 0)),
    # m = 3728270 + 1000619, a = 3109, c = 3589383. The k of a diagonal is a quarter: (3505 x 16384 >> 16) x 43690 >> 16 =
    # 583. The heads less 512 (y - 2) are 1280 and 1033. I_1 = 27306 and 22036: 46 are levelled, D = -69 and 69, drop =
    # 15670 and drive = 7835. R = D(1, 3, 4) + D(1) = 49152: ((c drive >> 10) + 8 R) / 2^19 = 53.1.
    ("a diagonal relaxes", *DIAGONAL, viscous(1, "substeps = 1, stages_max = 2"), 1,
     [(0, 0), (2175, 7560), (4043, 30000)], (2, 6218, 0, 0)),
    # Nothing relaxes, and exposed alone counts: (2^21 x 2048 >> 12) x 24576 / 2^27 = 192 below. Above no bed shows:
    # c = 2^21, w = 384 + D(1) / 65536, which fall on what came below.
    ("a flank does not relax", [2, 2, 1], [liquid(4096, 7), AIR, liquid(4096, 7), AIR],
     viscous(1, "substeps = 1, stages_max = 2"), 0, [(3904, 7), (576, 7), (3712, 7), (0, 0)]),
    # lack = 15000 and 10000: part = 2 x 15000 x 6711 >> 16 = 3072 and 2048, of 4000 and 3000: b + 2048 = 3000 and 1500.
    # Beds 375 and 187: t = 11 - 5 = 6, drop = 188, s = 12593 + 4 (12593 >> 3) = 18889, drive = 18889 x 188 >> 10 = 3467.
    # Both mobilities are 256 x 6553, so c = 3355136, and (3355136 x 3467 + 1024 D(1)) >> 26 = 173.
    ("beds melt from above", [2, 3, 1],
     [solid(4000, 25000), solid(3000, 30000), liquid(4096, 7), liquid(4096, 7), AIR, AIR],
     MELTING + viscous(1), 0, [(4000, 25000), (3000, 30000), (3923, 7), (4269, 7), (0, 0), (0, 0)]),
    # On the left b = 0, bed 256, and head 768. On the right part = 2048 of 5000, so b = 452, and the air shows head and bed
    # 512 - 200 = 312: t = 9 - 8 = 1, drop = 456, drive = 24384 x 456 >> 10 = 10858. m is exposed alone, 2^21:
    # (2^21 x 10858 + 1024 D(1)) >> 26 = 339.
    ("air above a solid that melts", [2, 2, 1], [("inert", 0, 0), solid(5000, 30000), liquid(4096, 7), AIR],
     MELTING + viscous(1), 0, [(5000, 30000), (3757, 7), (339, 7)]),
    # L = 0: W = ONE, k = 3, w = 32768 and scale = 8192. Tm = 32768, lack = 1024 and 1: part = 1024 and 1, and beds 128 and
    # 0. t = 4, drop = 128, s = 14512 + 4 (14512 >> 3) = 21768, drive = 21768 x 128 >> 10 = 2721, and
    # (3355136 x 2721 + 1024 D(1)) >> 26 = 136.
    ("without latent heat a solid melts over the last of its heat", [2, 3, 1],
     [solid(4096, 31744), solid(4096, 32767), liquid(4096, 7), liquid(4096, 7), AIR, AIR],
     "material = { melting_point = 0.500008 }\n" + viscous(1), 0,
     [(4096, 31744), (4096, 32767), (3960, 7), (4232, 7), (0, 0), (0, 0)]),
    # All of it lacks, but 6143 counts: b = 4095, and the air shows 767. On the left the bed is 736 and the head 1248.
    # t = 23 - 23 = 0: a = 4097 >> 1, c = 2^20, drive = 24 x 481 = 11544, and (2^20 x 11544 + 1024 D(1)) >> 26 = 180.
    ("without heat a solid is whole", [2, 2, 1], [HIGH, solid(65535, 0), liquid(4096, 0), AIR],
     viscous(1).split("heat =")[0], 0, [(65535, 0), (3916, 0), (180, 0)]),
    # power / 256 is 0.0012 x 65535 x 16 = 1258. I = 1258, 4096 x 1258 / 1000 = 5152, / 10000 = 515, and 65535 in the last.
    # The gains are I / 16, rounded down by D(0): 78, 322, 32 and 4095.
    ("less matter warms faster in the light", [4, 1, 1], [solid(4096, 100), solid(1000, 100), solid(10000, 100), solid(1, 100)],
     sunlit(0.0012), 0, [(4096, 178), (1000, 422), (10000, 132), (1, 4195)]),
    # The sum is cut before it is divided: 4096 x 65535 / 20000 = 13421, and the gain is 838.
    ("strong light is cut before the amount divides it", [1, 1, 1], [solid(20000, 100)], sunlit(1), 0, [(20000, 938)]),
]


def write_field(path, code, size, values):
    header = f"{{'descr': '{'|u1' if code == 'B' else '<u2'}', 'fortran_order': False, 'shape': {tuple(size[::-1])}, }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
                     + struct.pack(f"<{len(values)}{code}", *values))


def read_field(path):
    data = path.read_bytes()
    begin = 10 + struct.unpack("<H", data[8:10])[0]
    return struct.unpack(f"<{(len(data) - begin) // 2}H", data[begin:])


def write_scene(folder, size, cells, rules, first):
    (folder / "fields").mkdir()
    for name, code in FIELDS.items():
        values = {"amount": [cell[1] for cell in cells], "heat": [cell[2] for cell in cells], "energy": [0] * len(cells)}
        write_field(folder / "fields" / f"{name}.npy", code, size,
                    values.get(name, [int(cell[0] == name) for cell in cells]))
    scene = folder / "scene.toml"
    scene.write_text(f'grid = {{ size = {size} }}\nstart = {{ fields = "fields", step = {first} }}\n{rules}')
    return scene


def amounts_and_heats(folder):
    return list(zip(read_field(folder / "amount.npy"), read_field(folder / "heat.npy")))


def by_oracle(oracle, folder):
    """(amount, heat) of all cells after a step, and the counters."""
    lines = subprocess.run([oracle, folder / "start", "--steps", "1", "--ledger", "--fields", folder / "judged"], check=True,
                           capture_output=True, text=True).stdout.splitlines()
    counters = next(tuple(int(n) for n in line.split()[1:]) for line in lines if line.startswith("counters"))
    return amounts_and_heats(folder / "judged"), counters


def by_voxmelt(voxmelt, implementation, folder, scene):
    """The same of this implementation."""
    one_step = [scene, "--steps", "1", "--quiet", "--implementation", implementation]
    fields, report = folder / implementation, folder / f"{implementation}.json"
    subprocess.run([voxmelt, "export", *one_step, "--out", fields], check=True)
    subprocess.run([voxmelt, "digest", *one_step, "--report", report], check=True, stdout=subprocess.DEVNULL)
    limit = json.loads(report.read_text())["limit"]
    counters = tuple(int(limit[key]) for key in ("cells", "mass", "limited_cells", "limited_mass"))
    return amounts_and_heats(fields), counters


def after_one_step(voxmelt, oracle, names, folder, scene):
    """The parameters, and what the oracle and the implementations of these names find."""
    subprocess.run([voxmelt, "export", scene, "--quiet", "--steps", "0", "--out", folder / "start"], check=True)
    found = {name: by_voxmelt(voxmelt, name, folder, scene) for name in names}
    found["oracle"] = by_oracle(oracle, folder)
    return json.loads((folder / "start" / "parameters.json").read_text()), found


def main():
    voxmelt, oracle = sys.argv[1:3]
    names = of_hand_tests(voxmelt, sys.argv)
    wrong = 0
    for name, size, cells, rules, first, expected, *counted in CASES:
        with tempfile.TemporaryDirectory() as folder:
            scene = write_scene(Path(folder), size, cells, rules, first)
            parameters, found = after_one_step(voxmelt, oracle, names, Path(folder), scene)
        by_hand = expected(parameters) if callable(expected) else expected
        for program, (state, _) in found.items():
            not_inert = [pair for pair, cell in zip(state, cells) if cell[0] != "inert"]
            if not_inert != by_hand:
                wrong += 1
                print(f"{name}:\n  {program} {not_inert}\n  by hand {by_hand}")
        for by_hand in counted:
            by_hand = by_hand(parameters) if callable(by_hand) else by_hand
            for program, (_, counters) in found.items():
                if counters != by_hand:
                    wrong += 1
                    print(f"{name}: the counters of {program} are {counters}, by hand {by_hand}")
    if wrong:
        sys.exit(1)
    print(f"{len(CASES)} states are as by hand")


main()
