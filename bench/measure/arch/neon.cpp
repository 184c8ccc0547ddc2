// The loops for NEON.
#include "bench/measure/arch/lane_loops.h"
#include "kernel/engine/cpu/lanes_neon.h"

namespace voxmelt::measure {

LaneLoops neon_loops() { return loops_for<xsimd::neon64>(); }

}  // namespace voxmelt::measure
