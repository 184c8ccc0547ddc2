// A grid is the size of a volume in cells: x fastest, y up (gravity along -y), z outermost.
#pragma once

#include <cstddef>

namespace voxmelt::state {

struct Grid {
  int x = 0, y = 0, z = 0;

  std::size_t cells() const {
    const std::size_t row = x;
    return row * y * z;
  }
  std::size_t index(std::size_t cx, std::size_t cy, std::size_t cz) const { return (cz * y + cy) * x + cx; }
  std::size_t columns() const { return index(0, z, 0); }  // cells of the plan
  bool contains(int cx, int cy, int cz) const {
    return cx >= 0 && cy >= 0 && cz >= 0 && cx < x && cy < y && cz < z;
  }
  friend bool operator==(const Grid&, const Grid&) = default;
};

// Returns the number of 64-bit words that hold a bit of each cell of a row.
constexpr std::size_t words_for(std::size_t cells) { return (cells + 63) / 64; }

}  // namespace voxmelt::state
