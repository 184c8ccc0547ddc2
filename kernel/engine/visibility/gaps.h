// How far a ray may go at once: for each brick and each of the eight ways that a ray may take, the side of
// the largest cube of empty bricks that begins there. A byte each, so 1/64 byte for each cell of the grid.
//
// Opaque cells only vanish, so a gap that was remains one, and is found anew only after many bricks emptied.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/engine/visibility/opaque.h"

namespace voxmelt::visibility {

class Gaps {
 public:
  static constexpr int kEndless = 255;  // nothing stands on this way, to the end of the grid

  // After Opaque::take, of the same one every time.
  void update(const Opaque& opaque, const Opaque::News& news);

  // `octant` has a bit for each axis along which the ray goes up. 0: the brick may hold something.
  int at(std::size_t octant, std::size_t brick) const { return sides_[octant][brick]; }

 private:
  void find(const Opaque& opaque, std::size_t octant);

  std::array<std::vector<std::uint8_t>, 8> sides_;  // by octants
  std::int64_t filled_ = 0, emptied_ = 0;           // bricks, when they were found and since
};

}  // namespace voxmelt::visibility
