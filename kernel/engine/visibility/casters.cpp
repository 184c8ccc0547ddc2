#include <algorithm>
#include <cstddef>
#include <span>

#include "kernel/automaton/rule/visibility.h"
#include "kernel/engine/visibility/brick_walk.h"
#include "kernel/engine/visibility/caster.h"

namespace voxmelt::visibility {
namespace {

Fate plain_fate(const Opaque& opaque, const Ray& ray) {
  rule::VoxelWalk walk(ray.cell, ray.start, ray.end);
  bool inside = opaque.contains(ray.cell);
  while (inside && walk.next()) {  // a straight ray that has left the grid never comes back
    const Cell cell{walk.x(), walk.y(), walk.z()};
    inside = opaque.contains(cell);
    if (inside && opaque.plane().test(cell[0], cell[1], cell[2]))
      return met(Opaque::place(opaque.brick_at(cell), cell));
  }
  return kSees;
}

}  // namespace

Fate two_level_fate(const Opaque& opaque, const Gaps& gaps, const Ray& ray) {
  if (!opaque.contains(ray.cell)) return kSees;
  return with_walk(ray, [&](auto& walk) {
    const std::size_t octant = walk.octant();
    bool ends = false;
    // What lies in a brick, but beyond the grid, is empty. So a ray may leave the grid there.
    while (!ends && opaque.bricks().contains(walk.cell()[0] >> 3, walk.cell()[1] >> 3, walk.cell()[2] >> 3)) {
      const std::size_t brick = opaque.brick_at(walk.cell());
      const int gap = gaps.at(octant, brick);
      if (gap == Gaps::kEndless) return kSees;
      if (gap > 0 || opaque.clear_ahead(brick, walk.cell(), octant)) {
        ends = !walk.leave(std::max(gap, 1));
      } else if (const Fate fate = meet_in_brick(opaque, brick, walk, ends); fate != kSees) {
        return fate;
      }
    }
    return kSees;
  });
}

void PlainCaster::cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const {
  for (std::size_t i = 0; i < rays.size(); ++i) fates[i] = plain_fate(opaque, rays[i]);
}

void TwoLevelCaster::cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const {
  for (std::size_t i = 0; i < rays.size(); ++i) fates[i] = two_level_fate(opaque, gaps_, rays[i]);
}

}  // namespace voxmelt::visibility
