// Tells for which tiles a stepper has work in its next step, as far as that is known before it. All others
// sleep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt::step {

struct AwakeTiles {
  int rows = 0;                      // tile rows of a slice
  int shift = 0;                     // a tile has 2^shift rows, and 64 cells along x
  std::vector<std::uint64_t> tiles;  // [slice][tile row], a bit per tile; empty if all are awake

  bool test(int x, int y, int z) const {
    if (tiles.empty()) return true;
    const std::size_t row =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(y >> shift);
    return (tiles[row] >> (x >> 6) & 1) != 0;
  }
};

}  // namespace voxmelt::step
