// Gravity (Eqs. 2-6) and excess (piling) treat one face of a column at a time, ascending.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

// Returns the amount that a cell with amount a is ready to give downwards. An amount below `minimum` falls
// whole.
VOXMELT_RULE std::int32_t released(std::int32_t a, std::uint32_t factor, std::int32_t minimum) {
  const auto part = static_cast<std::int32_t>((static_cast<std::uint64_t>(a) * factor) >> 16);
  return std::min(a, part + minimum);
}

struct FallSurroundings {
  bool beside_wall;     // one of the four sides is solid, inert or the border; paper's law: before melt
  bool overhangs;       // nothing is below now, and solid, inert or the border is above or at a side
  bool clings = false;  // the cell is set, and solid, inert or the border is above or at a side
};

VOXMELT_RULE std::int32_t released(std::int32_t a, const Fall& fall, FallSurroundings at) {
  if (at.clings || (at.overhangs && a < fall.hang)) return 0;
  return released(a, at.beside_wall ? fall.wall_factor : fall.factor, fall.minimum);
}

// Returns the flow down through a face. `lower` is the amount below after its own outflow.
VOXMELT_RULE std::int32_t fallen(std::int32_t lower, std::int32_t ready) {
  return std::min(ready, std::max(0, kOne - lower));
}

// Returns the flow up through a face: the amount of `lower` above a full cell, as far as `upper` has room.
VOXMELT_RULE std::int32_t pushed_up(std::int32_t lower, std::int32_t upper) {
  return std::min(std::max(0, lower - kOne), kAmountMax - upper);
}

// Holds the energy that the giver of a vertical flow loses, and that its receiver gains.
struct EnergyMove {
  std::int32_t lost, gained;
};

// Applies the law's reading of the energy rule. The receiver can take `room` without exceeding its new
// amount.
VOXMELT_RULE EnergyMove energy_fallen(std::int32_t energy, std::int32_t flow, std::int32_t room,
                                      const PaperLaw& law) {
  const std::int32_t moved = std::min(energy, flow);
  const auto accelerated = static_cast<std::int32_t>((static_cast<std::uint64_t>(moved) * law.beta) >> 16);
  if (law.reading == EnergyReading::text) return {moved, std::min(accelerated, room)};
  const std::int32_t both = std::min({accelerated, energy, room});
  return {both, both};
}

}  // namespace voxmelt::rule
