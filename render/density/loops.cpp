#include "render/density/loops.h"

#include "kernel/engine/cpu/instruction_set.h"
#include "render/density/arch/arch.h"

namespace voxmelt::render {

const Loops& loops() {
#if defined(__aarch64__)
  static const Loops chosen = neon_loops();
#else
  using cpu::InstructionSet;
  static const Loops chosen = cpu::supported(InstructionSet::avx2) ? avx2_loops() : sse42_loops();
#endif
  return chosen;
}

}  // namespace voxmelt::render
