#include "tests/render/plain_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <set>

namespace voxmelt::test {
namespace {

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

// Finds the place of each colour by counting those that are nearer to the first one.
std::vector<int> plain_tones(const scene::Look& look) {
  using Color = std::vector<long>;
  std::vector<Color> colors;
  for (const scene::Vec3& color : look.materials)
    colors.push_back(
        {std::lround(color[0] * 4096), std::lround(color[1] * 4096), std::lround(color[2] * 4096)});
  const auto key = [&](const Color& a) {
    const Color& f = colors[0];
    return Color{2 * std::abs(a[0] - f[0]) + 7 * std::abs(a[1] - f[1]) + std::abs(a[2] - f[2]), a[0], a[1],
                 a[2]};
  };
  std::set<Color> keys;
  for (const Color& color : colors) keys.insert(key(color));
  std::vector<int> tones;
  const int count = static_cast<int>(keys.size()), middle = (count - 1) / 2;
  for (const Color& color : colors) {
    const auto rank = static_cast<int>(std::distance(keys.begin(), keys.find(key(color))));
    const int place = rank % 2 == 1 ? middle + (rank + 1) / 2 : middle - rank / 2;
    tones.push_back(count < 2 ? 0 : 255 * place / (count - 1));
  }
  return tones;
}

void put_tones(const state::Volume& volume, const std::vector<int>& tones, PlainCells& cells) {
  const state::Grid& grid = volume.grid;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        const std::size_t i = grid.index(x, y, z);
        const std::size_t material = volume.material.empty() ? 0 : volume.material[volume.at(x, y, z)];
        const int tone = tones.empty() || cells.solid[i] == 0 ? 0 : tones[material];
        cells.heat[i] = static_cast<std::uint16_t>((cells.solid[i] * tone + 255) / 256);
      }
}

}  // namespace

// Filters each axis of a pass anew over the whole grid.
Cells plain_low_pass(const state::Grid& grid, int passes, const Cells& from) {
  // Outside, the values must be those after the passes so far. The nearest cell's first value does not
  // suffice, so the grid is widened by the reach of the passes.
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
  const state::Grid& grid = volume.grid;
  if (!look.glow) put_tones(volume, plain_tones(look), cells);
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

  const int wide = std::max({look.smooth, look.smooth_solid, 1});
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
}

}  // namespace voxmelt::test
