// This file is compiled once for each instruction set.
#include "kernel/engine/cpu/own_lanes.h"
#include "measure/lane_loops_for.h"

namespace voxmelt::measure {

template LaneLoops loops_for<cpu::OwnArch>();

}  // namespace voxmelt::measure
