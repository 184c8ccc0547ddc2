// The casters of this room, and the surface by words, agree with rule::VoxelWalk and the page.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "kernel/engine/visibility/brick_walk.h"
#include "kernel/engine/visibility/gaps.h"
#include "kernel/engine/visibility/surface.h"
#include "kernel/engine/visibility/two_level.h"
#include "tests/kernel/engine/visibility/caster_check.h"

namespace voxmelt::visibility {
namespace {

TEST(Casters, OfHostileWorldsAgreeWithTheWalk) {
  PlainCaster plain;
  check_hostile_worlds({&plain}, 60, 71);
  TwoLevelCaster two_level;
  check_hostile_worlds({&two_level}, 200, 72);
}

TEST(Casters, OfFiveScenesAndFiftySourcesAgreeWithTheWalk) {
  TwoLevelCaster two_level;
  check_scenes({&two_level}, 50);
}

// Follows a ray step by step, from brick to brick, and straight into each brick. The cells are those of
// VoxelWalk, in 64 bits and in 128.
template <class Whole>
void follow(const Ray& ray) {
  std::vector<Cell> cells;
  rule::VoxelWalk plain(ray.cell, ray.start, ray.end);
  while (cells.size() < 400 && plain.next()) cells.push_back({plain.x(), plain.y(), plain.z()});
  const bool ends = cells.size() < 400;
  const Course course(ray);
  BrickWalk<Whole> walk(ray.cell, course);
  for (const Cell& cell : cells) {
    ASSERT_TRUE(walk.step());
    ASSERT_EQ(walk.cell(), cell);
  }
  ASSERT_TRUE(!ends || !walk.step());

  BrickWalk<Whole> by_bricks(ray.cell, course);
  Cell last = ray.cell;
  for (const Cell& cell : cells) {
    const Cell first{cell[0] & ~7, cell[1] & ~7, cell[2] & ~7};
    if (by_bricks.same_brick(cell)) continue;
    ASSERT_TRUE(by_bricks.leave(1));
    ASSERT_EQ(by_bricks.cell(), cell) << "the first beyond the brick of " << last[0];
    BrickWalk<Whole> into(ray.cell, course);
    ASSERT_TRUE(into.enter(first));
    ASSERT_EQ(into.cell(), cell);
    for (std::size_t a = 0; a < 3; ++a) {  // a brick beside it that the walk may miss
      Cell beside = first;
      beside[a] += 8;
      const auto in_it = [&](const Cell& c) {
        return ((c[0] ^ beside[0]) | (c[1] ^ beside[1]) | (c[2] ^ beside[2])) >> 3 == 0;
      };
      BrickWalk<Whole> aside(ray.cell, course);
      const bool enters = aside.enter(beside);
      const auto found = std::find_if(cells.begin(), cells.end(), in_it);
      if (in_it(ray.cell)) {
        ASSERT_TRUE(enters && aside.cell() == ray.cell);
      } else if (found != cells.end() || ends) {
        ASSERT_EQ(enters, found != cells.end());
        ASSERT_TRUE(!enters || aside.cell() == *found);
      }
    }
    last = cell;
  }
  ASSERT_TRUE(!ends || !by_bricks.leave(1));
}

// Leaves cubes of bricks, of all sides, and arrives at the first cell of VoxelWalk that lies beyond.
template <class Whole>
void follow_cubes(const Ray& ray, Random& random) {
  const Course course(ray);
  BrickWalk<Whole> walk(ray.cell, course);
  rule::VoxelWalk plain(ray.cell, ray.start, ray.end);
  for (int jump = 0; jump < 12; ++jump) {
    const int side = random.any({1, 1, 2, 3, 7, 20, 254});
    const Cell from = walk.cell();
    const auto within = [&](std::size_t a, int at) {
      const int there = at >> 3, here = from[a] >> 3;
      return course.way[a] > 0 ? there >= here && there < here + side : there <= here && there > here - side;
    };
    Cell at = from;
    bool ends = false;
    while (!ends && within(0, at[0]) && within(1, at[1]) && within(2, at[2])) {
      ends = !plain.next();
      at = {plain.x(), plain.y(), plain.z()};
    }
    ASSERT_EQ(walk.leave(side), !ends) << "side " << side;
    if (ends) return;
    ASSERT_EQ(walk.cell(), at) << "side " << side;
  }
}

TEST(BrickWalk, IsTheWalk) {
  __extension__ using Wide = __int128;
  Random random(5);
  const Grid g{40, 40, 40};
  for (int trial = 0; trial < 6000; ++trial) {
    const Cell cell{random.below(40), random.below(40), random.below(40)};
    std::array<std::int64_t, 3> start{};
    for (std::size_t a = 0; a < 3; ++a) start[a] = 16 * cell[a] + random.any({2, 6, 8, 10, 14});
    const std::size_t axis = static_cast<std::size_t>(random.below(3));
    start[axis] = 16 * cell[axis];
    Position source = awkward_source(random, g);
    (axis == 0   ? source.x
     : axis == 1 ? source.y
                 : source.z) = start[axis] + random.any({1, 8, 16, 100, 128, 500, 100000, 40000000});
    const Ray ray{cell, {start[0], start[1], start[2]}, source};
    if (Course(ray).narrow()) {
      follow<std::int64_t>(ray);
      follow_cubes<std::int64_t>(ray, random);
    }
    follow<Wide>(ray);
    follow_cubes<Wide>(ray, random);
    if (HasFailure()) FAIL() << "trial " << trial;
  }
}

// The longest course that counts as narrow goes from corner to corner of the largest grid. No number
// overflows.
TEST(BrickWalk, TheLongestNarrowCourse) {
  const Position source{kLongestNarrow, kLongestNarrow - 8, kLongestNarrow - 24};
  const Ray ray{{0, 0, 0}, {0, 6, 14}, source};
  const Course course(ray);
  ASSERT_TRUE(course.narrow());
  BrickWalk<std::int64_t> walk(ray.cell, course);
  rule::VoxelWalk plain(ray.cell, ray.start, ray.end);
  for (int cells = 0; plain.next() && plain.x() < 4096; ++cells) {
    ASSERT_TRUE(walk.step());
    ASSERT_EQ(walk.cell(), (Cell{plain.x(), plain.y(), plain.z()})) << cells;
  }
  EXPECT_GE(walk.cell()[0], 4095);
}

// The bricks hold an opaque cell each, away from the diagonal.
Volume cluttered_world() {
  Volume v({40, 40, 40});
  for (int z = 0; z < 40; z += 8)
    for (int y = 0; y < 40; y += 8)
      for (int x = 0; x < 40; x += 8) put_solid(v, x, y + 7, z);
  return v;
}

struct Seen {
  Opaque opaque;
  Gaps gaps;
  explicit Seen(const Volume& v) {
    cpu::Workers workers(1);
    const Opaque::News news = opaque.take(v, workers);
    gaps.update(opaque, news);
  }
};

// A ray from corner to corner that passes no edge of a brick meets as many bricks as a ray can.
TEST(TwoLevel, TheLongestPathIsFollowedToItsEnd) {
  const Seen seen(cluttered_world());
  const Ray ray{{0, 0, 0}, {0, 2, 5}, {640, 641, 643}};
  BrickWalk<std::int64_t> walk(ray.cell, Course(ray));
  std::set<std::size_t> bricks{seen.opaque.brick_at(walk.cell())};
  while (walk.step() && seen.opaque.contains(walk.cell())) bricks.insert(seen.opaque.brick_at(walk.cell()));
  EXPECT_EQ(bricks.size(), 5u + 5 + 5 - 2);
  EXPECT_EQ(two_level_fate(seen.opaque, seen.gaps, ray), kSees);
}

// Stays where it is, whatever it says, as a walk that misses an exact tie of two planes would.
class WalkThatStandsStill {
 public:
  enum class End { stopped, arrived, left };
  const Cell& cell() const { return cell_; }
  std::size_t octant() const { return 7; }
  bool leave(int /*side*/) { return ++asked_ > 0; }
  template <class Test>
  End within(std::uint32_t& /*number*/, const Test& /*test*/) {
    ++asked_;
    return End::left;
  }
  int asked() const { return asked_; }

 private:
  Cell cell_{0, 0, 0};
  int asked_ = 0;
};

TEST(TwoLevel, AWalkThatStandsStillIsAnError) {
  const Seen seen(cluttered_world());
  WalkThatStandsStill walk;
  EXPECT_THROW(follow_to_end(seen.opaque, seen.gaps, walk), std::logic_error);
  EXPECT_EQ(walk.asked(), 5 + 5 + 5 - 2) << "once for each brick on the longest path";
}

// No face that has a ray is forgotten. For points and suns, all faces that may look have rays.
TEST(Surface, ByWordsHasTheFacesOfThePage) {
  Random random(9);
  cpu::Workers workers(1);
  std::size_t looking = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Volume v = hostile_world(random, hostile_grid(random));
    const Shine shine = awkward_shine(random, v.grid);
    Opaque opaque;
    opaque.take(v, workers);
    const Surface surface(v.grid, shine.kind, shine.key);
    const auto looks = [&](const Cell& cell, int face) {
      const auto words = surface.faces(opaque, static_cast<std::size_t>(cell[0]) / 64, cell[1], cell[2]);
      return (words.at(static_cast<std::size_t>(face)) >> (cell[0] & 63) & 1) != 0;
    };
    const std::vector<PageRay> rays = page_rays(v, shine, 2, 1);
    std::set<std::pair<Cell, int>> with_rays;
    for (const PageRay& ray : rays) {
      ASSERT_TRUE(looks(ray.cell, ray.face)) << "trial " << trial;
      with_rays.insert({ray.cell, ray.face});
    }
    std::size_t faces = 0;
    for_each(whole(v.grid), [&](int x, int y, int z) {
      for (int f = 0; f < 6; ++f) {
        if (!looks({x, y, z}, f)) continue;
        ++faces;
        Cell beyond{x, y, z};
        beyond[static_cast<std::size_t>(f) / 2] += f % 2 == 0 ? 1 : -1;
        ASSERT_TRUE(v.solid.test(x, y, z) && !page::opaque(v, beyond));
      }
    });
    if (shine.kind == rule::SourceKind::point || shine.kind == rule::SourceKind::directional) {
      ASSERT_EQ(faces, with_rays.size()) << "trial " << trial;
    }
    looking += faces;
  }
  EXPECT_GT(looking, 20000u);
}

TEST(Opaque, TellsWhatIsNew) {
  Random random(4);
  cpu::Workers workers(2);
  Opaque opaque;
  Volume v = hostile_world(random, {70, 9, 17});
  put_solid(v, 69, 8, 16);
  EXPECT_TRUE(opaque.take(v, workers).appeared);
  EXPECT_FALSE(opaque.take(v, workers).any());
  v.solid.set(69, 8, 16, false);
  const Opaque::News melted = opaque.take(v, workers);
  EXPECT_TRUE(melted.vanished && !melted.appeared);
  EXPECT_EQ(opaque.changed_about(0, 16) & 0x1ff, 3u << 7);
  EXPECT_EQ(opaque.changed_about(0, 15), 1u << 8);
  EXPECT_EQ(opaque.changed_about(0, 14), 0u);
  put_inert(v, 69, 8, 16);
  EXPECT_TRUE(opaque.take(v, workers).appeared);
  v.inert.set(69, 8, 16, false);
  v.solid.set(69, 8, 16, true);
  const Opaque::News turned = opaque.take(v, workers);
  EXPECT_TRUE(turned.turned && !turned.appeared && !turned.vanished);
  for (int round = 0; round < 20; ++round) {
    for_each(whole(v.grid), [&](int x, int y, int z) {
      if (random.one_in(20)) v.solid.set(x, y, z, !v.solid.test(x, y, z));
    });
    opaque.take(v, workers);
    std::vector<bool> filled(opaque.bricks().cells());
    for_each({-1, -1, -1, 71, 10, 18}, [&](int x, int y, int z) {
      const Cell cell{x, y, z};
      ASSERT_EQ(opaque.test(cell), page::opaque(v, cell)) << x << ' ' << y << ' ' << z;
      if (page::opaque(v, cell)) filled[opaque.brick_at(cell)] = true;
    });
    for (std::size_t brick = 0; brick < filled.size(); ++brick)
      ASSERT_EQ(opaque.empty(brick), !filled[brick]);
  }
}

}  // namespace
}  // namespace voxmelt::visibility
