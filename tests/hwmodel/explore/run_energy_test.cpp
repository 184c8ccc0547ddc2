// The closed form of energy is worked by hand, and compared with the simulation.
#include "hwmodel/explore/run_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/explore/answer.h"
#include "hwmodel/explore/check.h"
#include "hwmodel/memory/sheet.h"
#include "tests/kernel/engine/parallel/equal.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Three sub-steps go through two copies, so there are two passes: both copies work in the first, and one in
// the second. Conduction is for the first pass and gravity for the last. A grid of 8 x 3 x 2 cells makes 24
// tokens of two lanes.
TEST(RunEnergy, ATrainWorkedByHand) {
  PartList parts;
  parts.design = {{}, {{8, 3, 2}, 2}};
  const auto stage = [](StageKind kind, double energy) {
    StagePart part;
    part.kind = kind;
    part.token_energy = energy;
    return part;
  };
  parts.stages = {stage(StageKind::fall, 1000), stage(StageKind::conduction, 2),
                  stage(StageKind::settle, 3),  stage(StageKind::viscous_spread, 5),
                  stage(StageKind::settle, 7),  stage(StageKind::viscous_spread, 11),
                  stage(StageKind::gravity, 13)};
  parts.coder_energy = 100;
  Train first, second;
  first.passes = second.passes = 1;
  first.list = {{.substep = 0, .count = 2, .substeps = 3}};
  second.list = {{.substep = 2, .count = 1, .substeps = 3}};
  EXPECT_EQ(energy_of_tokens(first, parts, false), 24 * (2 + 3 + 5 + 7 + 11));
  EXPECT_EQ(energy_of_tokens(second, parts, false), 24 * (3 + 5 + 13));
  EXPECT_EQ(energy_of_tokens(second, parts, true), 24 * (3 + 5 + 13 + 100));
  Train steps;  // two passes of all stages, of three steps and of one in which a piece falls
  steps.passes = 2;
  steps.list = {{.steps = 3}, {.steps = 1, .falls = true}};
  EXPECT_EQ(energy_of_tokens(steps, parts, true), 24 * (4 * (2 + 3 + 5 + 13) + 1000 + 2 * 100));
}

// A row of DDR4-2400 has 8 KiB: 128 bursts of 64 bytes. 7020 cycles at 300 MHz are 28,080 of the memory, in
// which it refreshes three times (tREFI is 9360).
TEST(RunEnergy, ADramWorkedByHand) {
  memory::Parameters sheet = load_memory("ddr4-2400", "test");
  StreamWork work;
  work.read_bits = 1000 * 512;
  work.fed_bits = 23 * 512 + 1;
  work.written_bits = 1000 * 512 - 511;
  const memory::Counts one = counts_of(work, 7020, 300, sheet);
  EXPECT_EQ(one.reads, 1024);
  EXPECT_EQ(one.writes, 1000);
  EXPECT_EQ(one.activates, 16) << "15.8";
  EXPECT_EQ(one.refreshes, 3);
  EXPECT_EQ(one.bank_refreshes, 0);
  EXPECT_EQ(one.cycles(), 28080);
  EXPECT_EQ(one.active, 28080) << "rows stay open";
  sheet.channels = 4;
  sheet.ranks = 2;
  const memory::Counts more = counts_of(work, 7020, 300, sheet);
  EXPECT_EQ(more.reads, 1024);
  EXPECT_EQ(more.cycles(), 4 * 28080);
  EXPECT_EQ(more.active, 8 * 28080);
  EXPECT_EQ(more.refreshes, 24);
  memory::Parameters by_bank = load_memory("lpddr4-3200", "test");
  by_bank.by_bank = true;
  const memory::Counts banks = counts_of(work, 10 * by_bank.refi_bank, by_bank.mhz, by_bank);
  EXPECT_EQ(banks.bank_refreshes, 10 * by_bank.channels);
  EXPECT_EQ(banks.refreshes, 0);
}

struct Asked {
  Question question;
  Axes axes;
  explicit Asked(rule::Law law, const std::string& memory) {
    question.grid = {48, 12, 10};
    question.parameters.flow.law = law;
    question.parameters.heat.enabled = true;
    question.parameters.flow.viscous.substeps = 3;
    question.device = load_device("zu7ev", {});
    if (!memory.empty()) question.memory = load_memory(memory, "test");
    axes.lanes = {4};
    axes.cascade = {2};
    axes.substeps = axes.overlap = {1};
    axes.fifo_depth = {2};
    axes.coded = {0};
    axes.clock_mhz = {200};
  }
};

// Simulates the first design, for three steps: the last pass has fewer than the cascade.
Checked simulated(Asked& asked) {
  state::Volume start(asked.question.grid);
  worlds::fill(start, {6, 0, 2, 30, 5, 8}, rule::kOne, 0, 900);
  asked.question.volume = &start;
  const CheckInput input{start, worlds::implementation("reference"), {}, {}};
  return check(asked.question, sweep(asked.question, asked.axes, {}), 0, 3, input);
}

// The energy of the stages is exact. This holds with sub-steps, tiles, the code, and steps that are left out.
TEST(RunEnergy, OperationsAreThoseOfTheSimulation) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const bool coded : {false, true})
      for (const int tile : {0, 28}) {
        Asked asked(law, "ddr4-2400");
        asked.axes.substeps = {law == rule::Law::paper ? 1 : 2};
        asked.axes.coded = {coded ? 1 : 0};
        asked.axes.cascade = {law == rule::Law::paper ? 2 : 1};
        asked.axes.tile = tile;
        const Checked checked = simulated(asked);
        ASSERT_TRUE(checked.good) << checked.difference;
        EXPECT_GT(checked.energy.operations, 0);
        EXPECT_NEAR(checked.predicted_energy.operations / checked.energy.operations, 1, 1e-9)
            << coded << ' ' << tile;
      }
}

// The energy of the memory comes from a model. In so small a run its ends count, too.
TEST(RunEnergy, TheMemorysIsNearTheSimulation) {
  for (const char* memory : {"ddr4-2400", "hbm2", "lpddr4-3200", "gddr6"})
    for (const int lanes : {1, 4, 12}) {
      Asked asked(rule::Law::paper, memory);
      asked.axes.lanes = {lanes};
      asked.question.grid = {48, 20, 20};
      asked.axes.overlap = {lanes == 4 ? 0 : 1};  // two trains, or one
      const Checked checked = simulated(asked);
      ASSERT_TRUE(checked.good) << checked.difference;
      const double error = checked.predicted_energy.memory / checked.energy.memory - 1;
      EXPECT_LT(std::abs(error), 0.1) << memory << ", " << lanes << " lanes";
    }
}

TEST(RunEnergy, ASheetWithoutCurrentsTakesNone) {
  const Asked asked(rule::Law::paper, "hbm3"), none(rule::Law::paper, "");
  const Swept swept = sweep(asked.question, asked.axes, {}), alone = sweep(none.question, none.axes, {});
  EXPECT_EQ(swept.points[0].memory_energy, 0);
  EXPECT_EQ(swept.points[0].energy, alone.points[0].energy);
  EXPECT_GT(swept.points[0].energy, 0);
}

// The last one of four designs does not fit. The second and the third one take the same, and the third is
// faster.
TEST(RunEnergy, TheMostFrugalDesignIsOnItsFront) {
  Asked asked(rule::Law::paper, "");
  asked.axes.clock_mhz = {50, 100, 150, 200};
  Swept swept = sweep(asked.question, asked.axes, {});
  ASSERT_EQ(swept.points.size(), 4U);
  const std::vector<std::int64_t> energies{700, 400, 400, 100};
  for (std::size_t i = 0; i < energies.size(); ++i) swept.points[i].energy = energies[i];
  swept.points[3].taken.fullest = 1.5;
  swept.points[0].speed = swept.points[2].speed + 1;
  const Answer answer = answer_of(asked.question, asked.axes, swept);
  EXPECT_EQ(answer.best, 0U);
  EXPECT_EQ(answer.frugal, 2U);
  EXPECT_EQ(answer.fronts[kEnergyFront], (std::vector<std::size_t>{2, 0}));
  EXPECT_EQ(front_name(kEnergyFront), "energy");
  swept.points[0].taken.fullest = swept.points[1].taken.fullest = swept.points[2].taken.fullest = 2;
  EXPECT_FALSE(answer_of(asked.question, asked.axes, swept).frugal);
}

// A grid of 1000 cells does ten steps with 2 nJ.
TEST(RunEnergy, PerCellStep) {
  Question question;
  question.grid = {10, 10, 10};
  EXPECT_EQ(per_cell_step(question, 10, 2000), 200);
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
