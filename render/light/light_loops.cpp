#include "render/light/light_loops.h"

namespace voxmelt::render {

const LightLoops& light_loops_of([[maybe_unused]] cpu::InstructionSet widest) {
  using enum cpu::InstructionSet;
#if defined(__aarch64__)
  static const LightLoops kNeon = light_loops_for<cpu::ArchOf<neon>>();
  return kNeon;
#else
  if (widest == sse42) {
    static const LightLoops kNarrow = light_loops_for<cpu::ArchOf<sse42>>();
    return kNarrow;
  }
  static const LightLoops kWide = light_loops_for<cpu::ArchOf<avx2>>();
  return kWide;
#endif
}

const LightLoops& light_loops() { return light_loops_of(cpu::widest()); }

}  // namespace voxmelt::render
