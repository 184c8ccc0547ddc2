#include "render/brick/brick_loops.h"

#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::render {

const BrickLoops& brick_loops() {
  using enum cpu::InstructionSet;
#if defined(__aarch64__)
  static const BrickLoops chosen = brick_loops_for<cpu::ArchOf<neon>>();
#else
  static const BrickLoops chosen =
      cpu::supported(avx2) ? brick_loops_for<cpu::ArchOf<avx2>>() : brick_loops_for<cpu::ArchOf<sse42>>();
#endif
  return chosen;
}

}  // namespace voxmelt::render
