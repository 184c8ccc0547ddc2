#include "render/brick/brick_loops.h"

namespace voxmelt::render {

const BrickLoops& brick_loops_of([[maybe_unused]] cpu::InstructionSet widest) {
  using enum cpu::InstructionSet;
#if defined(__aarch64__)
  static const BrickLoops kNeon = brick_loops_for<cpu::ArchOf<neon>>();
  return kNeon;
#else
  if (widest == sse42) {
    static const BrickLoops kNarrow = brick_loops_for<cpu::ArchOf<sse42>>();
    return kNarrow;
  }
  static const BrickLoops kWide = brick_loops_for<cpu::ArchOf<avx2>>();
  return kWide;
#endif
}

const BrickLoops& brick_loops() { return brick_loops_of(cpu::widest()); }

}  // namespace voxmelt::render
