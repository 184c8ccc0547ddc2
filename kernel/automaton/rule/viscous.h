// The viscous law gives settled runs of liquid free-surface heads and a lubrication mobility.
//
// A run is the contiguous liquid standing on a solid. Heads are in 1/512 cell from the grid's bottom.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/rule/relax.h"

namespace voxmelt::rule {

inline constexpr std::int32_t kHeadOne = 512;
inline constexpr std::int32_t kRunHalf = kOne / 2;
inline constexpr std::int32_t kNoBed = -1;  // bed of a cell in the air

// Tells if the run goes on above n cells that hold the sum `mass`. The uppermost holds `top`, the next one
// `next`.
VOXMELT_RULE bool run_continues(std::int64_t mass, std::int32_t n, std::int32_t top, std::int32_t next) {
  return mass > std::int64_t{n} * kOne || (top >= kRunHalf && next > 0);
}

// Returns the settled amount of cell k of a run of n cells with sum `mass`. Cells are full from the bottom.
// Liquid that does not fit below a ceiling is stacked from the top cell down.
VOXMELT_RULE std::int32_t settled(std::int64_t mass, std::int32_t n, std::int32_t k) {
  const std::int64_t over = std::max<std::int64_t>(0, mass - std::int64_t{n} * kOne);
  const std::int64_t base = std::clamp<std::int64_t>(mass - std::int64_t{k} * kOne, 0, kOne);
  constexpr std::int64_t headroom = kAmountMax - kOne;
  const std::int64_t stacked = std::clamp<std::int64_t>(over - headroom * (n - 1 - k), 0, headroom);
  return static_cast<std::int32_t>(base + stacked);
}

// Returns how many cells of that run hold something then.
VOXMELT_RULE std::int32_t settled_cells(std::int64_t mass, std::int32_t n) {
  return static_cast<std::int32_t>(std::min<std::int64_t>(n, (mass + kOne - 1) / kOne));
}

// Tells if a run is shut: it is under a ceiling and full, but for 1/64 of a cell. Shut runs give each other
// nothing. For no column says what another one's ceiling carries, and heads alone would squeeze the liquid of
// a vault out of its top.
VOXMELT_RULE bool is_shut(std::int64_t mass, std::int32_t n, bool under_ceiling) {
  const std::int64_t excess = mass - std::int64_t{n} * kOne;
  return under_ceiling && -kOne / 64 <= excess && excess <= kOne / 64;
}

// Heat moves through the faces of a run when it settles. The excess at the face above cell k is what cells
// 0..k hold beyond ONE each, before settling. Up to kMostExcess, no cell holds more than kAmountMax while the
// parts move.
inline constexpr std::int64_t kMostExcess = kAmountMax - kOne;

VOXMELT_RULE std::int64_t face_excess(std::int64_t mass_below, std::int32_t k) {
  return mass_below - (std::int64_t{k} + 1) * kOne;
}
VOXMELT_RULE bool keeps_order_at(std::int64_t excess) {
  return -kMostExcess <= excess && excess <= kMostExcess;
}
// Amounts pass that face first upwards from cell k, then downwards into it. `mass` is the whole run's.
VOXMELT_RULE std::int32_t settles_up(std::int64_t excess) {
  return static_cast<std::int32_t>(std::max<std::int64_t>(0, excess));
}
VOXMELT_RULE std::int32_t settles_down(std::int64_t mass, std::int64_t mass_below, std::int32_t k) {
  const std::int64_t settled_below = std::min((std::int64_t{k} + 1) * kOne, mass);
  return static_cast<std::int32_t>(std::max<std::int64_t>(0, settled_below - mass_below));
}

// Holds what a cell shows to its neighbours.
struct Column {
  std::int32_t head;      // 1/512 cell
  std::int32_t mobility;  // 1/2^24, towards a cell in a run; limited by the depth
  std::int32_t exposed;   // 1/2^24, towards a cell outside a run: a bare flank, limited per cell only
  std::int32_t dead;      // head differences up to this do not move it (yield stress; at least one unit)
  bool in_run;
  std::int32_t bed = kNoBed;  // 1/16 cell from the grid's bottom
  std::int32_t limit = 0;     // 1/2^(16 - bits), bound of the mobility; 0: no run here or below
  bool limited = false;       // the limit has cut the mobility
};

VOXMELT_RULE std::int32_t bed_head(int y, std::int32_t bed_amount) {
  return y * kHeadOne + ((bed_amount - kBedHalf) >> 3);
}

// These are the dithers of sub-step k of n. With a pair's dither, n sub-steps at a steady flux round as one
// step does (Hermite's identity). The layers of a run, by their height y, round in turn. No two dithers of a
// mixture are alike, and that of sub-step 0 is the step's.
VOXMELT_RULE std::int32_t pair_dither(std::uint32_t step, int axis, int y, int k, int n) {
  const std::int32_t offset = (dither(step, axis, 4) + dither(y)) & 0xFFFF;
  return (offset + 65536 * ((k + axis * n / 4) % n)) / n;
}
VOXMELT_RULE std::int32_t mixing_dither(std::uint32_t step, int k) {
  return (dither(step) + dither(k)) & 0xFFFF;
}

// Returns the mobility (below 2^40) times 2^(x / 65536), but for 0.4 %. A parabola stands for the power of
// the fraction.
VOXMELT_RULE std::int64_t warmed(std::int64_t mobility, std::int32_t h, const Flow& flow) {
  const std::int32_t octaves = ((h - flow.mobility_reference) * flow.mobility_rate) >> 6;  // in 1/65536
  const std::int32_t x = std::clamp(octaves, -(1 << 21), (1 << 19) - 1);
  const std::uint32_t f = x & 0xFFFF;
  const std::uint32_t power = 4096 + ((f * (43057 + ((22479 * f) >> 16))) >> 20);
  return (mobility * power) >> (12 - (x >> 16));
}

// Returns the mobility kq M^2, in 1/2^24 and without a limit, in one of n sub-steps. The run has the sum
// `mass` and the heat content h.
VOXMELT_RULE std::int64_t run_mobility(std::int64_t mass, std::int32_t h, const Flow& flow, int substeps) {
  const std::uint64_t n = substeps;
  const std::uint64_t pace = (flow.viscous.mobility + n / 2) / n;
  const std::uint64_t depth = std::min<std::int64_t>(mass, 64 * kOne);
  std::int64_t mobility = (pace * (depth * depth >> 8) + (1 << 23)) >> 24;
  return flow.thermal_viscosity ? warmed(mobility, h, flow) : mobility;
}
// Limits the mobility, in 1/2^(16 - bits). So a column gives at most a fifth of a cell of height to another
// column, in each of the sub-steps that a relaxation stands for.
VOXMELT_RULE std::int32_t run_limit(std::int64_t mass, std::int64_t over, const ViscousLaw& law,
                                    Relaxation relaxation = {}) {
  const std::int64_t one = 13107 / ((mass >> 12) + 1) / (over > 0 ? law.stiffness : 1);
  const std::int64_t limit = (one * relaxation.reach()) >> relaxation.bits();
  return static_cast<std::int32_t>(std::max<std::int64_t>(1, limit));
}
// Returns the number of sub-steps with which no limit cuts the mobility of this run.
VOXMELT_RULE std::int64_t needed_substeps(std::int64_t mass, std::int32_t n, std::int32_t h,
                                          const Flow& flow) {
  const std::int64_t over = std::max<std::int64_t>(0, mass - std::int64_t{n} * kOne);
  const std::int64_t limit = std::int64_t{run_limit(mass, over, flow.viscous)} << 8;
  return (run_mobility(mass, h, flow, 1) + limit - 1) / limit;
}

// Returns what a run of n cells with sum `mass` and mean heat content h shows. Its bed is at `bed`.
VOXMELT_RULE Column run_column(std::int64_t mass, std::int32_t n, std::int32_t bed, std::int32_t h,
                               const Flow& flow, int substeps = 1, Relaxation relaxation = {}) {
  const ViscousLaw& law = flow.viscous;
  const std::int64_t over = std::max<std::int64_t>(0, mass - std::int64_t{n} * kOne);
  const auto depth = static_cast<std::int32_t>(std::max<std::int64_t>(1, mass >> 4));
  const std::int64_t dead = (2 * static_cast<std::int64_t>(law.yield) + depth / 2) / depth;
  const std::int64_t mobility = run_mobility(mass, h, flow, substeps);

  Column column{};
  column.head =
      bed + static_cast<std::int32_t>(mass >> 3) + (law.stiffness - 1) * static_cast<std::int32_t>(over >> 3);
  column.limit = run_limit(mass, over, law, relaxation);
  const std::int64_t most = std::int64_t{column.limit} << (8 + relaxation.bits());
  column.limited = mobility > most;
  column.mobility = static_cast<std::int32_t>(std::min(mobility, most));
  column.exposed = static_cast<std::int32_t>(std::min<std::int64_t>(mobility, 1 << 21));
  column.dead = static_cast<std::int32_t>(std::max<std::int64_t>(1, dead));
  column.in_run = true;
  column.bed = bed >> 5;
  return column;
}

// These columns are of a cell outside a run: on a bed, on top of a run (`below`), or in the air.
VOXMELT_RULE Column bed_column(std::int32_t bed) { return {bed, 0, 0, 0, false, bed >> 5}; }
VOXMELT_RULE Column top_column(const Column& below) {
  return {below.head, below.mobility, 0, 0, false, below.bed, below.limit};
}
VOXMELT_RULE Column air_column(int y) { return {(y - 2) * kHeadOne, 0, 0, 0, false}; }

// A film on a slope S carries 1 / (1 + S^2)^2 of what it carries on level ground, in every direction to the
// grid. A pair knows the difference of its own two beds, and another one across. For an axis that is, of the
// rises beside it on a walk across, the largest up less the largest down. For a diagonal it is that of its
// corners. All are in 1/16 cell.
inline constexpr std::int32_t kSteepest = 31;

// Returns how far two beds differ, or 0 where one of them is none.
VOXMELT_RULE std::int32_t bed_rise(std::int32_t bed, std::int32_t other) {
  const bool sloped = bed != kNoBed && other != kNoBed;
  return sloped ? std::min(kSteepest, std::max(bed - other, other - bed)) : 0;
}
// Returns the factor in 1/16384. A diagonal to a blocked cell carries nothing. Its share goes to the axes
// along it, an eighth of an axis each. `blocked_beside` counts the blocked cells of the four beside an axis
// pair. It is 0 for a diagonal.
VOXMELT_RULE std::int32_t slope_factor(std::int32_t along, std::int32_t across, bool diagonal,
                                       int blocked_beside) {
  const std::int32_t square = (along * along + across * across) >> (diagonal ? 1 : 0);  // in 1/256
  const std::int32_t root = (1 << 22) / (256 + std::min(511, square));
  const std::int32_t factor = (root * root) >> 14;
  return factor + blocked_beside * (factor >> 3);
}

// Returns the amount that flows at a drop. Between level beds it is the mean of both cells, since the face
// lies between the columns. On a slope the two cells lie at different depths of their runs, so the giver's
// alone counts.
VOXMELT_RULE std::int32_t flowing_amount(const Column& giver, std::int32_t a, const Column& taker,
                                         std::int32_t b) {
  return giver.bed != kNoBed && giver.bed == taker.bed ? (a + b + 1) >> 1 : a;
}

// Tells if `giver` stands in a run, and so much higher than `taker` that it gives.
VOXMELT_RULE bool gives(const Column& giver, const Column& taker, bool diagonal) {
  const std::int32_t dead = diagonal ? (giver.dead * 11) >> 3 : giver.dead;
  return giver.in_run && giver.head - taker.head > dead;
}
// Returns the limit of both mobilities together. Only heads of runs relax, so a taker that stands on a run
// gets no more than one sub-step of many would give it.
VOXMELT_RULE std::int64_t most_mobility(const Column& giver, const Column& taker, Relaxation relaxation) {
  const int bits = relaxation.bits();
  if (taker.in_run || !relaxation.relaxes()) return std::int64_t{giver.limit} << (9 + bits);
  return std::max<std::int64_t>(1, (std::int64_t{giver.limit} * relaxation.scale()) >> (14 + bits))
         << (8 + bits);
}
// Returns what flows at a drop of two cells, in 1/2^24 cell. Half of it flows at a drop of one.
VOXMELT_RULE std::int64_t conductance(const Column& giver, std::int32_t a, const Column& taker,
                                      std::int32_t b, Relaxation relaxation = {}) {
  std::int64_t mobilities = std::int64_t{taker.in_run ? giver.mobility : giver.exposed} + taker.mobility;
  if (taker.limit > 0) mobilities = std::min(mobilities, most_mobility(giver, taker, relaxation));
  const std::int64_t flowing = flowing_amount(giver, a, taker, b);
  return std::min<std::int64_t>((std::int64_t{1} << (24 + relaxation.bits())) - 1,
                                (mobilities * flowing) >> 12);
}
// Limits what flows by what the giver has and the taker has room for: a fifth; in all 4/5 + 4/20.
VOXMELT_RULE std::int32_t most_flow(std::int32_t a, const Column& taker, std::int32_t b, bool diagonal) {
  const std::int32_t room = std::max(0, (taker.in_run ? kAmountMax : kOne) - b);
  const std::int32_t most = scaled(std::min(a, room), 13107);
  return diagonal ? most >> 2 : most;
}

// Returns the flow from `giver` (amount a) to `taker` (amount b). It is 0 unless the giver stands higher and
// in a run.
VOXMELT_RULE std::int32_t viscous_flow(const Column& giver, std::int32_t a, const Column& taker,
                                       std::int32_t b, bool diagonal, std::int32_t dither,
                                       int blocked_beside = 0, std::int32_t across = 0) {
  if (!gives(giver, taker, diagonal)) return 0;
  const std::int32_t drop = std::min(giver.head - taker.head, diagonal ? 724 : kHeadOne);
  const std::int32_t slope = slope_factor(bed_rise(giver.bed, taker.bed), across, diagonal, blocked_beside);
  const std::int64_t drive = (slope * drop) >> 10;  // 1/8192 cell
  const std::int64_t product = conductance(giver, a, taker, b) * drive, offset = dither;
  const auto wanted = static_cast<std::int32_t>(diagonal ? (product + (offset << 12)) >> 28
                                                         : (product + (offset << 10)) >> 26);
  return std::min(wanted, most_flow(a, taker, b, diagonal));
}

// Returns the same flow where heads relax. If both are in a run, `fall` counts: by how much the giver's
// relaxed head is above the taker's, in 1/32768 cell. It may be below 0. Then the liquid flows back, and so
// does the result.
VOXMELT_RULE std::int32_t relaxed_flow(const Column& giver, std::int32_t a, const Column& taker,
                                       std::int32_t b, bool diagonal, std::int32_t dither, int blocked_beside,
                                       std::int32_t fall, Relaxation relaxation, std::int32_t across = 0) {
  if (!gives(giver, taker, diagonal)) return 0;
  const std::int32_t most = (diagonal ? 724 : kHeadOne) * (kRelaxedOne / kHeadOne);
  const std::int32_t own = std::min(giver.head - taker.head, 1024) * (kRelaxedOne / kHeadOne);
  const bool back = taker.in_run && fall < 0;
  const std::int64_t drop = std::min(taker.in_run ? (back ? -fall : fall) : own, most);
  const std::int32_t slope = slope_factor(bed_rise(giver.bed, taker.bed), across, diagonal, blocked_beside);
  const std::int64_t drive = (2 * slope * drop) >> 16;  // 1/16384 cell
  const int bits = relaxation.bits();
  const std::int64_t product = (conductance(giver, a, taker, b, relaxation) * drive) >> (8 + bits);
  const std::int64_t offset = (std::int64_t{dither} << (diagonal ? 5 : 3)) >> bits;
  const std::int64_t wanted = (product + offset) >> ((diagonal ? 21 : 19) - bits);
  if (back)
    return -static_cast<std::int32_t>(std::min<std::int64_t>(wanted, most_flow(b, giver, a, diagonal)));
  return static_cast<std::int32_t>(std::min<std::int64_t>(wanted, most_flow(a, taker, b, diagonal)));
}

// Returns the flow from one cell to the other. It is below 0 if it goes back. `fall` is by how much the first
// one's relaxed head is higher.
VOXMELT_RULE std::int32_t flow_between(const Column& one, std::int32_t a, const Column& other, std::int32_t b,
                                       bool diagonal, std::int32_t dither, int blocked_beside,
                                       std::int32_t fall, Relaxation relaxation, std::int32_t across) {
  if (!relaxation.relaxes())
    return viscous_flow(one, a, other, b, diagonal, dither, blocked_beside, across) -
           viscous_flow(other, b, one, a, diagonal, dither, blocked_beside, across);  // one of them is 0
  return relaxed_flow(one, a, other, b, diagonal, dither, blocked_beside, fall, relaxation, across) -
         relaxed_flow(other, b, one, a, diagonal, dither, blocked_beside, -fall, relaxation, across);
}

}  // namespace voxmelt::rule
