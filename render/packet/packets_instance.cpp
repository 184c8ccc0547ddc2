// This file is compiled once for each instruction set.
#include "kernel/engine/cpu/own_lanes.h"
#include "render/packet/draw_packet.h"

namespace voxmelt::render {

template Packets packets_for<cpu::OwnArch>();

}  // namespace voxmelt::render
