// The low-pass filter of the paper's section 5: separable binomial 1-2-1 along x, y and z, repeated.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/state/grid.h"

namespace voxmelt::render {

inline constexpr int kMaxPasses = 6;

// Filters the 8x8x8 cells of one brick of `from` into `to`. Cells outside the grid repeat the nearest cell
// inside; every pass rounds once, to nearest. The result depends on `from` alone, so filtering one brick
// gives the same bits as filtering all of them.
void low_pass_brick(const state::Grid& grid, int bx, int by, int bz, int passes,
                    const std::vector<std::uint16_t>& from, std::vector<std::uint16_t>& to);

// All bricks.
std::vector<std::uint16_t> low_pass(const state::Grid& grid, int passes,
                                    const std::vector<std::uint16_t>& from);

}  // namespace voxmelt::render
