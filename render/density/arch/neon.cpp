// The loops for NEON.
#include "render/density/arch/arch.h"
#include "render/density/arch/loops_for.h"

namespace voxmelt::render {

Loops neon_loops() { return loops_for<xsimd::neon64>(); }

}  // namespace voxmelt::render
