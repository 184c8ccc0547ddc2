// Checks a provider against by_the_page.h, for every kind of source.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/engine/visibility/visibility.h"
#include "tests/kernel/engine/visibility/caster_check.h"

namespace voxmelt::visibility {

// Returns the irradiance of every cell from sources that rest, by the page. Rays are followed by
// rule::VoxelWalk.
inline std::vector<std::uint16_t> received_by_the_page(const Volume& v, const std::vector<Shine>& shines,
                                                       int side, std::uint64_t seed) {
  std::vector<std::uint16_t> received(v.grid.cells());
  for (const Shine& shine : shines) {
    const std::vector<PageRay> rays = page_rays(v, shine, side, seed);
    for (std::size_t i = 0; i < rays.size();) {
      const Cell cell = rays[i].cell;
      std::int64_t sum = 0;
      for (; i < rays.size() && rays[i].cell == cell; ++i)
        if (met_by(v, rays[i].ray).empty()) sum += rays[i].weight;
      std::uint16_t& whole = received[v.grid.index(cell[0], cell[1], cell[2])];
      const std::uint64_t more = whole + page_received(cell, shine, sum, side * side);
      whole = static_cast<std::uint16_t>(std::min<std::uint64_t>(more, 65535));
    }
  }
  for_each(whole(v.grid), [&](int x, int y, int z) {
    std::uint16_t& whole = received[v.grid.index(x, y, z)];
    if (whole > 0)
      whole = static_cast<std::uint16_t>(std::min(65535, 4096 * whole / v.amount[v.at(x, y, z)]));
  });
  return received;
}

inline void expect_page(const Volume& v, const std::vector<std::uint16_t>& expected,
                        const state::Field<std::uint16_t>& result, const std::string& where) {
  std::size_t wrong = 0;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (result[v.at(x, y, z)] != expected[v.grid.index(x, y, z)]) ++wrong;
  });
  EXPECT_EQ(wrong, 0u) << where;
}

// Takes 200 worlds, each with up to two sources of one kind after the other. Each world melts once.
inline void check_kinds_in_hostile_worlds(const std::vector<Provider*>& providers, std::uint64_t seed) {
  Random random(seed);
  std::size_t lit = 0, cells = 0;
  for (int world = 0; world < 200 && !testing::Test::HasFailure(); ++world) {
    Volume v = hostile_world(random, hostile_grid(random));
    const std::size_t number = static_cast<std::size_t>(world) % rule::kSourceKinds.size();
    const rule::SourceKind kind = rule::kSourceKinds.at(number).kind;
    std::vector<Shine> shines{awkward_shine(random, v.grid, kind)};
    if (random.one_in(2)) shines.push_back(awkward_shine(random, v.grid));
    const int side = random.any({1, 2, 4});
    const auto ray_seed = static_cast<std::uint64_t>(world) << 30;
    const rule::Heat heat = shone_by(shines, side * side, ray_seed);
    std::vector<state::Field<std::uint16_t>> results;
    for (std::size_t n = 0; n < providers.size(); ++n) results.emplace_back(v.grid);
    for (int melt = 0; melt < 2; ++melt) {
      const std::vector<std::uint16_t> expected = received_by_the_page(v, shines, side, ray_seed);
      for (std::size_t n = 0; n < providers.size(); ++n) {
        // No number of a source that rests depends on the step.
        const auto step = static_cast<std::uint32_t>(8 * world + melt);
        providers[n]->irradiance(v, heat, step, results[n]);
        expect_page(v, expected, results[n],
                    std::string(providers[n]->name()) + ", world " + std::to_string(world));
      }
      lit += expected.size() - static_cast<std::size_t>(std::count(expected.begin(), expected.end(), 0));
      cells += expected.size();
      for_each(whole(v.grid), [&](int x, int y, int z) {
        if (v.solid.test(x, y, z) && random.one_in(5)) v.solid.set(x, y, z, false);
      });
    }
  }
  EXPECT_GT(lit, cells / 40);
}

// Takes 100 places of every kind, in a world that is easy to look at, with 1, 4 and 16 rays.
inline void check_places_of_every_kind(const std::vector<Provider*>& providers, std::uint64_t seed) {
  constexpr Grid kGrid{21, 18, 20};
  Random random(seed);
  std::vector<state::Field<std::uint16_t>> results;
  for (std::size_t n = 0; n < providers.size(); ++n) results.emplace_back(kGrid);
  for (const rule::SourceKindRow& row : rule::kSourceKinds)
    for (int place = 0; place < 100 && !testing::Test::HasFailure(); ++place) {
      const Volume v = ray_scene(place % 5, kGrid);
      const Shine shine = awkward_shine(random, v.grid, row.kind);
      const int side = random.any({1, 2, 4});
      const auto ray_seed = static_cast<std::uint64_t>(place);
      const std::vector<std::uint16_t> expected = received_by_the_page(v, {shine}, side, ray_seed);
      for (std::size_t n = 0; n < providers.size(); ++n) {
        providers[n]->irradiance(v, shone_by({shine}, side * side, ray_seed), 0, results[n]);
        expect_page(v, expected, results[n],
                    std::string(providers[n]->name()) + ", " + std::string(row.name) + ", place " +
                        std::to_string(place));
      }
    }
}

}  // namespace voxmelt::visibility
