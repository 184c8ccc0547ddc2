// Gaps tell how far a ray may go at once. For each brick and each of the eight ways of a ray, they have the
// side of the largest cube of empty bricks that begins there. That is a byte each, so 1/64 byte for each cell
// of the grid.
//
// Opaque cells only vanish, so a gap remains one. Gaps are found anew only after many bricks emptied.
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

  // Updates the gaps. It must follow Opaque::take, with the same object every time.
  void update(const Opaque& opaque, const Opaque::News& news);

  // Returns the side. `octant` has a bit for each axis along which the ray goes up. With 0 the brick may hold
  // something.
  int at(std::size_t octant, std::size_t brick) const { return sides_[octant][brick]; }

 private:
  void find(const Opaque& opaque, std::size_t octant);

  std::array<std::vector<std::uint8_t>, 8> sides_;  // by octant
  std::int64_t filled_ = 0, emptied_ = 0;           // number of bricks, when the sides were found and since
};

}  // namespace voxmelt::visibility
