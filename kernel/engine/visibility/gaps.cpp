#include "kernel/engine/visibility/gaps.h"

#include <algorithm>

namespace voxmelt::visibility {
namespace {

constexpr std::int64_t kFewEmptied = 16;  // 1/16 of the bricks that held something

}  // namespace

void Gaps::update(const Opaque& opaque, const Opaque::News& news) {
  emptied_ += news.emptied;
  const std::size_t bricks = opaque.bricks().cells();
  if (news.filled == 0 && sides_[0].size() == bricks && kFewEmptied * emptied_ <= filled_) return;
  emptied_ = filled_ = 0;
  for (std::size_t brick = 0; brick < bricks; ++brick) filled_ += opaque.empty(brick) ? 0 : 1;
  for (std::size_t octant = 0; octant < sides_.size(); ++octant) {
    sides_[octant].resize(bricks);
    find(opaque, octant);
  }
}

// Finds the sides from the far end of the way. A cube is one longer than the shortest of the seven that begin
// beside it.
void Gaps::find(const Opaque& opaque, std::size_t octant) {
  const state::Grid& g = opaque.bricks();
  std::vector<std::uint8_t>& sides = sides_[octant];
  const std::size_t width = g.x;
  const std::vector<std::uint8_t> beyond(width, kEndless);
  std::vector<std::uint8_t> least(width);
  const auto way = [&](int axis) { return (octant >> axis & 1) != 0 ? 1 : -1; };
  const auto row = [&](int y, int z) {
    const bool there = y >= 0 && y < g.y && z >= 0 && z < g.z;
    return there ? sides.data() + g.index(0, y, z) : beyond.data();
  };
  for (int k = 0; k < g.z; ++k)
    for (int j = 0; j < g.y; ++j) {
      const int z = way(2) > 0 ? g.z - 1 - k : k, y = way(1) > 0 ? g.y - 1 - j : j;
      const std::uint8_t *const on_y = row(y + way(1), z), *const on_z = row(y, z + way(2)),
                                *const on_both = row(y + way(1), z + way(2));
      for (std::size_t x = 0; x < width; ++x) least[x] = std::min({on_y[x], on_z[x], on_both[x]});
      const std::size_t first = g.index(0, y, z);
      int side = kEndless, near = kEndless;  // sides of the brick before, and of those beside it
      for (std::size_t i = 0; i < width; ++i) {
        const std::size_t x = way(0) > 0 ? width - 1 - i : i;
        side = std::min<int>({side, near, least[x]});
        near = least[x];
        side = !opaque.empty(first + x) ? 0 : side == kEndless ? kEndless : std::min(side + 1, kEndless - 1);
        sides[first + x] = static_cast<std::uint8_t>(side);
      }
    }
}

}  // namespace voxmelt::visibility
