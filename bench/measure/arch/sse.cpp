// The loops for SSE4.2.
#include "bench/measure/arch/lane_loops.h"
#include "kernel/engine/cpu/lanes_sse.h"

namespace voxmelt::measure {

LaneLoops sse42_loops() { return loops_for<xsimd::sse4_2>(); }

}  // namespace voxmelt::measure
