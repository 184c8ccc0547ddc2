#include <cstddef>
#include <span>

#include "kernel/automaton/rule/visibility.h"
#include "kernel/engine/visibility/brick_walk.h"
#include "kernel/engine/visibility/caster.h"
#include "kernel/engine/visibility/two_level.h"

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
  return with_walk(ray, [&](auto& walk) { return follow_to_end(opaque, gaps, walk); });
}

void PlainCaster::cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const {
  for (std::size_t i = 0; i < rays.size(); ++i) fates[i] = plain_fate(opaque, rays[i]);
}

void TwoLevelCaster::cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const {
  for (std::size_t i = 0; i < rays.size(); ++i) fates[i] = two_level_fate(opaque, gaps_, rays[i]);
}

}  // namespace voxmelt::visibility
