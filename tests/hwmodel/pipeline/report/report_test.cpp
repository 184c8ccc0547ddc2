// The checker's reports are tested: lines, JSON and the table have the numbers that they name.
#include "hwmodel/pipeline/report/report.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/kernel/worlds.h"

namespace voxmelt::hwmodel {
namespace {

VerifyReport report_with_distinct_numbers() {
  VerifyReport r;
  r.first_step = 40;
  r.steps = 3;
  r.compared_cells = 501;
  r.software_cells = 502;
  r.passes = 2;
  r.cycles = 200;
  r.predicted_cycles = 160;
  r.model_seconds = 0.5;
  r.cell_steps = 1'000'000;
  r.digest = 0xABC;
  r.stages = {{StageKind::reader, 0, 0, {100, 0, 90, 10}, {}, {}, 7200},
              {StageKind::melt, 0, 7, {50, 40, 30, 60, 20}, {{"memory", 5, 4, 11}}, {3, 2, 1}},
              {StageKind::melt, 1, 7, {100, 20, 10, 70}, {{"memory", 5, 4, 11}}, {3, 2, 1}},
              {StageKind::feed, 0, 0, {200, 0, 0, 0}, {}, {}, 12850},
              {StageKind::writer, 1, 0, {100, 60, 0, 40}, {}, {}, 7150}};
  r.channels = {{"a", StageKind::reader, 0, 8, 50, 3, 0, 9, {1, 2, 3, 4}},
                {"b", StageKind::melt, 0, 8, 60, 5, 0, 9, {4, 3, 2, 1}},
                {"c", StageKind::feed, 0, 8, 16, 8, 0, 9, {0, 1}}};
  return r;
}
Mismatch mismatch_with_distinct_numbers() {
  return {Mismatch::Kind::stage,
          "apply",
          step::Phase::spread,
          41,
          1,
          2,
          77,
          6,
          5,
          4,
          "amount",
          300,
          200,
          "words",
          {"line"}};
}
const Configuration kMachine{4, 2, 8, 9, 1, true, 12};
Design design_of(rule::Law law) {
  rule::Parameters parameters;
  parameters.flow.law = law;
  return {parameters, {{10, 5, 2}, 4}};
}

TEST(Report, ADifferenceFailsWhetherTheFaultStruckOrNot) {
  const auto verdict = [](bool planted, bool struck, bool differs) {
    VerifyReport report;
    if (struck) report.strike.emplace();
    if (differs) report.mismatch = std::make_unique<Mismatch>(mismatch_with_distinct_numbers());
    return verdict_of(report, planted);
  };
  EXPECT_EQ(verdict(false, false, false), Verdict::good);
  EXPECT_EQ(verdict(false, false, true), Verdict::failed);
  EXPECT_EQ(verdict(true, false, false), Verdict::never_struck);
  EXPECT_EQ(verdict(true, false, true), Verdict::failed) << "a real difference, seen before the fault struck";
  EXPECT_EQ(verdict(true, true, false), Verdict::failed) << "the checker is blind";
  EXPECT_EQ(verdict(true, true, true), Verdict::failed);
}

TEST(Report, JsonHoldsEveryNumberUnderItsName) {
  const auto json = json_of(report_with_distinct_numbers(), design_of(rule::Law::viscous), kMachine);
  const auto expected = nlohmann::ordered_json::parse(R"({
    "grid": [10, 5, 2], "law": "viscous",
    "hw": {"lanes": 4, "cascade": 2, "substeps": 1, "overlap": 1, "tile": 12, "coded": 0, "registers": 0, "fifo_depth": 8, "stall_seed": 9},
    "tiles": {"count": 1, "columns": 10, "halo": 0, "recomputed_cells_per_pass": 0},
    "first_step": 40, "steps": 3, "compared_cells": 501, "software_compared_cells": 502,
    "mismatches": 0, "first_mismatch": null, "digest": "0000000000000abc",
    "passes": 2, "cycles": 200, "predicted_cycles": 160, "buffer_bits": 440, "channel_bits": 4032,
    "units": {"multipliers": 24, "dividers": 16, "random_blocks": 2},
    "traffic_bits_per_cycle": {"read": 72.0, "written": 71.5, "irradiance": 64.25, "pieces": 0.0},
    "simulated_cell_steps": 1000000, "seconds_model": 0.5,
    "stages": [
      {"name": "reader", "phase": "", "cascade": 0, "lag": 0, "moved_bits": 7200,
       "cycles": {"busy": 100, "starved": 0, "blocked": 90, "memory": 0, "fill_drain": 10, "bypassed": 0},
       "buffers": [], "per_lane": {"multipliers": 0, "dividers": 0}, "random_blocks_per_8_lanes": 0,
       "buffer_bits": 0,
       "percent": {"busy": 50.0, "starved": 0.0, "blocked": 45.0, "memory": 0.0, "fill_drain": 5.0, "bypassed": 0.0}},
      {"name": "melt", "phase": "melt", "cascade": 0, "lag": 7, "moved_bits": 0,
       "cycles": {"busy": 50, "starved": 40, "blocked": 30, "memory": 0, "fill_drain": 60, "bypassed": 20},
       "buffers": [{"name": "memory", "words": 5, "lanes": 4, "bits": 11, "total_bits": 220}],
       "per_lane": {"multipliers": 3, "dividers": 2}, "random_blocks_per_8_lanes": 1,
       "buffer_bits": 220,
       "percent": {"busy": 25.0, "starved": 20.0, "blocked": 15.0, "memory": 0.0, "fill_drain": 30.0, "bypassed": 10.0}},
      {"name": "melt", "phase": "melt", "cascade": 1, "lag": 7, "moved_bits": 0,
       "cycles": {"busy": 100, "starved": 20, "blocked": 10, "memory": 0, "fill_drain": 70, "bypassed": 0},
       "buffers": [{"name": "memory", "words": 5, "lanes": 4, "bits": 11, "total_bits": 220}],
       "per_lane": {"multipliers": 3, "dividers": 2}, "random_blocks_per_8_lanes": 1,
       "buffer_bits": 220,
       "percent": {"busy": 50.0, "starved": 10.0, "blocked": 5.0, "memory": 0.0, "fill_drain": 35.0, "bypassed": 0.0}},
      {"name": "feed", "phase": "", "cascade": 0, "lag": 0, "moved_bits": 12850,
       "cycles": {"busy": 200, "starved": 0, "blocked": 0, "memory": 0, "fill_drain": 0, "bypassed": 0},
       "buffers": [], "per_lane": {"multipliers": 0, "dividers": 0}, "random_blocks_per_8_lanes": 0,
       "buffer_bits": 0,
       "percent": {"busy": 100.0, "starved": 0.0, "blocked": 0.0, "memory": 0.0, "fill_drain": 0.0, "bypassed": 0.0}},
      {"name": "writer", "phase": "", "cascade": 1, "lag": 0, "moved_bits": 7150,
       "cycles": {"busy": 100, "starved": 60, "blocked": 0, "memory": 0, "fill_drain": 40, "bypassed": 0},
       "buffers": [], "per_lane": {"multipliers": 0, "dividers": 0}, "random_blocks_per_8_lanes": 0,
       "buffer_bits": 0,
       "percent": {"busy": 50.0, "starved": 30.0, "blocked": 0.0, "memory": 0.0, "fill_drain": 20.0, "bypassed": 0.0}}],
    "channels": [{"name": "a", "depth": 8, "bits": 50, "highest": 3, "occupancy": [1, 2, 3, 4]},
                 {"name": "b", "depth": 8, "bits": 60, "highest": 5, "occupancy": [4, 3, 2, 1]},
                 {"name": "c", "depth": 8, "bits": 16, "highest": 8, "occupancy": [0, 1]}],
    "trains": [],
    "cell_steps_per_cycle": {"lanes_and_steps": 8.0, "lanes_in_the_grid": 6.666666666666667,
                             "steps_with_work": 5.0, "fill_and_drain": 1.875, "reached": 1.5,
                             "bytes_per_cycle": 25.96875, "cell_steps_per_byte": 0.30806257521058966}})");
  EXPECT_EQ(json.dump(1), expected.dump(1));
  EXPECT_EQ(json_of(report_with_distinct_numbers(), design_of(rule::Law::paper), kMachine)["law"], "paper");
}

TEST(Report, JsonOfAMismatchAndOfAPlantedFault) {
  VerifyReport report = report_with_distinct_numbers();
  report.mismatch = std::make_unique<Mismatch>(mismatch_with_distinct_numbers());
  report.strike = FaultPlan::Strike{"apply", 41, 6, 5, 3};  // one cell away from the mismatch
  const auto json = json_of(report, design_of(rule::Law::paper), kMachine);
  EXPECT_EQ(json["mismatches"], 1);
  for (const char* half : {"digest", "predicted_cycles"})  // half a pass has no such numbers
    EXPECT_TRUE(json[half].is_null()) << half;
  EXPECT_EQ(table_of(report, design_of(rule::Law::paper), kMachine), "");
  const auto mismatch = nlohmann::ordered_json::parse(R"({
    "kind": "stage", "where": "apply", "phase": "spread", "step": 41, "cascade": 1, "lane": 2, "cycle": 77,
    "cell": [6, 5, 4], "field": "amount", "expected": 300, "actual": 200, "detail": "words",
    "neighbourhood": ["line"]})");
  EXPECT_EQ(json["first_mismatch"].dump(1), mismatch.dump(1));
  const auto planted = nlohmann::ordered_json::parse(
      R"({"where": "apply", "step": 41, "cell": [6, 5, 3], "found_there": false})");
  EXPECT_EQ(json["planted"].dump(1), planted.dump(1));
}

// In the table the two time steps of `melt` are one line, so shares are of the cycles of both.
TEST(Report, TheTableAddsUpTheTimeSteps) {
  const std::string table = table_of(report_with_distinct_numbers(), design_of(rule::Law::paper), kMachine);
  const auto holds = [&](const std::string& text) {
    EXPECT_NE(table.find(text), std::string::npos) << "'" << text << "' is not in\n" << table;
  };
  holds(
      "melt             2     37.5       15.0       10.0       0.0          32.5         5.0       7         "
      " "
      "440       24 + 16\n");
  holds(
      "reader           1     50.0        0.0       45.0       0.0           5.0         0.0       0         "
      " "
      "  0         0 + 0\n");
  holds(
      "440 bits of buffers (4.4 per cell of a plane and time step), 24 multipliers, 16 dividers, 2 random "
      "blocks\n");
  holds("channels: 3 of depth 8, 4032 bits; high-water mark 5 (b)\n");
  holds("72.0 read + 71.5 written + 64.2 irradiance = 207.8; at 200 MHz 5.2 GB/s\n");
  holds("cycles: 200 in 2 passes; predicted without stalls 160 (+25.00 %)\n");
  holds(
      "1.500 cell-steps per cycle, 18.8 % of the bound 8 (lanes x cascade); lanes beyond the grid 16.7 %, "
      "time steps without work 25.0 %\n");
  holds("2.00 million cell-steps a second\n");
}

TEST(Report, TheLinesOfAMismatch) {
  EXPECT_EQ(text_of(mismatch_with_distinct_numbers()),
            "first mismatch (stage): apply\n"
            "  step 41, phase spread, cascade position 1, lane 2, cycle 77\n"
            "  cell (6, 5, 4): amount expected 300 = 0x012c, is 200 = 0x00c8, bits that differ 0x01e4\n"
            "  before it, around it (state and amount, # outside; x to the right, z downwards):\n"
            "    line\n");
  using enum Mismatch::Kind;
  for (const auto& [kind, name] : {std::pair{stage, "stage"},
                                   {channel, "channel"},
                                   {memory, "memory"},
                                   {software, "software"},
                                   {missing, "missing stage"},
                                   {width, "width"},
                                   {hang, "hang"}})
    EXPECT_STREQ(name_of(kind), name);
}

TEST(Report, TheCellsAroundOne) {
  state::Volume volume({3, 3, 3});
  worlds::put_inert(volume, 0, 0, 0, 1);
  worlds::put_solid(volume, 1, 1, 1, 22);
  worlds::put(volume, 2, 2, 2, 333);
  worlds::put(volume, 2, 2, 0, 4);
  const std::string air3 = "       -0       -0       -0";
  EXPECT_EQ(
      neighbourhood(volume, 1, 1, 1),
      (std::vector<std::string>{"y = 2", "       -0       -0       l4", air3, "       -0       -0     l333",
                                "y = 1", air3, "       -0    [s22]       -0", air3,  //
                                "y = 0", "       i1       -0       -0", air3, air3}));
  EXPECT_EQ(neighbourhood(volume, 0, 0, 0)[1], "        #        #        #") << "outside the grid";
}

TEST(Report, TheFirstDifferenceOfEveryField) {
  state::Volume base({4, 3, 2});
  worlds::put(base, 1, 1, 1, 100, 50, 25);
  const auto expect = [&](const state::Volume& other, const std::string& field, std::int64_t a,
                          std::int64_t b) {
    const Difference d = first_difference(base, other);
    EXPECT_EQ(d.field, field);
    EXPECT_EQ(d.expected, a) << field;
    EXPECT_EQ(d.actual, b) << field;
    if (field.empty()) return;
    EXPECT_EQ((std::array{d.x, d.y, d.z}), (std::array{1, 1, 1})) << field;
  };
  const auto changed = [&](std::int32_t amount, std::int32_t energy, std::int32_t heat) {
    state::Volume other = base;
    worlds::put(other, 1, 1, 1, amount, energy, heat);
    return other;
  };
  expect(base, "", 0, 0);
  expect(changed(101, 50, 25), "amount", 100, 101);
  expect(changed(100, 51, 25), "energy", 50, 51);
  expect(changed(100, 50, 26), "heat", 25, 26);
  state::Volume solid = base;
  solid.liquid.set(1, 1, 1, false);
  solid.solid.set(1, 1, 1, true);
  expect(solid, "state", 1, 2);
}

// The order is that of a stream: x before y before z.
TEST(Report, OfManyDifferencesTheFirstIsNamed) {
  const state::Volume base({4, 3, 2});
  state::Volume other = base;
  for (const auto& [x, y, z] : {std::array{0, 0, 1}, {1, 2, 0}, {0, 1, 0}, {3, 0, 0}}) {
    worlds::put(other, x, y, z, 7, 0, 0);
    const Difference d = first_difference(base, other);
    EXPECT_EQ((std::array{d.x, d.y, d.z}), (std::array{x, y, z}));
  }
}

TEST(Report, AFaultIsFoundWhereItWasPlantedOrNot) {
  VerifyReport report;
  EXPECT_FALSE(report.found_where_planted());
  report.mismatch = std::make_unique<Mismatch>(mismatch_with_distinct_numbers());
  EXPECT_FALSE(report.found_where_planted()) << "nothing was planted";
  const FaultPlan::Strike right{"apply", 41, 6, 5, 4};
  report.strike = right;
  EXPECT_TRUE(report.found_where_planted());
  for (const FaultPlan::Strike& wrong :
       {FaultPlan::Strike{"melt", 41, 6, 5, 4}, FaultPlan::Strike{"apply", 42, 6, 5, 4},
        FaultPlan::Strike{"apply", 41, 7, 5, 4}, FaultPlan::Strike{"apply", 41, 6, 6, 4},
        FaultPlan::Strike{"apply", 41, 6, 5, 5}}) {
    report.strike = wrong;
    EXPECT_FALSE(report.found_where_planted());
  }
  report.strike = right;
  report.mismatch = nullptr;
  EXPECT_FALSE(report.found_where_planted()) << "nothing was found";
}

}  // namespace
}  // namespace voxmelt::hwmodel
