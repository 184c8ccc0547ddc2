// The operations for SSE4.2.
#include "kernel/engine/cpu/lanes_sse.h"
#include "tests/kernel/engine/cpu/lane_loops.h"

namespace voxmelt::cpu {

Operations sse_operations() { return LaneLoops<xsimd::sse4_2>::operations(); }

}  // namespace voxmelt::cpu
