// This file is compiled once for each instruction set that has vectors of its own for eight cells.
#include "kernel/engine/cpu/own_lanes.h"
#include "render/brick/brick_kernels.h"

namespace voxmelt::render {

template BrickLoops brick_loops_for<cpu::OwnArch>();

}  // namespace voxmelt::render
