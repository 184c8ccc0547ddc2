// The integer walk agrees with an exact test of the segment with every cell of the grid, in rational numbers.
#include "kernel/automaton/rule/visibility.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>

#include "kernel/automaton/rule/source.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::visibility {
namespace {

using namespace worlds;
using rule::Position;
using Cell = std::tuple<int, int, int>;

// Tells whether the open segment from `from` to `to` meets the interior of `cell`. The slab test finds, on
// each axis, the open interval of the parameter t in (0, 1). Fractions are compared by cross-multiplication.
struct Fraction {
  std::int64_t over, under;  // under > 0
};
bool less(Fraction a, Fraction b) { return a.over * b.under < b.over * a.under; }

bool meets_interior(Position from, Position to, Cell cell) {
  const std::array<std::int64_t, 3> start{from.x, from.y, from.z};
  const std::array<std::int64_t, 3> end{to.x, to.y, to.z};
  const std::array<std::int64_t, 3> low{16 * std::get<0>(cell), 16 * std::get<1>(cell),
                                        16 * std::get<2>(cell)};
  Fraction enter{0, 1}, leave{1, 1};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t d = end[a] - start[a];
    if (d == 0) {
      if (start[a] <= low[a] || start[a] >= low[a] + 16) return false;
      continue;
    }
    Fraction first{low[a] - start[a], d}, second{low[a] + 16 - start[a], d};
    if (d < 0) {
      first = {start[a] - low[a] - 16, -d};
      second = {start[a] - low[a], -d};
    }
    if (less(enter, first)) enter = first;
    if (less(second, leave)) leave = second;
  }
  return less(enter, leave);
}

TEST(VoxelWalk, CrossesExactlyTheCellsWhoseInteriorTheSegmentMeets) {
  Random random(21);
  for (int trial = 0; trial < 4000; ++trial) {
    // The ray starts in the inside of a cell, or on one of its faces and goes inwards.
    const Cell first{random.below(6), random.below(6), random.below(6)};
    std::array<std::int64_t, 3> start{16 * std::get<0>(first) + random.between(1, 15),
                                      16 * std::get<1>(first) + random.between(1, 15),
                                      16 * std::get<2>(first) + random.between(1, 15)};
    const auto axis = static_cast<std::size_t>(random.below(4));
    const bool upwards = random.one_in(2);
    if (axis < 3) start[axis] = (start[axis] & ~15) + (upwards ? 0 : 16);
    // It ends at any point, a face, edge or corner point, a cell centre, or far outside.
    const auto coordinate = [&]() -> std::int64_t {
      switch (random.below(4)) {
        case 0:
          return 16 * random.between(-1, 7);
        case 1:
          return 16 * random.between(-1, 7) + 8;
        case 2:
          return random.between(-40, 140);
        default:
          return random.between(-8, 104);
      }
    };
    std::array<std::int64_t, 3> end{coordinate(), coordinate(), coordinate()};
    if (axis < 3 && (upwards ? end[axis] <= start[axis] : end[axis] >= start[axis]))
      end[axis] = start[axis] + (upwards ? 1 : -1) * random.between(1, 90);
    const Position from{start[0], start[1], start[2]}, to{end[0], end[1], end[2]};
    std::set<Cell> walked;
    std::size_t count = 0;
    for (rule::VoxelWalk walk({std::get<0>(first), std::get<1>(first), std::get<2>(first)}, from, to);
         walk.next(); ++count)
      walked.insert({walk.x(), walk.y(), walk.z()});
    ASSERT_EQ(walked.size(), count) << "no cell twice";
    std::set<Cell> expected;
    for_each({-7, -7, -7, 13, 13, 13}, [&](int x, int y, int z) {
      if (Cell{x, y, z} != first && meets_interior(from, to, {x, y, z})) expected.insert({x, y, z});
    });
    ASSERT_EQ(walked, expected) << "to " << to.x << ' ' << to.y << ' ' << to.z;
  }
}

TEST(VoxelWalk, ThroughACornerTouchesNothing) {
  rule::VoxelWalk walk({0, 0, 0}, {8, 8, 8}, {40, 40, 40});  // along the space diagonal
  ASSERT_TRUE(walk.next());
  EXPECT_EQ((std::tuple{walk.x(), walk.y(), walk.z()}), (Cell{1, 1, 1}));
  ASSERT_TRUE(walk.next());
  EXPECT_EQ((std::tuple{walk.x(), walk.y(), walk.z()}), (Cell{2, 2, 2}));
  EXPECT_FALSE(walk.next());
}

TEST(VoxelWalk, AtDistanceZeroAndOnTheFirstCellsFaceGoesNowhere) {
  const auto next = [](Position to) { return rule::VoxelWalk({2, 3, 4}, {40, 56, 72}, to).next(); };
  EXPECT_FALSE(next({40, 56, 72}));
  EXPECT_FALSE(next({48, 56, 72})) << "on the first cell's face";
  EXPECT_FALSE(next({48, 64, 80})) << "on its corner";
  EXPECT_TRUE(next({49, 56, 72}));
}

TEST(SquareRoot, IsTheGreatestWholeNumberNotAbove) {
  for (const std::uint64_t root :
       {0ull, 1ull, 2ull, 3ull, 511ull, 512ull, 65535ull, 1ull << 30, (1ull << 31) - 1, (1ull << 32) - 1}) {
    EXPECT_EQ(rule::square_root(root * root), root);
    EXPECT_EQ(rule::square_root(root * root + 2 * root), root) << "the greatest number below the next square";
    if (root > 0) {
      EXPECT_EQ(rule::square_root(root * root - 1), root - 1);
    }
  }
}

TEST(Irradiance, FallsWithTheSquareAndTheCosine) {
  const std::uint64_t power = 256ull * 1000;
  EXPECT_EQ(rule::irradiance(power, 16, 1, 256), 1000u);
  EXPECT_EQ(rule::irradiance(power, 32, 1, 1024), 250u);
  EXPECT_EQ(rule::irradiance(power, 8, 1, 256), 500u) << "at 60 degrees";
  EXPECT_EQ(rule::irradiance(power, 15, 1, 225), 937u) << "no nearer than one cell: 1000 x 15 / 16, floored";
  EXPECT_EQ(rule::irradiance(power, 64, 4, 256), 1000u) << "four rays of one face";
  EXPECT_EQ(rule::irradiance(power, 7 * 16, 16, 256), 437u) << "seven of sixteen rays";
  EXPECT_EQ(rule::irradiance(power, 0, 1, 256), 0u);
  // 1000 x 256 x 48 / 768^1.5 is 577.35. The length is floored: 64 sqrt(768) = 1773.6.
  EXPECT_EQ(rule::irradiance(power, 48, 1, 768), 577u) << "all three faces along the space diagonal";
  // Some products are wider than 64 bits: (2^50 - 1) 64 2^20 / (2^40 2^26) = 2^10 - 2^-40.
  EXPECT_EQ(rule::irradiance((std::uint64_t{1} << 50) - 1, 1 << 20, 1, std::uint64_t{1} << 40), 1023u);
  EXPECT_EQ(rule::irradiance((std::uint64_t{1} << 50) - 1, 3ll << 25, 1, 3ull << 50), 0u) << "0.577";
}

TEST(SourcePath, MovesLinearlyAndFloors) {
  const rule::HeatSource source{{{10, {100, -100, 0}, 1000}, {13, {90, -110, 1}, 0}, {20, {90, -110, 1}, 7}}};
  const auto at = [&](std::uint32_t step) { return rule::source_at(source, step); };
  EXPECT_EQ(at(0).at.x, 100);
  EXPECT_EQ(at(10).power, 1000u);
  EXPECT_EQ(at(11).at.x, 96);    // 100 + floor(-10 / 3)
  EXPECT_EQ(at(11).at.y, -104);  // -100 + floor(-10 / 3)
  EXPECT_EQ(at(12).at.x, 93);    // 100 + floor(-20 / 3)
  EXPECT_EQ(at(11).at.z, 0);
  EXPECT_EQ(at(12).at.z, 0);
  EXPECT_EQ(at(11).power, 666u);  // 1000 + floor(-1000 / 3)
  EXPECT_EQ(at(13).at.x, 90);
  EXPECT_EQ(at(13).power, 0u);
  EXPECT_EQ(at(19).power, 6u);
  EXPECT_EQ(at(20).power, 7u);
  EXPECT_EQ(at(4000000000u).power, 7u);
}

}  // namespace
}  // namespace voxmelt::visibility
