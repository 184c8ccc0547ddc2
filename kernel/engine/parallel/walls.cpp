#include "kernel/engine/parallel/walls.h"

#include <algorithm>
#include <cstdint>

namespace voxmelt::parallel {

Walls::Walls(const simd::View& view)
    : pages_(sizeof(std::uint64_t) * (view.words + 2) * (view.ny + 2) * (view.nz + 2)) {
  for (int z = -1; z <= view.nz; ++z)
    for (int y = -1; y <= view.ny; ++y) {
      std::uint64_t* walls = row(view, y, z);
      if (y < 0 || y == view.ny || z < 0 || z == view.nz) {
        std::fill(walls - 1, walls + view.words + 1, ~std::uint64_t{0});
      } else {
        walls[-1] = walls[view.words] = ~std::uint64_t{0};
        refresh(view, y, z);
      }
    }
}

}  // namespace voxmelt::parallel
