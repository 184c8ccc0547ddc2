#include "kernel/automaton/rule/visibility.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/source.h"
#include "kernel/engine/visibility/visibility.h"

namespace voxmelt::visibility {
namespace {

// Liquid is transparent, and so is everything beyond the grid: only solid and inert cells block.
bool opaque(const state::Volume& volume, int x, int y, int z) {
  return volume.grid.contains(x, y, z) && (volume.solid.test(x, y, z) || volume.inert.test(x, y, z));
}

int facing_axes(const state::Volume& volume, int x, int y, int z, std::int64_t dx, std::int64_t dy,
                std::int64_t dz) {
  const auto side = [](std::int64_t d) { return d > 0 ? 1 : -1; };
  return (dx != 0 && !opaque(volume, x + side(dx), y, z)) + (dy != 0 && !opaque(volume, x, y + side(dy), z)) +
         (dz != 0 && !opaque(volume, x, y, z + side(dz)));
}

bool sees(const state::Volume& volume, int x, int y, int z, rule::Position source) {
  rule::VoxelWalk walk(x, y, z, source);
  bool was_inside = true;
  while (walk.next()) {
    const bool inside = volume.grid.contains(walk.x(), walk.y(), walk.z());
    if (was_inside && !inside) return true;  // a straight ray never comes back
    if (opaque(volume, walk.x(), walk.y(), walk.z())) return false;
    was_inside = inside;
  }
  return true;
}

}  // namespace

void VoxelWalkProvider::irradiance(const state::Volume& volume, const rule::Heat& heat, std::uint32_t step,
                                   state::Field<std::uint16_t>& result) {
  const state::Grid g = volume.grid;
  result.clear();
  for (const rule::PointSource& path : heat.sources) {
    const rule::SourceKey source = rule::source_at(path, step);
    if (source.power == 0) continue;

    const auto light = [&](int x, int y, int z) {
      const std::int64_t dx = source.at.x - (rule::kPositionUnit * x + 8),
                         dy = source.at.y - (rule::kPositionUnit * y + 8),
                         dz = source.at.z - (rule::kPositionUnit * z + 8);
      const int axes = facing_axes(volume, x, y, z, dx, dy, dz);
      if (axes == 0 || !sees(volume, x, y, z, source.at)) return;
      const auto distance_squared = static_cast<std::uint64_t>(dx * dx + dy * dy + dz * dz);
      std::uint16_t& cell = result[volume.at(x, y, z)];
      const std::uint64_t sum = cell + rule::irradiance(source.power, distance_squared, axes);
      cell = static_cast<std::uint16_t>(std::min<std::uint64_t>(sum, rule::kIrradianceMax));
    };
    workers_.run(g.z, [&](int z) {
      for (int y = 0; y < g.y; ++y) {
        const auto solid = volume.solid.row(y, z);
        for (std::size_t w = 0; w < solid.size(); ++w)
          for (std::uint64_t bits = solid[w]; bits != 0; bits &= bits - 1)
            light(static_cast<int>(64 * w) + std::countr_zero(bits), y, z);
      }
    });
  }
}

}  // namespace voxmelt::visibility
