// The viscous law: free-surface heads and lubrication mobility of settled runs of liquid.
//
// A run is the contiguous liquid standing on a solid. Heads are in 1/256 cell from the grid's bottom.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

inline constexpr std::int32_t kHeadOne = 256;
inline constexpr std::int32_t kRunHalf = kOne / 2;
inline constexpr std::int32_t kNoBed = -1;  // of a cell in the air

// Does the run go on above n cells that hold the sum `mass`, the uppermost `top`, when the next holds `next`?
VOXMELT_RULE bool run_continues(std::int64_t mass, std::int32_t n, std::int32_t top, std::int32_t next) {
  return mass > std::int64_t{n} * kOne || (top >= kRunHalf && next > 0);
}

// Settled amount of cell k of a run of n cells with sum `mass`: full from the bottom; what does not fit below
// a ceiling is stacked from the top cell down.
VOXMELT_RULE std::int32_t settled(std::int64_t mass, std::int32_t n, std::int32_t k) {
  const std::int64_t over = std::max<std::int64_t>(0, mass - std::int64_t{n} * kOne);
  const std::int64_t base = std::clamp<std::int64_t>(mass - std::int64_t{k} * kOne, 0, kOne);
  constexpr std::int64_t headroom = kAmountMax - kOne;
  const std::int64_t stacked = std::clamp<std::int64_t>(over - headroom * (n - 1 - k), 0, headroom);
  return static_cast<std::int32_t>(base + stacked);
}

// Where heat goes when a run settles. The excess at the face above cell k is what cells 0..k hold beyond ONE
// each, before settling. Up to this one, no cell holds more than kAmountMax while the parts move.
inline constexpr std::int64_t kMostExcess = kAmountMax - kOne;

VOXMELT_RULE std::int64_t face_excess(std::int64_t mass_below, std::int32_t k) {
  return mass_below - (std::int64_t{k} + 1) * kOne;
}
VOXMELT_RULE bool keeps_order_at(std::int64_t excess) {
  return -kMostExcess <= excess && excess <= kMostExcess;
}
// Through that face: first upwards from cell k, then downwards into it. `mass` is the whole run's.
VOXMELT_RULE std::int32_t settles_up(std::int64_t excess) {
  return static_cast<std::int32_t>(std::max<std::int64_t>(0, excess));
}
VOXMELT_RULE std::int32_t settles_down(std::int64_t mass, std::int64_t mass_below, std::int32_t k) {
  const std::int64_t settled_below = std::min((std::int64_t{k} + 1) * kOne, mass);
  return static_cast<std::int32_t>(std::max<std::int64_t>(0, settled_below - mass_below));
}

struct Column {           // what a cell shows to its neighbours
  std::int32_t head;      // 1/256 cell
  std::int32_t mobility;  // 1/65536, towards a cell in a run: limited by the depth
  std::int32_t exposed;   // 1/65536, towards a cell outside a run: a bare flank, limited per cell only
  std::int32_t dead;      // head differences up to this do not move it (yield stress; at least one unit)
  bool in_run;
  std::int32_t bed = kNoBed;  // 1/16 cell from the grid's bottom
};

VOXMELT_RULE std::int32_t bed_head(int y, std::int32_t bed_amount) {
  return y * kHeadOne + ((bed_amount - kBedHalf) >> 4);
}

// Head, mobility and dead zone of a run of n cells with sum `mass`, its bed at `bed`, mean heat content h.
VOXMELT_RULE Column run_column(std::int64_t mass, std::int32_t n, std::int32_t bed, std::int32_t h,
                               const Flow& flow) {
  const ViscousLaw& law = flow.viscous;
  const std::int64_t over = std::max<std::int64_t>(0, mass - std::int64_t{n} * kOne);
  const auto depth = static_cast<std::int32_t>(std::max<std::int64_t>(1, mass >> 4));
  const std::int32_t head =
      bed + static_cast<std::int32_t>(mass >> 4) + (law.stiffness - 1) * static_cast<std::int32_t>(over >> 4);

  // Mobility kq M^2 of a column of depth M, limited so that a cell gives at most an eighth per neighbour, and
  // a column at most that to another column; only a bare flank may give it from every cell.
  const std::int64_t capped = std::min(depth, 64 * kHeadOne);
  std::int64_t mobility = (static_cast<std::int64_t>(law.mobility) * capped * capped + (1 << 19)) >> 20;
  if (flow.thermal_viscosity)
    mobility = (mobility * flow.mobility_table[static_cast<std::size_t>(h >> 11)]) >> 15;
  const std::int64_t cells = (mass >> 12) + 1;
  const std::int64_t limit = 8192 / cells / (over > 0 ? law.stiffness : 1);

  const std::int64_t dead = (static_cast<std::int64_t>(law.yield) + depth / 2) / depth;
  return {head,
          static_cast<std::int32_t>(std::min(mobility, limit)),
          static_cast<std::int32_t>(std::min<std::int64_t>(mobility, 8192)),
          static_cast<std::int32_t>(std::max<std::int64_t>(1, dead)),
          true,
          bed >> 4};
}

// A cell outside a run: on a bed, on top of a run (`below`), or in the air.
VOXMELT_RULE Column bed_column(std::int32_t bed) { return {bed, 0, 0, 0, false, bed >> 4}; }
VOXMELT_RULE Column top_column(const Column& below) {
  return {below.head, below.mobility, 0, 0, false, below.bed};
}
VOXMELT_RULE Column air_column(int y) { return {(y - 2) * kHeadOne, 0, 0, 0, false}; }

// A film on a slope carries 1 / (1 + s^2)^2 of what it carries on level ground. Axes and diagonals together
// do so in all directions, with 1 / (1 + 2 s^2) and 1 / (1 + s^2 + s^4)^2, where s is the difference of the
// pair's own two beds. In 1/16384, by 16 s.
inline constexpr std::int32_t kSteepest = 16;
using SlopeTable = std::array<std::int32_t, kSteepest + 1>;
inline constexpr std::array<SlopeTable, 2> kSlopeFactor = [] {  // [diagonal]
  std::array<SlopeTable, 2> factor{};
  for (std::int64_t t = 0; t <= kSteepest; ++t) {
    const std::int64_t axis = 256 + 2 * t * t, root = 65536 + 256 * t * t + t * t * t * t, both = root * root;
    factor[0][static_cast<std::size_t>(t)] = static_cast<std::int32_t>(((1 << 22) + axis / 2) / axis);
    factor[1][static_cast<std::size_t>(t)] =
        static_cast<std::int32_t>(((std::int64_t{1} << 46) + both / 2) / both);
  }
  return factor;
}();
VOXMELT_RULE std::int32_t slope_factor(std::int32_t bed, std::int32_t other, bool diagonal) {
  const SlopeTable& factor = kSlopeFactor[diagonal ? 1 : 0];
  if (bed == kNoBed || other == kNoBed) return factor[0];
  return factor[static_cast<std::size_t>(std::min(kSteepest, std::max(bed - other, other - bed)))];
}

// The flow from `giver` (amount a) to `taker` (amount b); 0 unless the giver stands higher and in a run.
VOXMELT_RULE std::int32_t viscous_flow(const Column& giver, std::int32_t a, const Column& taker,
                                       std::int32_t b, bool diagonal, std::int32_t dither) {
  if (!giver.in_run) return 0;
  const std::int32_t dead = diagonal ? (giver.dead * 11) >> 3 : giver.dead;
  std::int32_t drop = giver.head - taker.head;
  if (drop <= dead) return 0;
  drop = std::min(drop, diagonal ? 362 : kHeadOne);

  const std::int64_t mobilities = (taker.in_run ? giver.mobility : giver.exposed) + taker.mobility;
  const auto conductance = static_cast<std::int32_t>(std::min<std::int64_t>(65535, (mobilities * a) >> 12));
  const std::int32_t drive = (slope_factor(giver.bed, taker.bed, diagonal) * drop) >> 9;  // 1/8192 cell
  const std::int32_t wanted =
      diagonal ? (conductance * drive + (dither << 4)) >> 20 : (conductance * drive + (dither << 2)) >> 18;
  const std::int32_t room = (taker.in_run ? kAmountMax : kOne) - b;
  return std::min({wanted, a >> 3, std::max(0, room) >> 3});
}

}  // namespace voxmelt::rule
