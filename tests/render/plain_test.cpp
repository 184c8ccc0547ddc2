// The field in its pieces agrees with the field written plainly, in random worlds of any size, kept up to
// date.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>

#include "kernel/automaton/rule/fixed_point.h"
#include "render/density/low_pass.h"
#include "tests/render/plain_field.h"

namespace voxmelt {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  int below(int end) { return static_cast<int>(bits_() % static_cast<unsigned>(end)); }
  bool one_in(int n) { return below(n) == 0; }

 private:
  std::mt19937 bits_;
};

// Puts anything that a volume may hold into a cell: `kind` 0 is nothing, 1 solid, 2 liquid, 3 inert.
void put(state::Volume& volume, int x, int y, int z, int kind, Random& random) {
  const state::Slot at = volume.at(x, y, z);
  const int amount = random.one_in(4) ? rule::kOne : 1 + random.below(random.one_in(5) ? 65535 : 5000);
  volume.solid.set(x, y, z, kind == 1);
  volume.liquid.set(x, y, z, kind == 2);
  volume.inert.set(x, y, z, kind == 3);
  volume.amount[at] = static_cast<std::uint16_t>(kind == 0 ? 0 : amount);
  volume.heat[at] = static_cast<std::uint16_t>(kind == 1 || kind == 2 ? random.below(65536) : 0);
}

// Makes uneven ground, puddles on it, lumps and walls above, as in scenes, and some dust.
state::Volume world(const state::Grid& grid, Random& random) {
  state::Volume volume(grid);
  const int ground = random.below(3) == 0 ? 0 : grid.y / 3 + 1, depth = 1 + random.below(3);
  const auto lump = [&](int kind) {
    const int cx = random.below(grid.x), cy = random.below(grid.y), cz = random.below(grid.z),
              r = 1 + random.below(6);
    for (int z = std::max(cz - r, 0); z < std::min(cz + r, grid.z); ++z)
      for (int y = std::max(cy - r, 0); y < std::min(cy + r, grid.y); ++y)
        for (int x = std::max(cx - r, 0); x < std::min(cx + r, grid.x); ++x)
          put(volume, x, y, z, kind, random);
  };
  for (int i = 0; i < 4; ++i) lump(1 + random.below(2));
  if (random.one_in(2)) lump(3);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) {
      const int bed =
          std::min(ground == 0 ? 0 : random.below(2) + (x + z) * ground / (grid.x + grid.z), grid.y);
      for (int y = 0; y < bed; ++y) put(volume, x, y, z, 3, random);
      if (ground != 0 && x * 2 < grid.x)
        for (int y = bed; y < std::min(bed + depth, grid.y); ++y) put(volume, x, y, z, 2, random);
    }
  for (int i = 0; i < 20; ++i)
    put(volume, random.below(grid.x), random.below(grid.y), random.below(grid.z), random.below(4), random);
  return volume;
}

scene::Look look(int liquid, int solid) {
  scene::Look look;
  look.smooth = liquid;
  look.smooth_solid = solid;
  look.glow = solid % 2 == 1;
  look.glow_cold = 0.3;
  look.glow_hot = 0.8;
  return look;
}

TEST(Plain, LowPassOfNoise) {
  Random random(3);
  for (const state::Grid& grid : {state::Grid{1, 1, 1}, {7, 3, 9}, {8, 8, 8}, {21, 20, 22}, {83, 9, 10}}) {
    test::Cells cells(grid.cells());
    for (auto& cell : cells) cell = static_cast<std::uint16_t>(random.below(render::kFull + 1));
    render::Values<std::uint16_t> values(cells.size());
    std::copy(cells.begin(), cells.end(), values.data());
    for (int passes = 0; passes <= render::kMaxPasses; ++passes) {
      const auto filtered = render::low_pass(grid, passes, values);
      EXPECT_TRUE(
          std::equal(filtered.begin(), filtered.end(), test::plain_low_pass(grid, passes, cells).begin()))
          << grid.x << " wide, " << passes << " passes";
    }
  }
}

TEST(Plain, FreshFields) {
  Random random(17);
  const state::Grid grids[] = {{1, 1, 1}, {5, 9, 3}, {8, 16, 8}, {17, 20, 12}, {40, 24, 33}, {71, 11, 20}};
  for (const state::Grid& grid : grids)
    for (const auto& [liquid, solid] : {std::pair{3, 1}, {0, 0}, {1, 4}, {6, 6}, {6, 0}}) {
      const state::Volume volume = world(grid, random);
      scene::Terrain terrain;
      if (random.one_in(2)) {
        terrain.x = grid.x;
        terrain.z = grid.z;
        for (int i = 0; i < grid.x * grid.z; ++i)
          terrain.height.push_back(static_cast<float>(random.below(80) - 10) * 0.1f);
      }
      render::DensityField field;
      field.update(volume, look(liquid, solid), terrain, 1 + random.below(2));
      test::expect_plain(field, volume, look(liquid, solid), terrain);
      if (testing::Test::HasFailure())
        FAIL() << grid.x << " x " << grid.y << " x " << grid.z << ", " << liquid;
    }
}

// One field takes over state after state: small changes, other worlds, other looks, other sizes.
TEST(Plain, KeptFields) {
  Random random(29);
  render::DensityField field;
  for (const state::Grid& grid : {state::Grid{33, 25, 30}, {70, 18, 17}}) {
    state::Volume volume = world(grid, random);
    scene::Look now = look(3, 1);
    for (int round = 0; round < 27; ++round) {
      if (round % 10 == 9) volume = world(grid, random);
      if (round == 15)  // obstacles go, and come again
        for (int i = 0; i < grid.x * grid.y * grid.z; ++i) {
          const int x = i % grid.x, y = i / grid.x % grid.y, z = i / grid.x / grid.y;
          if (volume.inert.test(x, y, z)) put(volume, x, y, z, 0, random);
        }
      if (round % 13 == 12) now = look(random.below(7), random.below(7));
      if (round % 13 == 6) now.glow_hot = 0.5 + 0.1 * random.below(4);
      if (round % 6 == 5) now.glow = !now.glow;
      for (int change = random.below(4); change > 0; --change)
        put(volume, random.below(grid.x), random.below(grid.y), random.below(grid.z), random.below(4),
            random);
      field.update(volume, now, {}, 1 + round % 2);
      test::expect_plain(field, volume, now);
      if (testing::Test::HasFailure()) FAIL() << "round " << round;
    }
    EXPECT_EQ(field.update(volume, now), 0) << "nothing changed";
  }
}

}  // namespace
}  // namespace voxmelt
