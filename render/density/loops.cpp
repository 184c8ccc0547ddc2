#include "render/density/loops.h"

namespace voxmelt::render {

const Loops& loops_of([[maybe_unused]] cpu::InstructionSet widest) {
  using enum cpu::InstructionSet;
#if defined(__aarch64__)
  static const Loops kNeon = loops_for<cpu::ArchOf<neon>>();
  return kNeon;
#else
  if (widest == sse42) {
    static const Loops kNarrow = loops_for<cpu::ArchOf<sse42>>();
    return kNarrow;
  }
  static const Loops kWide = loops_for<cpu::ArchOf<avx2>>();
  return kWide;
#endif
}

const Loops& loops() { return loops_of(cpu::widest()); }

}  // namespace voxmelt::render
