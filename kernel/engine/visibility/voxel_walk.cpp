#include "kernel/automaton/rule/visibility.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "kernel/automaton/rule/source.h"
#include "kernel/engine/visibility/visibility.h"

namespace voxmelt::visibility {
namespace {

// Liquid is transparent, and so is everything beyond the grid: only solid and inert cells block.
bool opaque(const state::Volume& volume, int x, int y, int z) {
  return volume.grid.contains(x, y, z) && (volume.solid.test(x, y, z) || volume.inert.test(x, y, z));
}

using Cell = std::array<int, 3>;

bool sees(const state::Volume& volume, Cell first, rule::Position start, rule::Position source) {
  rule::VoxelWalk walk(first, start, source);
  bool inside = volume.grid.contains(walk.x(), walk.y(), walk.z());
  while (inside && walk.next()) {  // a straight ray that has left the grid never comes back
    if (opaque(volume, walk.x(), walk.y(), walk.z())) return false;
    inside = volume.grid.contains(walk.x(), walk.y(), walk.z());
  }
  return true;
}

// How many rays from the face of a cell towards `beyond`, along `axis`, see the source: `side` x `side` of
// them, from the centres of equal squares.
int seeing(const state::Volume& volume, Cell cell, std::size_t axis, Cell beyond, int side,
           rule::Position source) {
  std::array<std::int64_t, 3> start{};
  start[axis] = rule::kPositionUnit * std::max(cell[axis], beyond[axis]);
  const std::size_t across = (axis + 1) % 3, along = (axis + 2) % 3;
  const std::int64_t square = rule::kPositionUnit / side;
  int count = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      start[across] = rule::kPositionUnit * cell[across] + square * i + square / 2;
      start[along] = rule::kPositionUnit * cell[along] + square * j + square / 2;
      count += sees(volume, beyond, {start[0], start[1], start[2]}, source);
    }
  return count;
}

// The sum, over the rays that see the source, of |delta| along the axis of their face.
std::int64_t facing(const state::Volume& volume, Cell cell, const std::array<std::int64_t, 3>& delta,
                    int side, rule::Position source) {
  std::int64_t sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t length = std::abs(delta[axis]);
    if (length <= rule::kPositionUnit / 2) continue;  // the source is in the face's plane, or behind it
    Cell beyond = cell;
    beyond[axis] += delta[axis] > 0 ? 1 : -1;
    if (opaque(volume, beyond[0], beyond[1], beyond[2])) continue;
    sum += length * seeing(volume, cell, axis, beyond, side, source);
  }
  return sum;
}

}  // namespace

std::int64_t VoxelWalkProvider::irradiance(const state::Volume& volume, const rule::Heat& heat,
                                           std::uint32_t step, state::Field<std::uint16_t>& result) {
  const state::Grid g = volume.grid;
  result.clear();
  std::atomic<std::int64_t> cuts = 0;
  const int rays = heat.rays_per_face;
  const int side = rays == 16 ? 4 : rays == 4 ? 2 : 1;
  for (const rule::PointSource& path : heat.sources) {
    const rule::SourceKey source = rule::source_at(path, step);
    if (source.power == 0) continue;

    const auto light = [&](int x, int y, int z) {
      const std::array<std::int64_t, 3> delta{source.at.x - (rule::kPositionUnit * x + 8),
                                              source.at.y - (rule::kPositionUnit * y + 8),
                                              source.at.z - (rule::kPositionUnit * z + 8)};
      const std::int64_t sum_facing = facing(volume, {x, y, z}, delta, side, source.at);
      if (sum_facing == 0) return;
      const auto squared =
          static_cast<std::uint64_t>(delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2]);
      std::uint16_t& cell = result[volume.at(x, y, z)];
      const std::uint64_t sum = cell + rule::irradiance(source.power, sum_facing, rays, squared);
      cell = static_cast<std::uint16_t>(std::min<std::uint64_t>(sum, rule::kIrradianceMax));
      if (sum > rule::kIrradianceMax) cuts.fetch_add(1, std::memory_order_relaxed);
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
  return cuts;
}

}  // namespace voxmelt::visibility
