// The phases of a step and their order. This is the only place that lists them.
#pragma once

#include <array>
#include <string_view>

#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::step {

enum class Phase { source, heat, melt, gravity, spread, excess };
inline constexpr int kPhaseCount = 6;
inline constexpr std::array<std::string_view, kPhaseCount> kPhaseNames{"source",  "heat",   "melt",
                                                                       "gravity", "spread", "excess"};

// Paper law: gravity and excess are one ascending sweep, run as `gravity`; `excess` is empty.
// Viscous law: settle (`excess`), spread, fall (`gravity`).
constexpr std::array<Phase, kPhaseCount> phase_order(rule::Law law) {
  using enum Phase;
  if (law == rule::Law::paper) return {source, heat, melt, gravity, spread, excess};
  return {source, heat, melt, excess, spread, gravity};
}

}  // namespace voxmelt::step
