// The loops for SSE4.2.
#include "render/density/arch/arch.h"
#include "render/density/arch/loops_for.h"

namespace voxmelt::render {

Loops sse42_loops() { return loops_for<xsimd::sse4_2>(); }

}  // namespace voxmelt::render
