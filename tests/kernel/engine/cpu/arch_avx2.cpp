// The operations for AVX2.
#include "kernel/engine/cpu/lanes_avx2.h"
#include "tests/kernel/engine/cpu/lane_loops.h"

namespace voxmelt::cpu {

Operations avx2_operations() { return LaneLoops<xsimd::avx2>::operations(); }

}  // namespace voxmelt::cpu
