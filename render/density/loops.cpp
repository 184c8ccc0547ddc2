#include "render/density/loops.h"

#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::render {

const Loops& loops() {
  using enum cpu::InstructionSet;
#if defined(__aarch64__)
  static const Loops chosen = loops_for<cpu::ArchOf<neon>>();
#else
  static const Loops chosen =
      cpu::supported(avx2) ? loops_for<cpu::ArchOf<avx2>>() : loops_for<cpu::ArchOf<sse42>>();
#endif
  return chosen;
}

}  // namespace voxmelt::render
