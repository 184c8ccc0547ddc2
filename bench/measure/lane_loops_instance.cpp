// This file is compiled once for each instruction set.
#include "bench/measure/lane_loops_for.h"
#include "kernel/engine/cpu/own_lanes.h"

namespace voxmelt::measure {

template LaneLoops loops_for<cpu::OwnArch>();

}  // namespace voxmelt::measure
