#include "render/light/light_loops.h"

#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::render {

const LightLoops& light_loops() {
  using enum cpu::InstructionSet;
#if defined(__aarch64__)
  static const LightLoops chosen = light_loops_for<cpu::ArchOf<neon>>();
#else
  static const LightLoops chosen =
      cpu::supported(avx2) ? light_loops_for<cpu::ArchOf<avx2>>() : light_loops_for<cpu::ArchOf<sse42>>();
#endif
  return chosen;
}

}  // namespace voxmelt::render
