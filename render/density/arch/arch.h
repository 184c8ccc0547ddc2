// The loops of each instruction set. Call only those that the processor has.
#pragma once

#include "render/density/loops.h"

namespace voxmelt::render {

Loops sse42_loops();
Loops avx2_loops();
Loops neon_loops();

}  // namespace voxmelt::render
