#include "render/light/light_loops.h"

namespace voxmelt::render {

const LightLoops& light_loops_of(cpu::InstructionSet widest) {
  if (widest < cpu::kWideEnough) {
    static const LightLoops kNarrow = light_loops_for<cpu::ArchOf<cpu::InstructionSet{}>>();
    return kNarrow;
  }
  static const LightLoops kWide = light_loops_for<cpu::ArchOf<cpu::kWideEnough>>();
  return kWide;
}

const LightLoops& light_loops() { return light_loops_of(cpu::widest()); }

}  // namespace voxmelt::render
