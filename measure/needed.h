// What a step of a scene must do at least, in vectors: those in which a phase changes a cell. Whoever works
// by such vectors writes each of them. At the speed of a full volume, with perfect scaling over the threads,
// this is the shortest time that sleeping and scheduling can reach.
#pragma once

#include <optional>
#include <vector>

#include "kernel/engine/cpu/instruction_set.h"
#include "measure/measure.h"

namespace voxmelt::measure {

// Vectors of a step, the mean of the timed steps.
struct Needed {
  double gravity = 0, spread = 0, heat = 0;  // spread: with excess; heat: with melt
};

// 16-bit lanes of a vector: the narrowest set has 8, and each twice as many as the one before.
constexpr int lanes_of(cpu::InstructionSet set) { return 8 << static_cast<int>(set); }

// For vectors of each of these lengths. The reference runs the workload's steps.
std::vector<Needed> needed_vectors(const Workload& workload, const std::vector<int>& lanes);

// One thread in a full volume: seconds of a step, and its cells.
struct FullVolume {
  Seconds step;
  double cells = 0;
};

struct LeastSeconds {
  double flow = 0;
  std::optional<double> heat;  // conduction alone
};

// Under the paper's law. `flow`: every cell liquid and in motion, gravity timed apart from spread. `heat`:
// every cell solid.
LeastSeconds least_seconds(const Needed& needed, int lanes, int threads, const FullVolume& flow,
                           const std::optional<FullVolume>& heat);

}  // namespace voxmelt::measure
