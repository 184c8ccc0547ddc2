// All stages that a scene has stand in as circuits: whole teaching scenes, crops of the showcase in mid-melt
// for every pair of lanes, time steps, depths and stalls, and hostile worlds. Every token and every cycle is
// compared.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "tests/rtl/beside_models.h"

namespace voxmelt::hwmodel {
namespace {

// Nine rows hold every pair of values in four columns of three: lanes, time steps, depth, stalls.
constexpr std::array<std::array<int, 4>, 9> kRows{{{0, 0, 0, 0},
                                                   {0, 1, 1, 1},
                                                   {0, 2, 2, 2},
                                                   {1, 0, 1, 2},
                                                   {1, 1, 2, 0},
                                                   {1, 2, 0, 1},
                                                   {2, 0, 2, 1},
                                                   {2, 1, 0, 2},
                                                   {2, 2, 1, 0}}};
constexpr std::array<int, 3> kSteps{1, 2, 4}, kDepths{1, 2, 8};

Configuration configuration_of(std::size_t row) {
  const std::vector<int> lanes = rtl_lanes();
  const auto& [l, t, d, s] = kRows[row % kRows.size()];
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  return {lanes[at(l) % lanes.size()], kSteps[at(t)], kDepths[at(d)], static_cast<std::uint64_t>(s)};
}

// A pass has so many sub-steps as its configuration.
void all_stages(Start start, std::size_t row, std::uint32_t steps, Seen& seen) {
  Configuration c = configuration_of(row);
  if (start.parameters.flow.law == rule::Law::viscous) {
    c.substeps = 1 + static_cast<int>(row % 2);
    start.parameters.flow.viscous.substeps = static_cast<std::uint16_t>(c.substeps);
  }
  if (start.volume.grid.cells() > 40000) c.lanes = rtl_lanes().back();  // one lane would take minutes
  if (start.parameters.pieces.fall) c.cascade = 1;  // the host finds pieces before each step
  const int before = seen.worlds;
  agree(start, c, steps, {}, static_cast<int>(row) + 1, seen);
  if (testing::Test::HasFatalFailure()) return;
  std::printf("| %s | %d | %d | %d | %d | %s |\n", start.name.c_str(), c.lanes, c.cascade, c.fifo_depth,
              static_cast<int>(c.stall_seed), seen.worlds > before ? "0" : "refused");
  std::fflush(stdout);
}

bool there_are_circuits() { return !rtl_lanes().empty(); }

TEST(ScenesInRtl, RowsHoldEveryPair) {
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b) {
      std::array<int, 9> seen{};
      for (const auto& row : kRows) ++seen[static_cast<std::size_t>(3 * row[a] + row[b])];
      for (const int n : seen) EXPECT_EQ(n, 1) << "columns " << a << " and " << b;
    }
}

TEST(ScenesInRtl, CropsOfTheShowcase) {
  if (!there_are_circuits()) GTEST_SKIP() << "this program was built without Verilator";
  Seen seen;
  for (const auto& [name, ahead] : showcase()) {
    const Start start = crop(start_of(name, ahead), 24);
    ASSERT_GT(start.volume.liquid.count(), 100) << name;
    for (std::size_t row = 0; row < kRows.size() && !HasFatalFailure(); ++row)
      all_stages(start, row, 5, seen);
  }
  EXPECT_EQ(seen.worlds, 8 * 9);
  EXPECT_EQ(seen.refused, 0);
}

// In the middle of the melt, where liquid lies beside solids of both materials.
TEST(ScenesInRtl, CropsOfSeveralMaterials) {
  if (!there_are_circuits()) GTEST_SKIP() << "this program was built without Verilator";
  Seen seen;
  for (const auto& [name, ahead] : {std::pair("candle", 3000U), std::pair("chocolate_nuts", 1500U)}) {
    const Start start = crop(start_of(name, ahead), 24);
    const state::Volume& volume = start.volume;
    ASSERT_GT(volume.liquid.count(), 1000) << name;
    std::array<int, 2> solids{};
    worlds::for_each({0, 0, 0, 24, 24, 24}, [&](int x, int y, int z) {
      if (volume.solid.test(x, y, z)) ++solids[volume.material[volume.at(x, y, z)] > 0 ? 1 : 0];
    });
    ASSERT_GT(solids[0], 1000) << name;
    ASSERT_GT(solids[1], 40) << name;
    for (std::size_t row = 0; row < kRows.size() && !HasFatalFailure(); ++row)
      all_stages(start, row, 5, seen);
  }
  EXPECT_EQ(seen.worlds, 2 * 9);
  EXPECT_EQ(seen.materials, 2 * 9);
  EXPECT_GT(seen.holds, 2);
}

TEST(ScenesInRtl, TeachingScenes) {
  if (!there_are_circuits()) GTEST_SKIP() << "this program was built without Verilator";
  Seen seen;
  std::size_t row = 0;
  for (const char* name : {"arch",
                           "bunny_small",
                           "bunny_small_viscous",
                           "ice",
                           "lava_crust",
                           "lesson_conduction",
                           "lesson_drain",
                           "lesson_fall",
                           "lesson_freeze",
                           "lesson_gravity",
                           "lesson_latent_heat",
                           "lesson_oven",
                           "lesson_piling",
                           "lesson_shadow",
                           "lesson_sky",
                           "lesson_soft_shadow",
                           "lesson_spread",
                           "lesson_sun",
                           "lesson_tubes",
                           "paper_literal",
                           "paper_literal_printed",
                           "proving_ground",
                           "proving_ground_ends",
                           "proving_ground_ends_viscous",
                           "proving_ground_viscous",
                           "proving_ground_wide",
                           "proving_ground_wide_viscous"})
    for (const std::uint32_t ahead : {0U, 60U}) {
      if (HasFatalFailure()) return;
      all_stages(start_of(name, ahead, {}), row, 1, seen);
      row += 4;  // each scene gets another pair of lanes, steps, depth and stalls
    }
  EXPECT_EQ(seen.worlds + seen.refused, 54);
  EXPECT_EQ(seen.refused, 0);
}

TEST(ScenesInRtl, HostileWorlds) {
  if (!there_are_circuits()) GTEST_SKIP() << "this program was built without Verilator";
  Seen seen;
  for (std::size_t seed = 0; seen.worlds < 100 && !HasFatalFailure(); ++seed) {
    ASSERT_LT(seed, 1000U);
    const rule::Law law = seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous;
    all_stages(world(seed + 4000, configuration_of(seed).lanes, law), seed, 6, seen);
  }
  EXPECT_GT(seen.holds, 5);
  EXPECT_GT(seen.overlaps, 5);
}

}  // namespace
}  // namespace voxmelt::hwmodel
