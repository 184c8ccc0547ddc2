#include "render/density/loops.h"

namespace voxmelt::render {

const Loops& loops_of(cpu::InstructionSet widest) {
  if (widest < cpu::kWideEnough) {
    static const Loops kNarrow = loops_for<cpu::ArchOf<cpu::InstructionSet{}>>();
    return kNarrow;
  }
  static const Loops kWide = loops_for<cpu::ArchOf<cpu::kWideEnough>>();
  return kWide;
}

const Loops& loops() { return loops_of(cpu::widest()); }

}  // namespace voxmelt::render
