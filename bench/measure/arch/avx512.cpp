// The loops for AVX-512BW.
#include "bench/measure/arch/lane_loops.h"
#include "kernel/engine/cpu/lanes_avx512.h"

namespace voxmelt::measure {

LaneLoops avx512_loops() { return loops_for<xsimd::avx512bw>(); }

}  // namespace voxmelt::measure
