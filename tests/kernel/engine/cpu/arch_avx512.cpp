// The operations for AVX-512BW.
#include "kernel/engine/cpu/lanes_avx512.h"
#include "tests/kernel/engine/cpu/lane_loops.h"

namespace voxmelt::cpu {

Operations avx512_operations() { return LaneLoops<xsimd::avx512bw>::operations(); }

}  // namespace voxmelt::cpu
