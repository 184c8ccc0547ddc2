// The irradiance of each solid cell is compared with brute force on random grids, and with worlds of a known
// answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "kernel/engine/visibility/visibility.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::visibility {
namespace {

using namespace worlds;
using rule::Position;

rule::Heat lit_by(const std::vector<Position>& sources, std::uint64_t power) {
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

// Tells whether no opaque cell cuts the open segment from `c` to `s`. An exact slab test asks every cell of
// the grid.
bool clear(const Volume& v, std::array<std::int64_t, 3> c, Position s) {
  const std::array<std::int64_t, 3> d{s.x - c[0], s.y - c[1], s.z - c[2]};
  bool hidden = false;
  for_each(whole(v.grid), [&](int bx, int by, int bz) {
    if (hidden || !opaque(v, bx, by, bz)) return;
    // Cuts t in (0, 1) to the part where c + t d is inside the open cell. Fractions are over / under with
    // under > 0.
    std::int64_t low = 0, low_under = 1, high = 1, high_under = 1;
    const std::array<std::int64_t, 3> corner{16 * bx, 16 * by, 16 * bz};
    for (std::size_t a = 0; a < 3; ++a) {
      if (d[a] == 0 && (c[a] <= corner[a] || c[a] >= corner[a] + 16)) return;
      if (d[a] == 0) continue;
      const std::int64_t under = d[a] > 0 ? d[a] : -d[a];
      const std::int64_t first = d[a] > 0 ? corner[a] - c[a] : c[a] - corner[a] - 16;
      if (first * low_under > low * under) {
        low = first;
        low_under = under;
      }
      if ((first + 16) * high_under < high * under) {
        high = first + 16;
        high_under = under;
      }
    }
    hidden = low * high_under < high * low_under;
  });
  return !hidden;
}

// Section 5 is written again: every ray of every face by itself, with the square root in floating point.
std::uint64_t by_the_page(const Volume& v, int x, int y, int z, Position s, std::uint64_t power, int rays) {
  const std::array<std::int64_t, 3> c{16 * x + 8, 16 * y + 8, 16 * z + 8},
      d{s.x - c[0], s.y - c[1], s.z - c[2]};
  const int side = rays == 1 ? 1 : rays == 4 ? 2 : 4;
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (d[a] >= -8 && d[a] <= 8) continue;
    std::array<int, 3> n{x, y, z};
    n[a] += d[a] > 0 ? 1 : -1;
    if (opaque(v, n[0], n[1], n[2])) continue;
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        std::array<std::int64_t, 3> from = c;
        from[a] += d[a] > 0 ? 8 : -8;
        from[(a + 1) % 3] += -8 + 16 * i / side + 8 / side;
        from[(a + 2) % 3] += -8 + 16 * j / side + 8 / side;
        if (clear(v, from, s)) sum += std::abs(d[a]);
      }
  }
  const std::int64_t squared = std::max<std::int64_t>(256, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const auto length =
      static_cast<std::int64_t>(std::floor(std::sqrt(4096.0L * static_cast<long double>(squared))));
  return power * static_cast<std::uint64_t>(64 * sum) /
         (static_cast<std::uint64_t>(squared * length) * static_cast<std::uint64_t>(rays));
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
      put_solid(v, x, y, z,
                random.any({4096, 4096, 1, random.between(1, 65535), random.between(1024, 5120)}));
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
    rule::Heat heat = lit_by(sources, power);
    heat.rays_per_face = random.any({1, 4, 16});
    const state::Field<std::uint16_t> result = irradiance(v, heat);
    for_each(whole(v.grid), [&](int x, int y, int z) {
      std::uint64_t expected = 0;
      if (v.solid.test(x, y, z))
        for (const Position s : sources)
          expected = std::min<std::uint64_t>(
              65535, expected + by_the_page(v, x, y, z, s, power, heat.rays_per_face));
      if (expected > 0) expected = std::min<std::uint64_t>(65535, 4096 * expected / v.amount[v.at(x, y, z)]);
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
  EXPECT_EQ(from({72 + 32, 72 - 32, 72}), 2828) << "16000 (256 / 2048) sqrt 2 = 2828.4";
  EXPECT_EQ(from({72 - 32, 72 + 32, 72 + 32}), 2309) << "16000 (256 / 3072) sqrt 3 = 2309.4";
  EXPECT_EQ(from({72, 72, 72}), 0) << "at its centre no face looks at it";
  EXPECT_EQ(from({80, 72, 72}), 0) << "in the plane of a face";
  EXPECT_EQ(from({81, 72, 72}), 9000) << "just beyond it: as from one cell away, 9 / 16 of the cosine";
  EXPECT_EQ(from({72 + 160, 72, 72}), 160) << "outside the grid";
}

// A cell with a quarter of the matter warms four times as fast. The division comes after the sum over the
// sources and its cut, and has a cut of its own.
TEST(Irradiance, WarmsLessMatterFaster) {
  const auto received = [](std::int32_t amount, std::size_t sources, std::uint64_t at_one_cell) {
    Volume v(Grid{9, 9, 9});
    put_solid(v, 4, 4, 4, amount);
    const std::vector<Position> one_cell_away(sources, Position{72 + 16, 72, 72});
    return irradiance(v, lit_by(one_cell_away, 256 * at_one_cell))[v.at(4, 4, 4)];
  };
  EXPECT_EQ(received(1024, 1, 16000), 64000);
  EXPECT_EQ(received(3000, 2, 1000), 2730) << "floor(4096 x 2000 / 3000); twice 1365 is 2730, too";
  EXPECT_EQ(received(3000, 2, 1001), 2733) << "floor(4096 x 2002 / 3000 = 2733.4); twice 1366 is 2732";
  EXPECT_EQ(received(5120, 1, 16000), 12800);
  EXPECT_EQ(received(1, 1, 16000), 65535);
  EXPECT_EQ(received(8192, 6, 16000), 32767) << "half of 65535, at which the sum was cut";
}

// A cell is cut at 65535, and each source that is cut counts. 16000 times four is not cut, nor is exactly
// 65535; five times 16000 is cut once, six times twice. Power 65535 from one cell away is the limit itself.
TEST(Irradiance, CutsAreCounted) {
  Volume v(Grid{9, 9, 9});
  put_solid(v, 4, 4, 4);
  state::Field<std::uint16_t> result(v.grid);
  const auto cuts = [&](std::size_t sources, std::uint64_t at_one_cell) {
    const Position one_cell_away{72 + 16, 72, 72};
    return VoxelWalkProvider(2).irradiance(
        v, lit_by(std::vector<Position>(sources, one_cell_away), 256 * at_one_cell), 0, result);
  };
  EXPECT_EQ(cuts(4, 16000), 0);
  EXPECT_EQ(result[v.at(4, 4, 4)], 64000);
  EXPECT_EQ(cuts(5, 16000), 1);
  EXPECT_EQ(result[v.at(4, 4, 4)], 65535);
  EXPECT_EQ(cuts(6, 16000), 2);
  EXPECT_EQ(cuts(1, 65535), 0);
  EXPECT_EQ(cuts(1, 65536), 1);
}

// A flat surface receives the cosine, at every angle (the source is 400 cells away).
TEST(Irradiance, AFlatSurfaceReceivesTheCosine) {
  Volume v(Grid{33, 9, 33});
  for_each({0, 0, 0, 33, 4, 33}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  const double distance = 6400, power = 4e11;
  for (const double degrees : {0.0, 20.0, 40.0, 44.0, 46.0, 60.0, 75.0, 85.0})
    for (const double turn : {0.0, 22.5, 45.0, 200.0}) {
      const double angle = degrees * 3.14159265358979 / 180, round = turn * 3.14159265358979 / 180;
      const std::array<double, 3> to{std::sin(angle) * std::cos(round), std::cos(angle),
                                     std::sin(angle) * std::sin(round)};
      const Position s{264 + std::llround(distance * to[0]), 56 + std::llround(distance * to[1]),
                       264 + std::llround(distance * to[2])};
      const double received = irradiance(v, lit_by({s}, static_cast<std::uint64_t>(power)))[v.at(16, 3, 16)];
      EXPECT_NEAR(received / (power / distance / distance), std::cos(angle), 0.001) << degrees << ' ' << turn;
    }
}

TEST(Irradiance, SourceInsideASolidLightsNothingBeyondIt) {
  Volume v(Grid{9, 9, 9});
  for_each({3, 3, 3, 6, 6, 6}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  put_solid(v, 0, 4, 4);
  const state::Field<std::uint16_t> inside = irradiance(v, lit_by({{72, 72, 72}}, 1u << 30));
  for (const std::uint16_t i : inside.stored()) EXPECT_EQ(i, 0);
  // The source lies in the plane of the block's face. It lights the face across, and not that plane.
  const state::Field<std::uint16_t> face = irradiance(v, lit_by({{48, 72, 72}}, 1u << 30));
  EXPECT_EQ(face[v.at(3, 4, 4)], 0);
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

// One-cell-thick walls are tight, also along the diagonals, where only corners touch.
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

// The source is half-way and one step to power (2^22 - 1) 2^28, and 2^17 sixteenths above. The cell gets
// (2^22 - 1) 2^14 x 8193 / 2^34 = 4 x 8193 - 8193 / 2^20.
TEST(Irradiance, OfASourceThatGrowsToTheMostPower) {
  Volume v(Grid{3, 3, 3});
  put_solid(v, 1, 1, 1);
  const Position far{24, 24 + (1 << 17), 24};
  rule::Heat growing = lit_by({far}, 0);
  growing.sources[0].keys.push_back({16384, far, std::uint64_t{4194303} << 28});
  EXPECT_EQ(irradiance(v, growing, 8193)[v.at(1, 1, 1)], 32771);
}

// Between refreshes a cell exposed by melting has no irradiance yet, and the melted one takes no more.
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
  state::Sum taken = 0;  // heat that the upper cell takes until it melts
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
