// The integer walk against an exact test of the segment with every cell of the grid, in rational numbers.
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

// Does the open segment from the centre of `from` to `to` meet the interior of `cell`? Slab test: on each
// axis the open interval of the parameter t in (0, 1); fractions compared by cross-multiplication.
struct Fraction {
  std::int64_t over, under;  // under > 0
};
bool less(Fraction a, Fraction b) { return a.over * b.under < b.over * a.under; }

bool meets_interior(Cell from, Position to, Cell cell) {
  const std::array<std::int64_t, 3> start{16 * std::get<0>(from) + 8, 16 * std::get<1>(from) + 8,
                                          16 * std::get<2>(from) + 8};
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
    const Cell from{random.below(6), random.below(6), random.below(6)};
    // Any point; a face, edge or corner point; a cell centre; far outside.
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
    const Position to{coordinate(), coordinate(), coordinate()};
    std::set<Cell> walked;
    std::size_t count = 0;
    for (rule::VoxelWalk walk(std::get<0>(from), std::get<1>(from), std::get<2>(from), to); walk.next();
         ++count)
      walked.insert({walk.x(), walk.y(), walk.z()});
    ASSERT_EQ(walked.size(), count) << "no cell twice";
    std::set<Cell> expected;
    for_each({-4, -4, -4, 10, 10, 10}, [&](int x, int y, int z) {
      if (Cell{x, y, z} != from && meets_interior(from, to, {x, y, z})) expected.insert({x, y, z});
    });
    ASSERT_EQ(walked, expected) << "to " << to.x << ' ' << to.y << ' ' << to.z;
  }
}

TEST(VoxelWalk, ThroughACornerTouchesNothing) {
  rule::VoxelWalk walk(0, 0, 0, {40, 40, 40});  // along the space diagonal
  ASSERT_TRUE(walk.next());
  EXPECT_EQ((std::tuple{walk.x(), walk.y(), walk.z()}), (Cell{1, 1, 1}));
  ASSERT_TRUE(walk.next());
  EXPECT_EQ((std::tuple{walk.x(), walk.y(), walk.z()}), (Cell{2, 2, 2}));
  EXPECT_FALSE(walk.next());
}

TEST(VoxelWalk, AtDistanceZeroAndOnTheOwnFaceGoesNowhere) {
  EXPECT_FALSE(rule::VoxelWalk(2, 3, 4, {40, 56, 72}).next());
  EXPECT_FALSE(rule::VoxelWalk(2, 3, 4, {48, 56, 72}).next()) << "on the own face";
  EXPECT_FALSE(rule::VoxelWalk(2, 3, 4, {48, 64, 80}).next()) << "on the own corner";
  EXPECT_TRUE(rule::VoxelWalk(2, 3, 4, {49, 56, 72}).next());
}

TEST(Irradiance, FallsWithTheSquareAndGrowsWithTheAxes) {
  const std::uint64_t power = 4096ull * 256 * 1000;
  EXPECT_EQ(rule::irradiance(power, 256, 1), 4096u * 1000);
  EXPECT_EQ(rule::irradiance(power, 1024, 1), 4096u * 250);
  EXPECT_EQ(rule::irradiance(power, 0, 1), rule::irradiance(power, 256, 1)) << "no nearer than one cell";
  EXPECT_EQ(rule::irradiance(power, 255, 3), rule::irradiance(power, 256, 3));
  EXPECT_EQ(rule::irradiance(power, 256, 2), 5793u * 1000);
  EXPECT_EQ(rule::irradiance(power, 256, 3), 7094u * 1000);
  EXPECT_EQ(rule::irradiance(power, 256, 0), 0u);
  EXPECT_EQ(rule::irradiance(4095, 256, 1), 15u);  // floor
  EXPECT_EQ(rule::irradiance((std::uint64_t{1} << 50) - 1, 256, 3), 7617124499455u) << "50 + 13 bits";
}

TEST(SourcePath, MovesLinearlyAndFloors) {
  const rule::PointSource source{
      {{10, {100, -100, 0}, 1000}, {13, {90, -110, 1}, 0}, {20, {90, -110, 1}, 7}}};
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
