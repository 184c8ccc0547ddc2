// Checks a caster against rule::VoxelWalk, ray by ray.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/rule/visibility.h"
#include "tests/kernel/engine/visibility/ray_worlds.h"

namespace voxmelt::visibility {

// Returns the opaque cells that a ray meets, by their places in Opaque.
inline std::vector<std::size_t> met_by(const Volume& v, const Ray& ray) {
  std::vector<std::size_t> places;
  const auto bricks = [](int size) { return static_cast<std::size_t>((size + 7) / 8); };
  rule::VoxelWalk walk(ray.cell, ray.start, ray.end);
  bool inside = v.grid.contains(walk.x(), walk.y(), walk.z());
  while (inside && walk.next()) {
    const std::array<int, 3> cell{walk.x(), walk.y(), walk.z()};
    inside = v.grid.contains(walk.x(), walk.y(), walk.z());
    if (!page::opaque(v, cell)) continue;
    const std::array<std::size_t, 3> c{static_cast<std::size_t>(cell[0]), static_cast<std::size_t>(cell[1]),
                                       static_cast<std::size_t>(cell[2])};
    const std::size_t brick = (c[2] / 8 * bricks(v.grid.y) + c[1] / 8) * bricks(v.grid.x) + c[0] / 8;
    places.push_back(512 * brick + 64 * (c[2] % 8) + 8 * (c[1] % 8) + c[0] % 8);
  }
  return places;
}

struct Counts {
  std::size_t rays = 0, seeing = 0;
};

// Holds several casters, because the walk, which takes the time, is the same for all.
using Casters = std::vector<Caster*>;

// Lets each caster cast all rays of a source at once, and checks every fate.
inline Counts check_fates(const Casters& casters, const Opaque& opaque, const Volume& v, const Shine& shine,
                          int side, std::uint64_t seed = 1) {
  std::vector<Ray> rays;
  for (const PageRay& ray : page_rays(v, shine, side, seed)) rays.push_back(ray.ray);
  std::vector<std::vector<std::size_t>> places;
  Counts counts{rays.size(), 0};
  for (const Ray& ray : rays) {
    places.push_back(met_by(v, ray));
    counts.seeing += places.back().empty();
  }
  for (Caster* caster : casters) {
    std::vector<Fate> fates(rays.size(), 12345);
    caster->cast(opaque, rays, fates);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
      wrong += places[i].empty() ? fates[i] != kSees
                                 : std::find(places[i].begin(), places[i].end(), fates[i]) == places[i].end();
    EXPECT_EQ(wrong, 0u) << caster->name() << ": of " << rays.size() << " rays, grid " << v.grid.x << ' '
                         << v.grid.y << ' ' << v.grid.z << ", source of kind " << static_cast<int>(shine.kind)
                         << " at " << shine.key.at.x << ' ' << shine.key.at.y << ' ' << shine.key.at.z;
  }
  return counts;
}

// Casts in random worlds, each with three sources of any kind. While a world melts, a caster keeps its
// structures.
inline void check_hostile_worlds(const Casters& casters, int worlds, std::uint64_t seed) {
  Random random(seed);
  cpu::Workers workers(1);
  Opaque opaque;
  Counts all;
  for (int world = 0; world < worlds && !testing::Test::HasFailure(); ++world) {
    Volume v = hostile_world(random, hostile_grid(random));
    for (int melt = 0; melt < 3; ++melt) {
      const auto changes = opaque.take(v, workers);
      for (Caster* caster : casters) caster->prepare(opaque, changes);
      const Shine shine = awkward_shine(random, v.grid);
      const Counts counts = check_fates(casters, opaque, v, shine, random.any({1, 2, 4}), seed);
      all.rays += counts.rays;
      all.seeing += counts.seeing;
      const std::int32_t part = random.any({2, 5, 50});
      for_each(whole(v.grid), [&](int x, int y, int z) {
        if (v.solid.test(x, y, z) && random.one_in(part)) v.solid.set(x, y, z, false);
      });
    }
  }
  EXPECT_GT(all.seeing, all.rays / 20) << "few of " << all.rays << " see their source";
  EXPECT_GT(all.rays - all.seeing, all.rays / 20) << "few of " << all.rays << " are dark";
}

// Makes one of five states of one size: a ball, a wall with holes, a comb of plates, dust, and a ball half
// melted.
inline Volume ray_scene(int number, const Grid& grid = {48, 40, 44}) {
  Volume v(grid);
  Random random(static_cast<std::uint64_t>(number));
  const auto squared = [&](int x, int y, int z) {
    const int dx = x - grid.x / 2, dy = y - grid.y / 2, dz = z - grid.z / 2;
    return dx * dx + dy * dy + dz * dz;
  };
  const int radius = grid.y / 2 - 3;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    const bool ball = squared(x, y, z) < radius * radius;
    const bool stands = number == 0   ? ball
                        : number == 1 ? y == 0 || (x == 20 && (y / 3 + z / 5) % 3 != 0)
                        : number == 2 ? y < 4 || (z % 6 == 0 && y < 30)
                        : number == 3 ? random.one_in(60)
                                      : ball && (y < 12 || !random.one_in(3));
    if (stands && (number == 1 && x == 20)) return put_inert(v, x, y, z);
    if (stands) put_solid(v, x, y, z);
  });
  return v;
}

inline void check_scenes(const Casters& casters, int sources) {
  cpu::Workers workers(1);
  for (int number = 0; number < 5; ++number) {
    const Volume v = ray_scene(number);
    Opaque opaque;
    const auto changes = opaque.take(v, workers);
    for (Caster* caster : casters) caster->prepare(opaque, changes);
    Random random(static_cast<std::uint64_t>(1000 + number));
    Counts all;
    for (int n = 0; n < sources && !testing::Test::HasFailure(); ++n) {
      for (const rule::SourceKindRow& row : rule::kSourceKinds) {
        const rule::SourceKind kind = row.kind;
        if (kind == rule::SourceKind::sky && n > 5) continue;  // one sky is like another
        const auto seed = static_cast<std::uint64_t>(n);
        const Counts counts = check_fates(casters, opaque, v, awkward_shine(random, v.grid, kind), 1, seed);
        all.rays += counts.rays;
        all.seeing += counts.seeing;
      }
    }
    EXPECT_GT(all.seeing, 40 * static_cast<unsigned>(sources)) << number;
  }
}

}  // namespace voxmelt::visibility
