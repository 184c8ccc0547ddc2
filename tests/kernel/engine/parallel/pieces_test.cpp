// Pieces that nothing holds fall, in every implementation: by hand, and alike in random worlds.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernel/automaton/state/connectivity.h"
#include "kernel/engine/parallel/local_parts.h"
#include "kernel/engine/parallel/loose_pieces.h"
#include "kernel/engine/visibility/visibility.h"
#include "tests/kernel/engine/parallel/equal.h"

namespace voxmelt::parallel {
namespace {

using namespace worlds;

void fill_solid(Volume& v, const Box& b, std::int32_t heat = 0) {
  for_each(b, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, heat); });
}

class Pieces : public testing::TestWithParam<std::string> {
 protected:
  // Lets pieces fall in so many steps, and nothing else happen. It tells in how many of them any did.
  int fall(Volume& v, int count, rule::Pieces how = {}, std::uint32_t first = 0) {
    Parameters p = viscous(0.02);
    how.fall = true;
    p.pieces = how;
    const auto stepper = implementation(GetParam()).create(p, v.grid, {});
    auto& host = dynamic_cast<step::HostStepper&>(*stepper);
    int moved = 0;
    for (int i = 0; i < count; ++i) {
      moved += host.let_pieces_fall(first + static_cast<std::uint32_t>(i), v);
      EXPECT_EQ(broken_invariant(v, p), "") << "step " << i;
    }
    return moved;
  }
};

TEST_P(Pieces, APlateLandsFlatAfterAsManyStepsAsItIsHigh) {
  Volume v(Grid{70, 12, 5}), landed(v.grid);
  fill_inert(v, {0, 0, 0, 70, 1, 5});
  landed = v;
  fill_solid(v, {60, 9, 1, 68, 10, 4});  // over the end of a word
  fill_solid(landed, {60, 1, 1, 68, 2, 4});
  EXPECT_EQ(fall(v, 20), 8);
  EXPECT_TRUE(v == landed);
}

TEST_P(Pieces, WhatLiesBelowComesOutAbove) {
  Volume v(Grid{3, 7, 1}), turned(v.grid);
  fill_solid(v, {1, 3, 0, 2, 6, 1});
  put(v, 1, 2, 0, 1234);
  fill_solid(turned, {1, 2, 0, 2, 5, 1});
  put(turned, 1, 5, 0, 1234);
  EXPECT_EQ(fall(v, 1), 1);
  EXPECT_TRUE(v == turned);
}

TEST_P(Pieces, AnInertNeighbourHoldsAndTheSidesOfTheGridDoNot) {
  Volume v(Grid{9, 6, 9});
  fill_solid(v, {0, 4, 0, 2, 5, 2});  // in a corner of the grid
  put_inert(v, 6, 4, 6);
  fill_solid(v, {7, 4, 6, 9, 5, 7});  // beside an inert cell
  put_solid(v, 6, 3, 3);
  put_inert(v, 7, 2, 3);  // only an edge is common
  EXPECT_EQ(fall(v, 1), 1);
  EXPECT_TRUE(v.solid.test(0, 3, 0) && v.solid.test(1, 3, 1) && !v.solid.test(0, 4, 0));
  EXPECT_TRUE(v.solid.test(7, 4, 6) && v.solid.test(8, 4, 6));
  EXPECT_TRUE(v.solid.test(6, 2, 3));
  EXPECT_EQ(fall(v, 5), 3) << "the corner lands after three more, the other is held by the inert cell";
  EXPECT_TRUE(v.solid.test(6, 2, 3));
}

TEST_P(Pieces, AStackClosesAndACageFallsOverAPost) {
  Volume v(Grid{11, 14, 11});
  fill_solid(v, {1, 3, 1, 3, 4, 3});
  fill_solid(v, {1, 5, 1, 3, 6, 3});
  fill_solid(v, {1, 9, 1, 3, 10, 3});
  fill_solid(v, {5, 7, 5, 10, 13, 10});  // the cage is open below
  for_each({6, 7, 6, 9, 11, 9}, [&](int x, int y, int z) {
    put(v, x, y, z, 0);
    v.solid.set(x, y, z, false);
  });
  fill_inert(v, {7, 0, 7, 8, 6, 8});  // the post
  EXPECT_EQ(fall(v, 30), 7);
  EXPECT_EQ(v.solid.count(), 3 * 4 + 5 * 5 * 6 - 3 * 3 * 4);
  for (const int y : {0, 1, 2}) EXPECT_TRUE(v.solid.test(1, y, 1)) << y;
  // The cage's ceiling, 11 high, stops on the post, whose top is at 5.
  EXPECT_TRUE(v.solid.test(7, 6, 7));
  EXPECT_TRUE(v.solid.test(5, 2, 5) && !v.solid.test(5, 1, 5));
}

// A cube of 8 in a pool: in_liquid steps for a cell, and half of it under the surface at density 1/2.
TEST_P(Pieces, SinkSlowlyAndFloat) {
  const auto pool = [] {
    Volume v(Grid{20, 30, 20});
    fill(v, {0, 0, 0, 20, 12, 20}, kOne);
    fill_solid(v, {6, 12, 6, 14, 20, 14});
    return v;
  };
  Volume sinking = pool();
  EXPECT_EQ(fall(sinking, 12, {true, 3}), 4) << "steps 0, 3, 6, 9";
  EXPECT_TRUE(sinking.solid.test(6, 8, 6) && !sinking.solid.test(6, 7, 6));
  EXPECT_EQ(fall(sinking, 60, {true, 1}), 8) << "and on to the ground";

  Volume floating = pool();
  EXPECT_EQ(fall(floating, 40, {true, 2, rule::kDensityOne / 2}), 4);
  EXPECT_TRUE(floating.solid.test(6, 8, 6) && !floating.solid.test(6, 7, 6));
  std::int64_t mass = 0;
  for_each(whole(floating.grid), [&](int x, int y, int z) { mass += floating.amount[floating.at(x, y, z)]; });
  EXPECT_EQ(mass, std::int64_t{kOne} * (20 * 20 * 12 + 512));
}

// A disc of 9 x 9 hangs on a post of two cells, and its rim reaches into the pool: of its layers, the disc's
// is under the surface, but the lowest is dry, in a pit. So nothing counts as sunk.
TEST_P(Pieces, ALayerAboveADryOneIsNotSunk) {
  Volume v(Grid{15, 12, 15});
  fill(v, {0, 0, 0, 15, 8, 15}, kOne);
  for_each({5, 2, 5, 10, 5, 10}, [&](int x, int y, int z) { put(v, x, y, z, 0); });  // the pit
  fill_solid(v, {7, 3, 7, 8, 5, 8});
  fill_solid(v, {3, 5, 3, 12, 7, 12});
  EXPECT_EQ(fall(v, 1, {true, 1, 1000}), 1) << "it would float if layers above the pit counted";
}

// The inert cell that held a piece goes, and no solid does.
TEST_P(Pieces, FallIfTheInertCellGoes) {
  Parameters p = viscous(0.02);
  p.pieces.fall = true;
  Volume v(Grid{6, 6, 6});
  put_inert(v, 2, 4, 2);
  put_solid(v, 3, 4, 2);
  const auto stepper = implementation(GetParam()).create(p, v.grid, {});
  auto& host = dynamic_cast<step::HostStepper&>(*stepper);
  EXPECT_FALSE(host.let_pieces_fall(0, v));
  put(v, 2, 4, 2, 0);
  v.inert.set(2, 4, 2, false);
  EXPECT_TRUE(host.let_pieces_fall(1, v));
}

// A column of solids of different amounts melts below and falls in one step. So no solid is new at any place,
// and yet the light that each place takes up is another.
TEST_P(Pieces, TheLightMeetsAnotherAmount) {
  Parameters p = viscous(0.02);
  p.pieces.fall = true;
  p.heat.enabled = p.heat.radiation = true;
  p.heat.visibility_every = 1;
  p.heat.sources = {{{{.at = {16 * 9, 16 * 5, 16 * 5}, .power = std::uint64_t{1} << 26}}}};
  Volume v(Grid{10, 10, 10});
  put_inert(v, 4, 2, 4);
  for (int y = 3; y < 8; ++y) put_solid(v, 4, y, 4, 500 * y, y == 3 ? 40000 : 0);
  run::Simulation expected(p, v, implementation("reference"), {},
                           std::make_unique<visibility::VoxelWalkProvider>());
  run::Simulation actual(p, v, implementation(GetParam()));
  for (int step = 0; step < 8; ++step) {
    expected.step();
    actual.step();
    ASSERT_EQ(difference(expected.volume(), actual.volume()), "") << "step " << step;
  }
}

// Boxes that overlap, with holes, above pools and posts.
Volume rubble(Random& random, Grid g) {
  Volume v(g);
  const auto any_box = [&](int most) -> Box {
    const int x = random.below(g.x), y = random.below(g.y), z = random.below(g.z);
    return {x,
            y,
            z,
            std::min(g.x, x + random.between(1, most)),
            std::min(g.y, y + random.between(1, most)),
            std::min(g.z, z + random.between(1, most))};
  };
  for (int n = random.below(4); n > 0; --n) fill(v, any_box(20), random.between(1, 5000), 0, 0);
  for (int n = random.between(1, 8); n > 0; --n)
    for_each(any_box(9), [&](int x, int y, int z) {
      if (!random.one_in(7)) put_solid(v, x, y, z, random.between(1, kOne));
    });
  for (int n = random.below(3); n > 0; --n)
    for_each(any_box(3), [&](int x, int y, int z) {
      if (v.solid.test(x, y, z)) v.solid.set(x, y, z, false);
      put_inert(v, x, y, z);
    });
  return v;
}

TEST_P(Pieces, FallAsTheReferenceInRubble) {
  std::int64_t falls = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const Grid grid{random.any({5, 20, 63, 64, 65, 130}), random.between(4, 30), random.between(2, 20)};
    Parameters p = hostile_parameters(random, random.one_in(2) ? rule::Law::paper : rule::Law::viscous, grid);
    may_freeze(random, p);
    if (random.one_in(2)) p.heat = {};
    p.pieces = {true, random.any({1, 1, 2, 3}), random.any<std::int64_t>({65536, 65536, 30000, 60000})};
    const Volume start = rubble(random, grid);
    Volume moved = start;
    falls += fall(moved, 3, p.pieces);
    const step::Tuning tuning{.threads = random.between(1, 3), .tile_shift = random.any({0, 1, 3, 5})};
    if (!same_steps(p, start, GetParam(), tuning, 12)) FAIL() << "seed " << seed;
  }
  EXPECT_GT(falls, 60) << "too little falls in these worlds";
}

INSTANTIATE_TEST_SUITE_P(Implementations, Pieces, testing::ValuesIn([] {
                           std::vector<std::string> names = fast_implementations();
                           names.insert(names.begin(), "reference");
                           return names;
                         }()),
                         [](const auto& chosen) {
                           std::string name = chosen.param;
                           for (char& c : name)
                             if (c == '.') c = '_';
                           return name;
                         });

// Solids go one by one from worlds in which all are held. Where the cells around one still hold together,
// nothing may come loose. And searches are rare, though thousands go.
TEST(LocalParts, NeverMissAPart) {
  std::int64_t gone = 0, asked = 0, parted = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    Volume v(Grid{random.any({9, 66}), 9, 9});
    fill_inert(v, {0, 0, 0, v.grid.x, 1, 9});
    fill_solid(v, {0, 1, 0, v.grid.x, 9, 9});
    for (int i = 0; i < 400; ++i) {
      const int x = random.below(v.grid.x), y = random.between(1, 8), z = random.below(9);
      if (!v.solid.test(x, y, z)) continue;
      v.solid.set(x, y, z, false);
      ++gone;
      const bool loose = state::loose_solids(v).count() > 0;
      const bool one = is_locally_one(v.solid, v.inert, v.grid, x, y, z);
      asked += !one;
      parted += loose;
      ASSERT_TRUE(!one || !loose) << "seed " << seed << ": " << x << ' ' << y << ' ' << z;
      if (loose) v.solid.set(x, y, z, true);
    }
  }
  EXPECT_GT(parted, 100) << "too little is parted in these worlds";
  EXPECT_LT(asked, gone / 3);
}

TEST(LoosePieces, SearchOnlyWhereAPieceMayPart) {
  Volume v(Grid{64, 20, 20});
  fill_inert(v, {0, 0, 0, 64, 1, 20});
  fill_solid(v, {10, 1, 5, 50, 15, 15});
  LoosePieces pieces;
  // It melts from above, row by row, as a body in the sun does.
  for (int y = 14; y > 2; --y)
    for (int x = 10; x < 50; ++x)
      for (int z = 5; z < 15; ++z) {
        put(v, x, y, z, 0);
        v.solid.set(x, y, z, false);
        EXPECT_TRUE(pieces.fall({}, 0, v).empty());
      }
  EXPECT_EQ(pieces.searches(), 1) << "the first call";
}

}  // namespace
}  // namespace voxmelt::parallel
