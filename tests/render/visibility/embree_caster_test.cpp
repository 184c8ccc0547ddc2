// Embree's answers against rule::VoxelWalk, by single rays and by packets of 8 and of 16.
#include "render/visibility/embree_caster.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

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

// The caster stays the same, so trees are built anew for another world, and refitted while one melts.
TEST_P(EmbreeCasters, OfHostileWorldsAgreeWithTheWalk) {
  EmbreeCaster embree(GetParam());
  check_hostile_worlds(embree, 200, 73);
}

// Through a whole run of melting and of changes by hand, on two threads.
TEST_P(EmbreeCasters, KeptRaysAreAsIfAllWereCast) {
  Random random(17);
  for (int world = 0; world < 30; ++world) {
    Volume v = hostile_world(random, hostile_grid(random));
    rule::Heat heat =
        shone_by({awkward_source(random, v.grid), awkward_source(random, v.grid)}, random.any({1, 4, 16}));
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
      if (random.one_in(4)) heat.sources[0].keys[0].at = awkward_source(random, v.grid);
    }
  }
}

}  // namespace
}  // namespace voxmelt::visibility
