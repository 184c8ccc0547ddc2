// The operations for NEON.
#include "kernel/engine/cpu/lanes_neon.h"
#include "tests/kernel/engine/cpu/lane_loops.h"

namespace voxmelt::cpu {

Operations neon_operations() { return LaneLoops<xsimd::neon64>::operations(); }

}  // namespace voxmelt::cpu
