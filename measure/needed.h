// A step of a scene must at least write the vectors in which a phase changes a cell. Any program that works
// by such vectors writes each of them. At the speed of a full volume, with perfect scaling over the threads,
// this is the shortest time that sleeping and scheduling can reach.
#pragma once

#include <optional>
#include <vector>

#include "kernel/engine/cpu/instruction_set.h"
#include "measure/measure.h"

namespace voxmelt::measure {

// Counts the vectors of a step, in the mean of the timed steps.
struct Needed {
  double gravity = 0, spread = 0, heat = 0;  // spread includes excess, heat includes melt
};

// Returns the 16-bit lanes of a vector. The narrowest set has 8, and each next one has twice as many.
constexpr int lanes_of(cpu::InstructionSet set) { return 8 << static_cast<int>(set); }

// Counts for vectors of each of these lengths. The reference runs the workload's steps.
std::vector<Needed> needed_vectors(const Workload& workload, const std::vector<int>& lanes);

// Holds one thread's time in a full volume: seconds of a step, and its cells.
struct FullVolume {
  Seconds step;
  double cells = 0;
};

struct LeastSeconds {
  double flow = 0;
  std::optional<double> heat;  // conduction alone
};

// Gives the least seconds under the paper's law. In `flow` every cell is liquid and in motion, with gravity
// timed apart from spread. In `heat` every cell is solid.
LeastSeconds least_seconds(const Needed& needed, int lanes, int threads, const FullVolume& flow,
                           const std::optional<FullVolume>& heat);

}  // namespace voxmelt::measure
