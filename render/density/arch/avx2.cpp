// The loops for AVX2.
#include "render/density/arch/arch.h"
#include "render/density/arch/loops_for.h"

namespace voxmelt::render {

Loops avx2_loops() { return loops_for<xsimd::avx2>(); }

}  // namespace voxmelt::render
