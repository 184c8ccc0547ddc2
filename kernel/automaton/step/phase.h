// The phases of a step and their order. This is the only place that lists them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/seconds.h"

namespace voxmelt::step {

enum class Phase { source, heat, melt, gravity, spread, excess };
inline constexpr int kPhaseCount = 6;
inline constexpr std::array<std::string_view, kPhaseCount> kPhaseNames{"source",  "heat",   "melt",
                                                                       "gravity", "spread", "excess"};

// Where the times of a run have that of a phase: `seconds.*time_of(phase)`.
constexpr double state::Seconds::*time_of(Phase phase) {
  return state::Seconds::table()[static_cast<std::size_t>(phase)].value;
}
static_assert(
    [] {
      for (std::size_t i = 0; i < kPhaseNames.size(); ++i)
        if (state::Seconds::table()[i].name != kPhaseNames[i]) return false;
      return true;
    }(),
    "state::Seconds has the phases in the order of Phase");

// Paper law: gravity and excess are one ascending sweep, run as `gravity`; `excess` is empty.
// Viscous law: settle (`excess`) and spread, so often as the step has sub-steps, then fall (`gravity`).
inline std::vector<Phase> phase_order(rule::Law law, int substeps = 1) {
  using enum Phase;
  if (law == rule::Law::paper) return {source, heat, melt, gravity, spread, excess};
  std::vector<Phase> phases{source, heat, melt};
  for (int k = 0; k < substeps; ++k) phases.insert(phases.end(), {excess, spread});
  phases.push_back(gravity);
  return phases;
}

// When a phase runs: in which step, and in which of its sub-steps (`excess` and `spread`, viscous law).
struct Moment {
  std::uint32_t step = 0;
  int substep = 0, substeps = 1;
  bool unseen = false;  // the next phase follows at once: what this one does may be put off into that one
  explicit Moment(std::uint32_t number) : step(number) {}
  Moment(std::uint32_t number, int the_number, int all) : step(number), substep(the_number), substeps(all) {}
};

}  // namespace voxmelt::step
