// The third column of the paper's Table 1 is the cost of a new state before it can be drawn.
#pragma once

#include "kernel/scene/look.h"
#include "measure/measure.h"

namespace voxmelt::measure {

// Returns the least seconds of DensityField::update after one more step of the workload, with the candidate's
// threads.
double update_seconds(const Workload& workload, const scene::Look& look, const scene::Terrain& terrain,
                      const Candidate& candidate, const Rounds& rounds);

// Returns the same for the plain baseline: intensities and their low-pass filter, the whole grid.
double baseline_update_seconds(const Workload& workload, const Rounds& rounds);

}  // namespace voxmelt::measure
