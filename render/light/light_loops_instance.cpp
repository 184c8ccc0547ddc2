// This file is compiled once for each instruction set that has vectors of its own for 16 bytes.
#include "kernel/engine/cpu/own_lanes.h"
#include "render/light/light_sweeps.h"

namespace voxmelt::render {

template LightLoops light_loops_for<cpu::OwnArch>();

}  // namespace voxmelt::render
