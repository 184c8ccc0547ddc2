#include "render/brick/brick_loops.h"

namespace voxmelt::render {

const BrickLoops& brick_loops_of(cpu::InstructionSet widest) {
  if (widest < cpu::kWideEnough) {
    static const BrickLoops kNarrow = brick_loops_for<cpu::ArchOf<cpu::InstructionSet{}>>();
    return kNarrow;
  }
  static const BrickLoops kWide = brick_loops_for<cpu::ArchOf<cpu::kWideEnough>>();
  return kWide;
}

const BrickLoops& brick_loops() { return brick_loops_of(cpu::widest()); }

}  // namespace voxmelt::render
