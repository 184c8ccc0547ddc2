// Hostile worlds of several materials run in lock-step: in tiles, with the code, with pieces that fall, in
// several passes a step. Each cell takes four bits more between memory and stream, and no cycle more.
#include <cstddef>
#include <cstdint>

#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {
namespace {

// Calls visit(start, random) for so many worlds of several materials.
template <class Visit>
void each_world(int count, std::uint64_t first_seed, Visit&& visit) {
  for (std::uint64_t seed = first_seed; count > 0; ++seed) {
    worlds::Random random(seed + 99);
    const state::Grid grid{random.between(1, 18), random.between(1, 10), random.between(1, 10)};
    const rule::Law law = seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous;
    Start start = hostile_start(seed, law, grid);
    if (!start.parameters.has_materials()) continue;
    --count;
    ASSERT_NO_FATAL_FAILURE(visit(start, random));
  }
}

TEST(Materials, HostileWorlds) {
  each_world(40, 500, [](Start& start, worlds::Random& random) {
    Configuration c{random.any({1, 2, 3, 4, 6, 8, 11, 16}), random.between(1, 4), random.any({1, 2, 8}),
                    static_cast<std::uint64_t>(random.any({0, 9}))};
    c.coded = random.one_in(3);
    ASSERT_TRUE(agrees(start, c, 6));
  });
}

TEST(Materials, InTiles) {
  each_world(12, 700, [](Start& start, worlds::Random& random) {
    Configuration c{random.any({1, 2}), 1, 2, 0};
    c.tile = narrow(start, c, random.between(0, 3));
    c.coded = random.one_in(2);
    ASSERT_TRUE(agrees(start, c, 4));
  });
}

TEST(Materials, InPiecesThatFall) {
  each_world(12, 800, [](Start& start, worlds::Random& random) {
    start.parameters.pieces = {true, random.between(1, 3), random.any({1, 40000, 65536})};
    ASSERT_TRUE(agrees(start, {random.any({1, 4}), 1, 2, 0}, 6));
  });
}

// Reader and writer move each cell once in a pass. The same world without materials takes the same cycles.
TEST(Materials, MoveFourBitsMoreACell) {
  each_world(6, 900, [](Start& start, worlds::Random& /*random*/) {
    start.parameters.flow.viscous.substeps = 1;  // else the number follows from the state
    const VerifyReport several = lockstep(start, {4, 2, 2, 0}, 4);
    ASSERT_EQ(several.mismatch, nullptr);
    start.parameters.materials.clear();
    start.volume.material = {};
    const VerifyReport one = lockstep(start, {4, 2, 2, 0}, 4);
    ASSERT_EQ(one.mismatch, nullptr);
    EXPECT_EQ(several.cycles, one.cycles);
    ASSERT_EQ(several.stages.size(), one.stages.size());
    const std::int64_t cells = 4 * Shape{start.volume.grid, 4}.tokens() * several.passes;
    for (std::size_t i = 0; i < one.stages.size(); ++i) {
      const StageKind kind = one.stages[i].kind;
      if (kind != StageKind::reader && kind != StageKind::writer) continue;
      const int bits = 2 + 16 + (start.parameters.flow.law == rule::Law::paper ? 16 : 0) +
                       (start.parameters.heat.enabled ? 16 : 0);
      EXPECT_EQ(one.stages[i].moved_bits, cells * bits) << name_of(kind);
      EXPECT_EQ(several.stages[i].moved_bits, cells * (bits + 4)) << name_of(kind);
    }
  });
}

}  // namespace
}  // namespace voxmelt::hwmodel
