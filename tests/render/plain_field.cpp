#include "tests/render/plain_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

namespace voxmelt::test {
namespace {

using render::Blend;

bool same(const render::Values<std::uint16_t>& a, const Cells& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

Cells mixed(const Cells& solid, const Cells& liquid, const Cells& filtered_solid,
            const Cells& filtered_liquid, const Cells& filtered_obstacle) {
  Cells result(solid.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::int64_t soft = (filtered_liquid[i] + 3) / 4,
                       all =
                           (std::int64_t{filtered_liquid[i]} + filtered_solid[i] + filtered_obstacle[i] + 3) /
                           4;
    const std::int64_t over = std::clamp<std::int64_t>(5 * soft - 2 * all, 0, 2 * all);
    const std::int64_t t = all == 0 ? 0 : 64 * over / all;
    const auto weight = static_cast<std::uint32_t>(t * t * (384 - 2 * t) / 8192);
    result[i] = static_cast<std::uint16_t>((solid[i] * (256 - weight) + liquid[i] * weight + 128) >> 8);
  }
  return result;
}

void expect_ranges(const render::DensityField& field, const Cells& intensity) {
  constexpr int kHalo = 2;
  const state::Grid& grid = field.grid();
  for (int bz = 0; bz < field.bricks().z; ++bz)
    for (int by = 0; by < field.bricks().y; ++by)
      for (int bx = 0; bx < field.bricks().x; ++bx) {
        render::BrickRange range{0xffff, 0};
        for (int z = 8 * bz - kHalo; z < 8 * (bz + 1) + kHalo; ++z)
          for (int y = 8 * by - kHalo; y < 8 * (by + 1) + kHalo; ++y)
            for (int x = 8 * bx - kHalo; x < 8 * (bx + 1) + kHalo; ++x) {
              if (!grid.contains(x, y, z)) continue;
              range.low = std::min(range.low, intensity[grid.index(x, y, z)]);
              range.high = std::max(range.high, intensity[grid.index(x, y, z)]);
            }
        ASSERT_EQ(field.ranges()[field.bricks().index(bx, by, bz)], range) << bx << " " << by << " " << bz;
      }
}

void add_eighth(Blend& sum, const Blend& part) {
  sum.matter += 0.125f * part.matter;
  sum.liquid += 0.125f * part.liquid;
  sum.heat += 0.125f * part.heat;
  sum.glow += 0.125f * part.glow;
}

void expect_pyramid(const render::Pyramid& pyramid, const state::Grid& grid, const PlainCells& filtered,
                    const scene::Look& look, bool obstacles) {
  constexpr float kUnit = 1.0f / static_cast<float>(render::kFull);
  std::vector<Blend> finer(grid.cells());
  for (std::size_t i = 0; i < finer.size(); ++i) {
    const int hard = filtered.solid[i] + (obstacles ? filtered.obstacle[i] : 0), soft = filtered.liquid[i];
    if (hard + soft == 0) continue;
    finer[i].matter = static_cast<float>(std::min(render::kFull, hard + soft)) * kUnit;
    finer[i].liquid = static_cast<float>(soft) * kUnit;
    finer[i].heat = static_cast<float>(filtered.heat[i]) * kUnit;
    if (soft == 0) continue;
    const double temperature = std::min(256, filtered.heat[i] * 256 / soft) / 256.0;
    const double way =
        std::clamp((temperature - look.glow_cold) / std::max(look.glow_hot - look.glow_cold, 1e-6), 0.0, 1.0);
    finer[i].glow = finer[i].liquid * static_cast<float>(way * way);
  }
  state::Grid side = grid;
  for (int l = 1; l <= render::Pyramid::kLevels; ++l) {
    const state::Grid half{(side.x + 1) / 2, (side.y + 1) / 2, (side.z + 1) / 2};
    std::vector<Blend> coarser(half.cells());
    for (int z = 0; z < side.z; ++z)
      for (int y = 0; y < side.y; ++y)
        for (int x = 0; x < side.x; ++x)
          add_eighth(coarser[half.index(x / 2, y / 2, z / 2)], finer[side.index(x, y, z)]);
    const render::PyramidLevel& level = pyramid.level(l);
    ASSERT_EQ(level.grid, half);
    for (int z = -1; z <= half.z; ++z)
      for (int y = -1; y <= half.y; ++y)
        for (int x = -1; x <= half.x; ++x) {
          const Blend expected = half.contains(x, y, z) ? coarser[half.index(x, y, z)] : Blend{};
          ASSERT_EQ(level.cells[level.index(x, y, z)], expected) << l << ": " << x << " " << y << " " << z;
        }
    side = half;
    finer = coarser;
  }
}

}  // namespace

// Each axis of a pass anew over the whole grid.
Cells plain_low_pass(const state::Grid& grid, int passes, const Cells& from) {
  // Outside, what the passes so far would give: the nearest cell's value of the beginning does not suffice,
  // so the grid is widened by what the passes reach.
  const state::Grid side{grid.x + 2 * passes, grid.y + 2 * passes, grid.z + 2 * passes};
  std::vector<std::uint32_t> now(side.cells());
  for (int z = 0; z < side.z; ++z)
    for (int y = 0; y < side.y; ++y)
      for (int x = 0; x < side.x; ++x)
        now[side.index(x, y, z)] =
            from[grid.index(std::clamp(x - passes, 0, grid.x - 1), std::clamp(y - passes, 0, grid.y - 1),
                            std::clamp(z - passes, 0, grid.z - 1))];
  for (int pass = 0; pass < passes; ++pass)
    for (const state::Grid& step : {state::Grid{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}) {
      const std::vector<std::uint32_t> before = now;
      for (int z = step.z; z < side.z - step.z; ++z)
        for (int y = step.y; y < side.y - step.y; ++y)
          for (int x = step.x; x < side.x - step.x; ++x)
            now[side.index(x, y, z)] =
                (before[side.index(x - step.x, y - step.y, z - step.z)] + 2 * before[side.index(x, y, z)] +
                 before[side.index(x + step.x, y + step.y, z + step.z)] + 2) /
                4;
    }
  Cells result(grid.cells());
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x)
        result[grid.index(x, y, z)] =
            static_cast<std::uint16_t>(now[side.index(x + passes, y + passes, z + passes)]);
  return result;
}

void expect_plain(const render::DensityField& field, const state::Volume& volume, const scene::Look& look,
                  const scene::Terrain& terrain) {
  PlainCells cells = plain_cells(volume, look.smooth, terrain);
  if (!look.glow) std::fill(cells.heat.begin(), cells.heat.end(), 0);
  const state::Grid& grid = volume.grid;
  ASSERT_EQ(field.grid(), grid);
  EXPECT_TRUE(same(field.cells().intensity, cells.intensity));
  EXPECT_TRUE(same(field.cells().solid, cells.solid));
  EXPECT_TRUE(same(field.cells().liquid, cells.liquid));
  EXPECT_TRUE(same(field.cells().heat, cells.heat));
  EXPECT_EQ(field.ground(), cells.ground);
  EXPECT_EQ(field.wetness(), cells.wetness);
  const bool obstacles =
      std::any_of(cells.obstacle.begin(), cells.obstacle.end(), [](int o) { return o != 0; });
  ASSERT_EQ(field.has_obstacles(), obstacles);
  EXPECT_TRUE(!obstacles || same(field.cells().obstacle, cells.obstacle));

  const int wide = std::max(look.smooth, look.smooth_solid);
  PlainCells filtered;
  filtered.solid = plain_low_pass(grid, wide, cells.solid);
  filtered.liquid = plain_low_pass(grid, wide, cells.liquid);
  filtered.heat = plain_low_pass(grid, wide, cells.heat);
  filtered.obstacle = plain_low_pass(grid, wide, cells.obstacle);
  filtered.intensity = mixed(plain_low_pass(grid, look.smooth_solid, cells.intensity),
                             plain_low_pass(grid, look.smooth, cells.intensity), filtered.solid,
                             filtered.liquid, filtered.obstacle);
  EXPECT_TRUE(same(field.intensity(), filtered.intensity));
  EXPECT_TRUE(same(field.solid(), filtered.solid));
  EXPECT_TRUE(same(field.liquid(), filtered.liquid));
  EXPECT_TRUE(same(field.heat(), filtered.heat));
  EXPECT_TRUE(!obstacles || same(field.obstacle(), filtered.obstacle));
  expect_ranges(field, filtered.intensity);
  expect_pyramid(field.pyramid(), grid, filtered, look, true);
  expect_pyramid(field.matter_pyramid(), grid, filtered, look, false);
}

}  // namespace voxmelt::test
