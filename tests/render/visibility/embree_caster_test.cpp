// Embree's answers agree with rule::VoxelWalk, by single rays and by packets of 8 and of 16.
#include "render/visibility/embree_caster.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "kernel/engine/visibility/kept_rays.h"
#include "tests/kernel/engine/visibility/caster_check.h"

namespace voxmelt::visibility {
namespace {

class EmbreeCasters : public testing::TestWithParam<Packet> {
 protected:
  void SetUp() override {
    if (!EmbreeCaster::built_in()) GTEST_SKIP() << "this build has no Embree";
  }
};
INSTANTIATE_TEST_SUITE_P(Packets, EmbreeCasters, testing::Values(Packet::one, Packet::eight, Packet::sixteen),
                         [](const auto& packet) {
                           return "of" + std::to_string(static_cast<int>(packet.param));
                         });

// The casters stay the same, so trees are built anew for another world, and refitted while one melts.
TEST(AllEmbreeCasters, OfHostileWorldsAgreeWithTheWalk) {
  if (!EmbreeCaster::built_in()) GTEST_SKIP() << "this build has no Embree";
  EmbreeCaster one(Packet::one), eight(Packet::eight), sixteen(Packet::sixteen);
  check_hostile_worlds({&one, &eight, &sixteen}, 200, 73);
}

TEST(AllEmbreeCasters, OfFiveScenesAndThirtySourcesAgreeWithTheWalk) {
  if (!EmbreeCaster::built_in()) GTEST_SKIP() << "this build has no Embree";
  EmbreeCaster one(Packet::one), eight(Packet::eight), sixteen(Packet::sixteen);
  check_scenes({&one, &eight, &sixteen}, 30);
}

// The rays are kept through a whole run of melting and of changes by hand, on two threads.
TEST_P(EmbreeCasters, KeptRaysAreAsIfAllWereCast) {
  Random random(17);
  for (int world = 0; world < 30; ++world) {
    Volume v = hostile_world(random, hostile_grid(random));
    rule::Heat heat =
        shone_by({awkward_shine(random, v.grid), awkward_shine(random, v.grid)}, random.any({1, 4, 16}), 5);
    KeptRays kept(std::make_unique<EmbreeCaster>(GetParam()), 2);
    state::Field<std::uint16_t> result(v.grid), expected(v.grid);
    for (int call = 0; call < 6; ++call) {
      VoxelWalkProvider().irradiance(v, heat, 0, expected);
      kept.irradiance(v, heat, 0, result);
      ASSERT_EQ(result, expected) << "world " << world << ", call " << call;
      const bool appears = random.one_in(5);
      const std::int32_t part = random.any({2, 10, 100});
      for_each(whole(v.grid), [&](int x, int y, int z) {
        if (v.solid.test(x, y, z) && random.one_in(part)) v.solid.set(x, y, z, false);
        if (appears && random.one_in(100 * part) && !v.inert.test(x, y, z)) v.solid.set(x, y, z, true);
      });
      if (random.one_in(4)) heat.sources[0].keys[0] = awkward_shine(random, v.grid, heat.sources[0].kind).key;
    }
  }
}

// One of two bricks melts away, and one melts partly. The boxes, by hand, are 0.02 wider than the opaque
// cells.
TEST_P(EmbreeCasters, BoxesShrinkWithWhatMelts) {
  Volume v(Grid{40, 20, 20});
  for_each({2, 3, 4, 6, 7, 8}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  put_inert(v, 33, 10, 19);
  cpu::Workers workers(1);
  Opaque opaque;
  EmbreeCaster embree(GetParam());
  const auto expect = [&](std::array<float, 3> low, std::array<float, 3> high) {
    const EmbreeCaster::Box box = embree.box();
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_NEAR(box.low[a], low[a] - 0.02, 1e-4) << a;
      EXPECT_NEAR(box.high[a], high[a] + 0.02, 1e-4) << a;
    }
  };
  embree.prepare(opaque, opaque.take(v, workers));
  expect({2, 3, 4}, {34, 11, 20});
  for (int z = 4; z < 8; ++z)
    for (int y = 3; y < 7; ++y) v.solid.set(2, y, z, false);
  v.inert.set(33, 10, 19, false);
  embree.prepare(opaque, opaque.take(v, workers));
  EXPECT_NEAR(embree.box().low[0], 2.98, 1e-4) << "refitted";
  EXPECT_NEAR(embree.box().high[0], 36, 1e-4) << "the middle of the brick that is empty now";
}

// A ball of full bricks has boxes on its shell only. It melts until the inner ones are bare.
TEST_P(EmbreeCasters, ABallThatMeltsToItsCore) {
  Volume v(Grid{64, 64, 64});
  const auto squared = [](int x, int y, int z) {
    return (x - 32) * (x - 32) + (y - 32) * (y - 32) + (z - 32) * (z - 32);
  };
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (squared(x, y, z) < 30 * 30) put_solid(v, x, y, z);
  });
  EmbreeCaster embree(GetParam());
  cpu::Workers workers(1);
  Opaque opaque;
  for (int radius = 30; radius > 4; radius -= 5) {
    embree.prepare(opaque, opaque.take(v, workers));
    for (const Position source : {Position{2000, 1500, 300}, {512, 2000, 512}, {-8, 200, 500}})
      check_fates({&embree}, opaque, v, {rule::SourceKind::point, {.at = source}}, 1);
    for_each(whole(v.grid), [&](int x, int y, int z) {
      if (squared(x, y, z) >= (radius - 5) * (radius - 5)) v.solid.set(x, y, z, false);
    });
  }
}

}  // namespace
}  // namespace voxmelt::visibility
