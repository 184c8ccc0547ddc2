// Gaps, and the clear way ahead in a brick, agree with a look at every brick and cell that they speak of.
#include "kernel/engine/visibility/gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "tests/kernel/engine/visibility/ray_worlds.h"

namespace voxmelt::visibility {
namespace {

// Holds the first and the last brick of the cube of `side` bricks that begins at `at`, along one axis.
struct Range {
  Range(int at, int side, bool up, int size)
      : first(std::max(0, up ? at : at - side + 1)), last(std::min(size - 1, up ? at + side - 1 : at)) {}
  int first, last;
};

bool all_empty(const Opaque& opaque, const Cell& at, int side, std::size_t octant) {
  const state::Grid& g = opaque.bricks();
  const Range x(at[0], side, (octant & 1) != 0, g.x), y(at[1], side, (octant & 2) != 0, g.y),
      z(at[2], side, (octant & 4) != 0, g.z);
  for (int bz = z.first; bz <= z.last; ++bz)
    for (int by = y.first; by <= y.last; ++by)
      for (int bx = x.first; bx <= x.last; ++bx)
        if (!opaque.empty(g.index(bx, by, bz))) return false;
  return true;
}

struct Found {
  std::size_t endless = 0, wide = 0, largest = 0;
};

// Expects that every gap holds. If the gaps have just been found, none could be wider.
void check_gaps(const Gaps& gaps, const Opaque& opaque, bool fresh, Found& found) {
  const state::Grid& g = opaque.bricks();
  const int whole_grid = std::max({g.x, g.y, g.z});
  for_each(whole(g), [&](int x, int y, int z) {
    for (std::size_t octant = 0; octant < 8; ++octant) {
      const int gap = gaps.at(octant, g.index(x, y, z));
      const bool endless = gap == Gaps::kEndless;
      const std::string where = std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(z) +
                                ", octant " + std::to_string(octant);
      if (endless) {
        ASSERT_TRUE(all_empty(opaque, {x, y, z}, whole_grid, octant)) << where;
      } else if (gap > 0) {
        ASSERT_TRUE(all_empty(opaque, {x, y, z}, gap, octant)) << where << ", " << gap;
      }
      if (fresh && !endless) {
        ASSERT_FALSE(all_empty(opaque, {x, y, z}, gap + 1, octant)) << where << ", " << gap;
      }
      found.endless += endless;
      found.wide += !endless && gap > 1;
      if (!endless) found.largest = std::max(found.largest, static_cast<std::size_t>(gap));
    }
  });
}

// The worlds have a few cells, which appear, and then vanish one after the other.
TEST(Gaps, AreAsWideAsTheyCanBe) {
  Random random(31);
  cpu::Workers workers(1);
  Found found;
  Opaque opaque;
  Gaps gaps;
  for (int world = 0; world < 40; ++world) {
    const auto side = [&] { return random.between(1, 90); };
    Volume v(Grid{side(), side(), side()});
    for (int n = random.below(12); n > 0; --n)
      put_any(v, random, random.below(v.grid.x), random.below(v.grid.y), random.below(v.grid.z));
    gaps.update(opaque, opaque.take(v, workers));
    ASSERT_NO_FATAL_FAILURE(check_gaps(gaps, opaque, true, found)) << "world " << world;
    for (int melt = 0; melt < 3; ++melt) {
      for_each(whole(v.grid), [&](int x, int y, int z) {
        if (v.solid.test(x, y, z) && random.one_in(4)) v.solid.set(x, y, z, false);
      });
      gaps.update(opaque, opaque.take(v, workers));
      ASSERT_NO_FATAL_FAILURE(check_gaps(gaps, opaque, false, found)) << "world " << world << " melts";
    }
    put_inert(v, random.below(v.grid.x), random.below(v.grid.y), random.below(v.grid.z));
    gaps.update(opaque, opaque.take(v, workers));
    ASSERT_NO_FATAL_FAILURE(check_gaps(gaps, opaque, true, found)) << "world " << world << ", a new cell";
  }
  EXPECT_GT(found.endless, 10000u);
  EXPECT_GT(found.wide, 10000u);
  EXPECT_GT(found.largest, 5u);
}

// After half of the bricks have emptied, the gaps grow.
TEST(Gaps, AreFoundAnewAsBricksEmpty) {
  Volume v(Grid{80, 8, 8});
  for (int x = 0; x < 80; x += 8) put_solid(v, x, 0, 0);
  cpu::Workers workers(1);
  Opaque opaque;
  Gaps gaps;
  gaps.update(opaque, opaque.take(v, workers));
  EXPECT_EQ(gaps.at(1, 0), 0);
  for (int x = 0; x < 40; x += 8) v.solid.set(x, 0, 0, false);
  gaps.update(opaque, opaque.take(v, workers));
  for (std::size_t brick = 0; brick < 5; ++brick) {
    EXPECT_EQ(gaps.at(1, brick), 5 - static_cast<int>(brick)) << "upwards, to the sixth brick";
    EXPECT_EQ(gaps.at(0, brick), Gaps::kEndless) << "downwards";
  }
}

// Another grid has as many bricks, and nothing stands in it.
TEST(Gaps, OfAnotherGridAreFoundAnew) {
  Volume full(Grid{16, 8, 8});
  put_solid(full, 0, 0, 0);
  put_solid(full, 8, 0, 0);
  cpu::Workers workers(1);
  Opaque opaque;
  Gaps gaps;
  gaps.update(opaque, opaque.take(full, workers));
  EXPECT_EQ(gaps.at(0, 1), 0);
  gaps.update(opaque, opaque.take(Volume(Grid{8, 16, 8}), workers));
  for (std::size_t octant = 0; octant < 8; ++octant) EXPECT_EQ(gaps.at(octant, 1), Gaps::kEndless);
}

// The largest grid has gaps of more bricks than a byte counts.
TEST(Gaps, OfTheLargestGrid) {
  Volume v(Grid{4096, 8, 1});
  put_inert(v, 4095, 0, 0);
  cpu::Workers workers(1);
  Opaque opaque;
  Gaps gaps;
  gaps.update(opaque, opaque.take(v, workers));
  EXPECT_EQ(gaps.at(1, 511), 0);
  EXPECT_EQ(gaps.at(1, 400), 111);
  EXPECT_EQ(gaps.at(1, 511 - 254), 254);
  EXPECT_EQ(gaps.at(1, 511 - 255), 254);
  EXPECT_EQ(gaps.at(1, 0), 254);
  EXPECT_EQ(gaps.at(0, 400), Gaps::kEndless);
}

TEST(Opaque, KnowsWhatIsClearAheadInABrick) {
  Random random(12);
  cpu::Workers workers(1);
  std::size_t clear = 0, blocked = 0;
  for (int world = 0; world < 60; ++world) {
    Volume v(Grid{16, 8, 16});
    for (int n = random.between(1, 12); n > 0; --n)
      put_solid(v, random.below(16), random.below(8), random.below(16));
    Opaque opaque;
    opaque.take(v, workers);
    for_each(whole(v.grid), [&](int x, int y, int z) {
      const std::size_t octant = static_cast<std::size_t>(random.below(8));
      bool any = false;
      const auto end = [&](int at, std::size_t axis) { return (octant >> axis & 1) != 0 ? at | 7 : at & ~7; };
      const auto [x0, x1] = std::minmax({x, end(x, 0)});
      const auto [y0, y1] = std::minmax({y, end(y, 1)});
      const auto [z0, z1] = std::minmax({z, end(z, 2)});
      for_each({x0, y0, z0, x1 + 1, y1 + 1, z1 + 1},
               [&](int cx, int cy, int cz) { any |= v.solid.test(cx, cy, cz); });
      const Cell cell{x, y, z};
      ASSERT_EQ(opaque.clear_ahead(opaque.brick_at(cell), cell, octant), !any)
          << x << ' ' << y << ' ' << z << ", octant " << octant;
      ++(any ? blocked : clear);
    });
  }
  EXPECT_GT(clear, 10000u);
  EXPECT_GT(blocked, 10000u);
}

}  // namespace
}  // namespace voxmelt::visibility
