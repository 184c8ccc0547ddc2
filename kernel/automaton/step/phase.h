// The phases of a step and their order are listed in this place only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/seconds.h"

namespace voxmelt::step {

using rule::index_of;

enum class Phase { source, heat, melt, gravity, spread, excess };
inline constexpr int kPhaseCount = 6;
inline constexpr std::array<std::string_view, kPhaseCount> kPhaseNames{"source",  "heat",   "melt",
                                                                       "gravity", "spread", "excess"};

// Returns the member that has the time of a phase: `seconds.*time_of(phase)`.
constexpr double state::Seconds::*time_of(Phase phase) {
  return state::Seconds::table()[index_of(phase)].value;
}
static_assert(
    [] {
      for (std::size_t i = 0; i < kPhaseNames.size(); ++i)
        if (state::Seconds::table()[i].name != kPhaseNames[i]) return false;
      return true;
    }(),
    "state::Seconds has the phases in the order of Phase");

// Under the paper law, gravity and excess are one ascending sweep, run as `gravity`, and `excess` is empty.
// Under the viscous law, a step settles (`excess`) and spreads once per sub-step, then falls (`gravity`).
inline std::vector<Phase> phase_order(rule::Law law, int substeps = 1) {
  using enum Phase;
  if (law == rule::Law::paper) return {source, heat, melt, gravity, spread, excess};
  std::vector<Phase> phases{source, heat, melt};
  for (int k = 0; k < substeps; ++k) phases.insert(phases.end(), {excess, spread});
  phases.push_back(gravity);
  return phases;
}

// A step of the viscous law has so many sub-steps, and in each of them heads relax by so many stages.
struct Cadence {
  int substeps = 1, stages = 1;
};

// Tells when a phase runs: in which step, and in which of its sub-steps (`excess` and `spread`, viscous law).
struct Moment {
  std::uint32_t step = 0;
  int substep = 0, substeps = 1;
  int stages = 1;       // by which heads relax in each sub-step
  bool unseen = false;  // the next phase follows at once, and may do the work of this one
  explicit Moment(std::uint32_t number) : step(number) {}
  Moment(std::uint32_t number, int the_number, Cadence cadence)
      : step(number), substep(the_number), substeps(cadence.substeps), stages(cadence.stages) {}
};

}  // namespace voxmelt::step
