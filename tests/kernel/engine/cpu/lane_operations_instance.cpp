// This file is compiled once for each instruction set.
#include "kernel/engine/cpu/own_lanes.h"
#include "tests/kernel/engine/cpu/lane_loops.h"

namespace voxmelt::cpu {

template Operations operations_for<OwnArch>();

}  // namespace voxmelt::cpu
