#include "kernel/automaton/rule/visibility.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <iterator>

#include "kernel/automaton/rule/ray.h"
#include "kernel/automaton/rule/source.h"
#include "kernel/engine/visibility/visibility.h"

namespace voxmelt::visibility {
namespace {

// Tells if a cell blocks rays. Only solid and inert cells do. Liquid is transparent, and so is everything
// beyond the grid.
bool opaque(const state::Volume& volume, int x, int y, int z) {
  return volume.grid.contains(x, y, z) && (volume.solid.test(x, y, z) || volume.inert.test(x, y, z));
}

using Cell = std::array<int, 3>;

Cell beyond_face(Cell cell, const rule::Face& face) {
  cell[face.axis] += static_cast<int>(face.side);
  return cell;
}

bool sees(const state::Volume& volume, Cell first, rule::Position start, rule::Position end) {
  rule::VoxelWalk walk(first, start, end);
  bool inside = volume.grid.contains(walk.x(), walk.y(), walk.z());
  while (inside && walk.next()) {  // a straight ray that has left the grid never comes back
    if (opaque(volume, walk.x(), walk.y(), walk.z())) return false;
    inside = volume.grid.contains(walk.x(), walk.y(), walk.z());
  }
  return true;
}

// Returns the sum of the weights of all rays of a cell that see the source.
std::int64_t weight_seeing(const state::Volume& volume, rule::CellRays& rays, Cell cell, unsigned faces,
                           int side) {
  std::int64_t sum = 0;
  for (int f = 0; f < rule::kFaces; ++f) {
    if ((faces >> f & 1) == 0) continue;
    rays.choose(f);
    const Cell beyond = beyond_face(cell, rule::face_of(f));
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const rule::Position start = rays.start(i, j);
        const rule::CellRays::Ray ray = rays.ray(side * i + j, start);
        if (ray.weight > 0 && sees(volume, beyond, start, ray.end)) sum += ray.weight;
      }
  }
  return sum;
}

// Returns a bit for each face of a cell that is free, and may have rays that are cast.
unsigned free_faces(const state::Volume& volume, rule::SourceKind kind, const rule::SourceKey& source,
                    Cell cell) {
  unsigned faces = 0;
  for (int f = 0; f < rule::kFaces; ++f) {
    const rule::Face face = rule::face_of(f);
    if (!rule::may_look(kind, source, face, cell[face.axis])) continue;
    const Cell beyond = beyond_face(cell, face);
    if (!opaque(volume, beyond[0], beyond[1], beyond[2])) faces |= 1u << f;
  }
  return faces;
}

template <class Visit>
void for_each_solid(const state::Volume& volume, int z, Visit visit) {
  for (int y = 0; y < volume.grid.y; ++y) {
    const auto solid = volume.solid.row(y, z);
    for (int w = 0; w < std::ssize(solid); ++w)
      for (std::uint64_t bits = solid[w]; bits != 0; bits &= bits - 1)
        visit(64 * w + std::countr_zero(bits), y, z);
  }
}

}  // namespace

std::int64_t VoxelWalkProvider::irradiance(const state::Volume& volume, const rule::Heat& heat,
                                           std::uint32_t step, state::Field<std::uint16_t>& result) {
  const state::Grid g = volume.grid;
  result.clear();
  std::atomic<std::int64_t> cuts = 0;
  const rule::RaySetting setting = rule::ray_setting({g.x, g.y, g.z}, heat);
  for (const rule::HeatSource& path : heat.sources) {
    const rule::SourceKey source = rule::source_at(path, step);
    if (source.power == 0) continue;

    const auto light = [&](int x, int y, int z) {
      const Cell at{x, y, z};
      const unsigned faces = free_faces(volume, path.kind, source, at);
      if (faces == 0) return;
      rule::CellRays rays(setting, path.kind, source, at);
      const std::int64_t seeing = weight_seeing(volume, rays, at, faces, setting.side);
      if (seeing == 0) return;
      std::uint16_t& cell = result[volume.at(x, y, z)];
      const std::uint64_t sum = cell + rays.receives(seeing);
      cell = static_cast<std::uint16_t>(std::min<std::uint64_t>(sum, rule::kIrradianceMax));
      if (sum > rule::kIrradianceMax) cuts.fetch_add(1, std::memory_order_relaxed);
    };
    workers_.run(g.z, [&](int z) { for_each_solid(volume, z, light); });
  }
  workers_.run(g.z, [&](int z) {
    for_each_solid(volume, z, [&](int x, int y, int) {
      const state::Slot at = volume.at(x, y, z);
      if (result[at] > 0) result[at] = rule::irradiance_of_amount(result[at], volume.amount[at]);
    });
  });
  return cuts;
}

}  // namespace voxmelt::visibility
