// Phase `source` lets vents add liquid, and drains and an open border take it. There are few such cells, so
// plain code serves every instruction set.
#pragma once

#include <cstddef>

#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

// Runs the sources. `moved` and `changed` are [z][tile row], their slices `stride` apart. Only an open border
// asks for `moved`: every tile whose matter has changed since the last call, at first all tiles.
void run_sources(const View& view, const Step& step, const TileRow* moved, TileRow* changed,
                 std::ptrdiff_t stride, Books& books);

}  // namespace voxmelt::simd
