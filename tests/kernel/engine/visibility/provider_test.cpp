// What each solid cell receives: by brute force on random grids, and on worlds with a known answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/engine/visibility/visibility.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::visibility {
namespace {

using namespace worlds;
using rule::Position;

rule::Heat lit_by(std::vector<Position> sources, std::uint64_t power) {
  rule::Heat heat;
  heat.enabled = heat.radiation = true;
  for (const Position at : sources) heat.sources.push_back({{{0, at, power}}});
  return heat;
}
state::Field<std::uint16_t> irradiance(const Volume& v, const rule::Heat& heat, std::uint32_t step = 0) {
  state::Field<std::uint16_t> result(v.grid);
  VoxelWalkProvider().irradiance(v, heat, step, result);
  return result;
}

bool opaque(const Volume& v, int x, int y, int z) {
  return v.grid.contains(x, y, z) && (v.solid.test(x, y, z) || v.inert.test(x, y, z));
}

// Section 5, written again: the segment is cut by all cells of the grid, each by an exact slab test.
std::uint64_t by_the_page(const Volume& v, int x, int y, int z, Position s, std::uint64_t power) {
  const std::array<std::int64_t, 3> c{16 * x + 8, 16 * y + 8, 16 * z + 8},
      d{s.x - c[0], s.y - c[1], s.z - c[2]};
  std::size_t axes = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (d[a] == 0) continue;
    std::array<int, 3> n{x, y, z};
    n[a] += d[a] > 0 ? 1 : -1;
    axes += !opaque(v, n[0], n[1], n[2]);
  }
  if (axes == 0) return 0;
  bool hidden = false;
  for_each(whole(v.grid), [&](int bx, int by, int bz) {
    if (hidden || !opaque(v, bx, by, bz) || (bx == x && by == y && bz == z)) return;
    // Cut t in (0, 1) to where c + t d is inside the open cell; fractions over / under with under > 0.
    std::int64_t low = 0, low_under = 1, high = 1, high_under = 1;
    const std::array<std::int64_t, 3> corner{16 * bx, 16 * by, 16 * bz};
    for (std::size_t a = 0; a < 3; ++a) {
      if (d[a] == 0 && (c[a] <= corner[a] || c[a] >= corner[a] + 16)) return;
      if (d[a] == 0) continue;
      const std::int64_t under = d[a] > 0 ? d[a] : -d[a];
      const std::int64_t first = d[a] > 0 ? corner[a] - c[a] : c[a] - corner[a] - 16;
      if (first * low_under > low * under) low = first, low_under = under;
      if ((first + 16) * high_under < high * under) high = first + 16, high_under = under;
    }
    hidden = low * high_under < high * low_under;
  });
  if (hidden) return 0;
  const std::array<std::uint64_t, 4> w{0, 4096, 5793, 7094};
  const auto squared = static_cast<std::uint64_t>(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  return power * w[axes] / (4096 * std::max<std::uint64_t>(squared, 256));
}

TEST(Irradiance, EqualsBruteForce) {
  Random random(33);
  int lit = 0, dark = 0;
  for (int trial = 0; trial < 150; ++trial) {
    Volume v(Grid{random.between(1, 7), random.between(1, 7), random.between(1, 7)});
    const std::int32_t sparse = random.between(2, 12);
    for_each(whole(v.grid), [&](int x, int y, int z) {
      if (!random.one_in(sparse)) return;
      if (random.one_in(4)) return put_inert(v, x, y, z);
      if (random.one_in(4)) return put(v, x, y, z, 4096);
      put_solid(v, x, y, z);
    });
    std::vector<Position> sources;
    for (std::int32_t n = random.between(1, 3); n > 0; --n) {
      const auto coordinate = [&](int size) -> std::int64_t {
        return random.any(
            {16 * random.between(0, size), 16 * random.below(size) + 8, random.between(-50, 16 * size + 50)});
      };
      sources.push_back({coordinate(v.grid.x), coordinate(v.grid.y), coordinate(v.grid.z)});
    }
    const std::uint64_t power = std::uint64_t{1} << random.between(10, 30);
    const state::Field<std::uint16_t> result = irradiance(v, lit_by(sources, power));
    for_each(whole(v.grid), [&](int x, int y, int z) {
      std::uint64_t expected = 0;
      if (v.solid.test(x, y, z))
        for (const Position s : sources)
          expected = std::min<std::uint64_t>(65535, expected + by_the_page(v, x, y, z, s, power));
      ++(expected > 0 ? lit : dark);
      ASSERT_EQ(result[v.at(x, y, z)], expected) << x << ' ' << y << ' ' << z << ", trial " << trial;
    });
  }
  EXPECT_GT(lit, 500);
  EXPECT_GT(dark, 500);
}

constexpr std::uint64_t kPower = std::uint64_t{256} * 16000;  // 16000 at one cell's distance, one axis

TEST(Irradiance, OfACubeSeenFromItsFaceEdgeAndCorner) {
  Volume v(Grid{9, 9, 9});
  put_solid(v, 4, 4, 4);  // centre (72, 72, 72)
  const auto from = [&](Position s) { return irradiance(v, lit_by({s}, kPower))[v.at(4, 4, 4)]; };
  EXPECT_EQ(from({72 + 32, 72, 72}), 4000);
  EXPECT_EQ(from({72 + 32, 72 - 32, 72}), 16000 * 256 / 2048 * 5793 / 4096);
  EXPECT_EQ(from({72 - 32, 72 + 32, 72 + 32}), kPower * 7094 / (4096 * 3072));
  EXPECT_EQ(from({72, 72, 72}), 0) << "at its centre no face looks at it";
  EXPECT_EQ(from({73, 72, 72}), 16000) << "inside the cell: as from one cell away";
  EXPECT_EQ(from({72 + 160, 72, 72}), 160) << "outside the grid";
}

TEST(Irradiance, SourceInsideASolidLightsNothingBeyondIt) {
  Volume v(Grid{9, 9, 9});
  for_each({3, 3, 3, 6, 6, 6}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  put_solid(v, 0, 4, 4);
  const state::Field<std::uint16_t> inside = irradiance(v, lit_by({{72, 72, 72}}, 1u << 30));
  for (const std::uint16_t i : inside.stored()) EXPECT_EQ(i, 0);
  // On the block's face: the cell there is lit by it, and the far one too.
  const state::Field<std::uint16_t> face = irradiance(v, lit_by({{48, 72, 72}}, 1u << 30));
  EXPECT_GT(face[v.at(3, 4, 4)], 0);
  EXPECT_GT(face[v.at(0, 4, 4)], 0);
  EXPECT_EQ(face[v.at(5, 4, 4)], 0);
}

TEST(Irradiance, LiquidIsTransparentAndInertIsNot) {
  Volume v(Grid{9, 3, 3});
  put_solid(v, 1, 1, 1);
  const rule::Heat heat = lit_by({{16 * 8, 24, 24}}, 1u << 28);
  const state::Slot i = v.at(1, 1, 1);
  const std::uint16_t open = irradiance(v, heat)[i];
  EXPECT_GT(open, 0);
  put(v, 2, 1, 1, 4096);
  put(v, 4, 1, 1, 65535);
  EXPECT_EQ(irradiance(v, heat)[i], open);
  put_inert(v, 4, 1, 1);
  EXPECT_EQ(irradiance(v, heat)[i], 0);
}

// One-cell-thick walls are tight: also along the diagonals, where only corners touch.
TEST(Irradiance, ThinWallsAreTight) {
  Volume v(Grid{15, 9, 9});
  for_each({7, 0, 0, 8, 9, 9}, [&](int x, int y, int z) { put_inert(v, x, y, z); });
  for_each({10, 0, 0, 15, 9, 9}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  const auto behind = irradiance(v, lit_by({{40, 72, 72}, {8, 8, 8}, {111, 70, 3}}, 1u << 30));
  for (const std::uint16_t i : behind.stored()) EXPECT_EQ(i, 0);
}

TEST(Irradiance, IsCutAfterEachSource) {
  Volume v(Grid{3, 3, 3});
  put_solid(v, 1, 1, 1);
  const Position s{60, 24, 24};
  EXPECT_EQ(irradiance(v, lit_by({s}, std::uint64_t{1} << 49))[v.at(1, 1, 1)], 65535);
  EXPECT_EQ(irradiance(v, lit_by({s, s, s}, std::uint64_t{1} << 49))[v.at(1, 1, 1)], 65535);
  EXPECT_EQ(irradiance(v, lit_by({s, s}, 1u << 20))[v.at(1, 1, 1)],
            2 * irradiance(v, lit_by({s}, 1u << 20))[v.at(1, 1, 1)]);
}

TEST(Irradiance, AMovingSourceIsWhereItsStepSays) {
  Volume v(Grid{9, 3, 3});
  put_solid(v, 4, 1, 1);
  rule::Heat moving = lit_by({{0, 24, 24}}, kPower);
  moving.sources[0].keys.push_back({16, {144, 24, 24}, kPower});
  for (std::uint32_t step = 0; step < 20; ++step)
    EXPECT_EQ(irradiance(v, moving, step),
              irradiance(v, lit_by({{std::min(9 * std::int64_t{step}, std::int64_t{144}), 24, 24}}, kPower)));
}

// Half-way and one step to power (2^22 - 1) 2^28, 2^17 sixteenths above: the cell gets
// (2^22 - 1) 2^14 x 8193 / 2^34 = 4 x 8193 - 8193 / 2^20.
TEST(Irradiance, OfASourceThatGrowsToTheMostPower) {
  Volume v(Grid{3, 3, 3});
  put_solid(v, 1, 1, 1);
  const Position far{24, 24 + (1 << 17), 24};
  rule::Heat growing = lit_by({far}, 0);
  growing.sources[0].keys.push_back({16384, far, std::uint64_t{4194303} << 28});
  EXPECT_EQ(irradiance(v, growing, 8193)[v.at(1, 1, 1)], 32771);
}

// Between refreshes: a cell exposed by melting has no irradiance yet, and the melted one takes no more.
TEST(Refresh, ExposedCellsWaitAndMeltedCellsStop) {
  Parameters p = viscous(0.02);
  p.heat = lit_by({{16 * 5 + 8, 16 * 30, 16 * 5 + 8}},
                  std::uint64_t{256} * 1600 * 651);  // 100 units a step on top
  p.heat.visibility_every = 10;
  p.material.melting_point = 500;
  Volume v(Grid{11, 11, 11});
  for_each({5, 3, 5, 6, 5, 6}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  run::Simulation s = simulate(p, v);
  const state::Slot lower = v.at(5, 3, 5);
  bool melted = false;
  state::Sum taken = 0;  // by the upper cell, until it melted
  for (int i = 0; i < 20; ++i) {
    s.step();
    const bool now = !s.volume().solid.test(5, 4, 5);
    if (!melted && now) {
      EXPECT_LT(i, 8) << "it melts well between two refreshes";
      taken = s.ledger().heat.radiated;
    }
    melted = melted || now;
    if (i < 10) {
      EXPECT_EQ(s.volume().heat[lower], 0) << "hidden or waiting, step " << i;
    }
    if (melted && i < 10) {
      EXPECT_EQ(s.ledger().heat.radiated, taken) << "the melted cell takes no more";
    }
  }
  EXPECT_TRUE(melted);
  EXPECT_GT(s.volume().heat[lower] + !s.volume().solid.test(5, 3, 5), 0) << "lit after the refresh";
}

}  // namespace
}  // namespace voxmelt::visibility
