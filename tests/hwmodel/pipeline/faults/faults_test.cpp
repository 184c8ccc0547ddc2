// Every fault that can be planted is found: the first mismatch names its stage, step and cell.
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

#include <cstdint>
#include <ostream>
#include <string>

#include "hwmodel/pipeline/faults/faults.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {

void PrintTo(const FaultInfo& fault, std::ostream* out) { *out << fault.name; }  // names the test's parameter

namespace {

class PlantedFault : public testing::TestWithParam<FaultInfo> {};

TEST_P(PlantedFault, IsFoundWhereItWasPlanted) {
  const FaultInfo& fault = GetParam();
  int struck = 0;
  for (std::uint64_t seed = 0; seed < 600 && struck < 5; ++seed) {
    worlds::Random random(seed + 4242);
    const state::Grid grid{random.between(3, 18), random.between(3, 10), random.between(3, 10)};
    const rule::Law law = seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous;
    Start start = start_for(fault.fault, seed, law, grid);
    Configuration c{random.any({2, 4, 16}), random.between(1, 3), random.any({1, 2, 4}),
                    random.one_in(2) ? 0 : seed};
    if (is_of_tiles(fault.fault)) {
      c.lanes = 1;
      c.cascade = 1;
      c.tile = narrow(start, c, random.between(1, 4));
    }
    c.coded = is_of_the_code(fault.fault) || random.one_in(4);
    const VerifyReport report = lockstep(start, c, 6, fault.fault, 2);
    const std::string where = "seed " + std::to_string(seed) + ", " + name_of(c);
    if (!report.strike) {
      ASSERT_EQ(report.mismatch, nullptr) << where << ": nothing struck, but " << text_of(*report.mismatch);
      continue;
    }
    ++struck;
    ASSERT_NE(report.mismatch, nullptr) << where << ": struck and not found";
    const auto& at = *report.strike;
    ASSERT_TRUE(report.found_where_planted())
        << where << ": planted in " << at.where << ", step " << at.step << ", cell " << at.x << ", " << at.y
        << ", " << at.z << "; found " << text_of(*report.mismatch);
    EXPECT_GE(report.mismatch->step, 2u);
    EXPECT_TRUE(report.replay.has_value());
  }
  EXPECT_GE(struck, 3) << "hardly any world in which the fault can strike";
}

INSTANTIATE_TEST_SUITE_P(Some, PlantedFault, testing::ValuesIn(some_of(all_faults())),
                         [](const auto& chosen) {
                           std::string name;
                           for (const char c : chosen.param.name) name += c == '-' ? '_' : c;
                           return name;
                         });

TEST(PlantedFault, ThereAreAtLeastTwenty) { EXPECT_GE(all_faults().size(), 20u); }

// A run from the state before the mismatch shows it again.
TEST(PlantedFault, ReplayFindsItAgain) {
  int replayed = 0;
  for (std::uint64_t seed = 0; seed < 40 && replayed < 5; ++seed) {
    const Start start = hostile_start(seed, rule::Law::paper, {9, 9, 9});
    const VerifyReport first = lockstep(start, {4, 2, 2, 0}, 6, Fault::apply_flow_lost, 3);
    if (!first.strike) continue;
    ASSERT_TRUE(first.found_where_planted());
    const Start again{"replay", start.parameters, *first.replay, first.replay_step};
    const VerifyReport second = lockstep(again, {4, 2, 2, 0}, first.mismatch->step - first.replay_step + 1,
                                         Fault::apply_flow_lost, 3);
    ASSERT_TRUE(second.mismatch != nullptr && second.found_where_planted());
    EXPECT_EQ(text_of(*first.mismatch), text_of(*second.mismatch));
    ++replayed;
  }
  EXPECT_GE(replayed, 3);
}

}  // namespace
}  // namespace voxmelt::hwmodel
