// Spreading follows the paper's law (Eqs. 7-20): a giver's share, its available directions, its energy.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

VOXMELT_RULE std::int32_t thermal_share(std::int32_t share, std::int32_t h, const Flow& flow) {
  if (!flow.thermal_viscosity) return share;
  return std::min((share * std::int32_t{flow.mobility_table[h >> 11]}) >> 15,
                  largest_share(flow.paper.neighbours));
}

// Returns factor x A, capped. A diagonal takes a quarter of it.
VOXMELT_RULE std::int32_t shared(std::int32_t a, std::int32_t share, std::int32_t cap, bool diagonal) {
  const std::int32_t f = std::min(scaled(a, share), cap);
  return diagonal ? f >> 2 : f;
}

// Returns by how much a neighbour must hold less than its giver. A cell with energy spreads down to `margin`.
// A starved one yields only where the difference exceeds `slump`. With a negative result the cell does not
// spread at all.
VOXMELT_RULE std::int32_t spread_margin(std::int32_t energy, const PaperLaw& law) {
  if (energy > law.threshold) return law.margin;
  return law.slump > 0 ? std::int32_t{law.slump} : -1;
}

// Tells if a giver with amount a and axis flow f may give to a neighbour with amount b. On a diagonal the
// margin is 9/8 as large. Then piles at rest are as long along the axes as along the diagonals.
VOXMELT_RULE bool receives(std::int32_t a, std::int32_t f, std::int32_t b, std::int32_t margin, bool diagonal,
                           const PaperLaw& law) {
  if (b >= receiver_limit(law.neighbours)) return false;
  return !law.downhill || b + std::max(f, diagonal ? (9 * margin) >> 3 : margin) < a;
}

VOXMELT_RULE std::int32_t contact_alpha(bool solid_below, bool inert_below, const PaperLaw& law) {
  return inert_below ? law.alpha_floor : solid_below ? law.alpha_solid : law.alpha_liquid;
}

}  // namespace voxmelt::rule
