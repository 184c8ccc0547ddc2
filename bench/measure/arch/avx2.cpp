// The loops for AVX2.
#include "bench/measure/arch/lane_loops.h"
#include "kernel/engine/cpu/lanes_avx2.h"

namespace voxmelt::measure {

LaneLoops avx2_loops() { return loops_for<xsimd::avx2>(); }

}  // namespace voxmelt::measure
