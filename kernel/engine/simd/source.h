// Phase `source` lets vents add liquid and drains take it. There are few such cells, so plain code serves
// every instruction set.
#pragma once

#include <cstddef>

#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

// Runs the sources. `changed` is [z][tile row], its slices `stride` apart.
void run_sources(const View& view, const Step& step, TileRow* changed, std::ptrdiff_t stride, Books& books);

}  // namespace voxmelt::simd
