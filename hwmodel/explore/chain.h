// Several devices in a chain share a grid. Each has one tile of it, and a memory of its own. In each pass the
// columns of the halos go over the links between neighbours, both ways at once, as soon as they are written.
// The next pass begins on all devices when they have come.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/explore/sweep.h"

namespace voxmelt::hwmodel::explore {

// Tells if a grid is cut for a chain: into a tile for each device, and no halo reaches beyond a neighbour's
// own cells.
bool is_for_chain(const Design& design, int devices);

// Returns the most bits that cross a cut in one direction in a pass.
std::int64_t halo_bits(const Design& design);

// Returns the cycles of a pass with its links. `pass` are those of the slowest device. The halos are written
// from `lag` on, and take `halos` cycles on a link, which brings each `latency` cycles later.
double linked_cycles(double pass, double lag, double halos, double latency);

// Returns the times of a run on the chain of the question's device, at several clocks.
std::vector<RunTime> times_on_chain(const PartList& parts, const Configuration& hw,
                                    const std::vector<int>& clocks, const Question& question,
                                    std::int64_t steps);

}  // namespace voxmelt::hwmodel::explore
