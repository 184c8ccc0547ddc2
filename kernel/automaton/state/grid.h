// A grid is the size of a volume in cells: x fastest, y up (gravity along -y), z outermost.
#pragma once

#include <cstddef>

namespace voxmelt::state {

struct Grid {
  int x = 0, y = 0, z = 0;

  std::size_t cells() const { return static_cast<std::size_t>(x) * y * z; }
  std::size_t index(int cx, int cy, int cz) const { return (static_cast<std::size_t>(cz) * y + cy) * x + cx; }
  bool contains(int cx, int cy, int cz) const {
    return cx >= 0 && cy >= 0 && cz >= 0 && cx < x && cy < y && cz < z;
  }
  friend bool operator==(const Grid&, const Grid&) = default;
};

}  // namespace voxmelt::state
