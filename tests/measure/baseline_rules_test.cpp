// Each rule of the baseline is tested where its result is known beforehand.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/neighbourhood.h"
#include "tests/measure/melting_drop.h"

namespace voxmelt::baseline {
namespace {

TEST(BaselineRules, AColumnFallsWholeOneCellPerStep) {
  state::Volume volume(state::Grid{5, 16, 5});
  for (int y = 10; y < 14; ++y) worlds::put(volume, 2, y, 2, rule::kOne, 1000 * (y - 9));
  Baseline<float> baseline(volume, worlds::paper_showcase());

  for (int step = 1; step <= 10; ++step) {
    baseline.gravity();
    for (int y = 0; y < 16; ++y) {
      const bool filled = y >= 10 - step && y < 14 - step;
      const Cell<float> cell = baseline.fields().cell(2, y, 2);
      EXPECT_EQ(cell.liquid, filled) << "step " << step << ", y " << y;
      EXPECT_EQ(cell.amount, filled ? 1.0f : 0.0f);
      EXPECT_EQ(cell.energy, filled ? 1000.0f * static_cast<float>(y + step - 9) / 4096 : 0.0f);
    }
  }
  baseline.gravity();  // on the floor now
  EXPECT_EQ(baseline.fields().cell(2, 0, 2).amount, 1.0f);
  EXPECT_EQ(baseline.fields().cell(2, 3, 2).amount, 1.0f);
}

TEST(BaselineRules, FactorsOfAFallInAirAndAtAWall) {
  rule::Parameters parameters;
  parameters.flow.fall = {.factor = 32768, .wall_factor = 8192, .minimum = 32};
  state::Volume volume(state::Grid{7, 4, 5});
  worlds::put(volume, 3, 2, 2, rule::kOne);
  worlds::put(volume, 0, 2, 2, rule::kOne);
  Baseline<float> baseline(volume, parameters);
  baseline.gravity();
  EXPECT_FLOAT_EQ(baseline.fields().cell(3, 1, 2).amount, 0.5f + 32 / 4096.0f);
  EXPECT_FLOAT_EQ(baseline.fields().cell(0, 1, 2).amount, 0.125f + 32 / 4096.0f);
}

TEST(BaselineRules, ExcessClimbsAsFarAsItMust) {
  state::Volume volume(state::Grid{3, 8, 3});
  worlds::put(volume, 1, 0, 1, 3 * rule::kOne + 2048, 2 * rule::kOne);
  worlds::put(volume, 0, 0, 0, 2 * rule::kOne);
  worlds::put_solid(volume, 0, 1, 0);
  Baseline<float> baseline(volume, worlds::paper_showcase());
  baseline.excess();
  for (int y = 0; y < 3; ++y) EXPECT_EQ(baseline.fields().cell(1, y, 1).amount, 1.0f);
  EXPECT_EQ(baseline.fields().cell(1, 3, 1).amount, 0.5f);
  EXPECT_EQ(baseline.fields().cell(1, 3, 1).energy, 0.5f);
  EXPECT_EQ(baseline.fields().cell(0, 0, 0).amount, 2.0f) << "a solid above holds it down";
}

TEST(BaselineRules, SpreadGivesItsSharesToASubsetOfTheOpenNeighbours) {
  rule::Parameters parameters = worlds::paper_showcase();
  state::Volume volume(state::Grid{5, 3, 5});
  worlds::put(volume, 2, 0, 2, rule::kOne, rule::kOne);
  worlds::put_solid(volume, 3, 0, 2);
  worlds::put_solid(volume, 2, 0, 3);
  Baseline<double> baseline(volume, parameters);
  std::vector<int> given(8, 0);
  for (std::uint32_t step = 0; step < 4000; ++step) {
    Baseline<double> trial = baseline;
    trial.spread(step);
    double left = 1;
    for (std::size_t d = 0; d < 8; ++d) {
      const rule::Direction to = rule::kDirections[d];
      const Cell<double> cell = trial.fields().cell(2 + to.dx, 0, 2 + to.dz);
      if (!cell.liquid) continue;
      ++given[d];
      const double flow = d < 4 ? 0.125 : 0.03125;
      left -= flow;
      EXPECT_DOUBLE_EQ(cell.amount, flow);
      EXPECT_DOUBLE_EQ(cell.energy, flow * 64225 / 65536);
    }
    EXPECT_NEAR(trial.fields().cell(2, 0, 2).amount, left, 1e-12);
    EXPECT_NEAR(trial.fields().cell(2, 0, 2).energy, left, 1e-12);
  }
  // The neighbours +x and +z are solid, and their diagonal is closed with them. All others are given to every
  // other time.
  for (const std::size_t closed : {0u, 2u, 4u}) EXPECT_EQ(given[closed], 0);
  for (const std::size_t open : {1u, 3u, 5u, 6u, 7u}) EXPECT_NEAR(given[open], 2000, 150);
}

TEST(BaselineRules, WhoSpreadsAndHowFarDown) {
  const rule::Parameters parameters = worlds::paper_showcase();
  // Gives the middle of a 3 x 3 square the energy `energy`, its neighbours `around`, all standing on a cell
  // of `below`. Tells which of (face, diagonal) neighbours ever get something in 32 steps.
  const auto receivers = [&](int energy, int around, int below) {
    std::pair<bool, bool> got{false, false};
    for (std::uint32_t step = 0; step < 32; ++step) {
      state::Volume volume(state::Grid{3, 2, 3});
      worlds::for_each({0, 1, 0, 3, 2, 3},
                       [&](int x, int y, int z) { worlds::put(volume, x, y, z, around); });
      worlds::put(volume, 1, 1, 1, rule::kOne, energy);
      worlds::fill(volume, {0, 0, 0, 3, 1, 3}, below);
      Baseline<float> baseline(volume, parameters);
      const auto amount = [&](int x, int z) { return baseline.fields().cell(x, 1, z).amount; };
      const float before = amount(0, 1);
      baseline.spread(step);
      got.first |= amount(0, 1) != before;
      got.second |= amount(0, 0) != before;
    }
    return got;
  };
  using Got = std::pair<bool, bool>;
  const int starved = 1434, energetic = 1435;  // the threshold, and a unit above it
  EXPECT_EQ(receivers(energetic, 0, rule::kOne), Got(true, true));
  EXPECT_EQ(receivers(energetic, 0, 0), Got(false, false)) << "nothing below: no support";
  EXPECT_EQ(receivers(energetic, rule::kOne - 500, rule::kOne), Got(false, false)) << "less than would flow";
  EXPECT_EQ(receivers(energetic, rule::kOne - 520, rule::kOne), Got(true, true));
  EXPECT_EQ(receivers(starved, rule::kOne - 1000, rule::kOne), Got(false, false)) << "less than the slump";
  EXPECT_EQ(receivers(starved, rule::kOne - 1100, rule::kOne), Got(true, false)) << "diagonals: 9/8 of it";
  EXPECT_EQ(receivers(starved, rule::kOne - 1200, rule::kOne), Got(true, true));
}

TEST(BaselineRules, AHangingFilmWaits) {
  rule::Parameters parameters;
  parameters.flow.fall.hang = 1024;
  state::Volume volume(state::Grid{9, 5, 3});
  worlds::put_solid(volume, 2, 3, 1);
  worlds::put(volume, 2, 2, 1, 1000);  // under the solid: hangs
  worlds::put_solid(volume, 4, 3, 1);
  worlds::put(volume, 4, 2, 1, 1030);  // a drop by now: falls
  worlds::put(volume, 6, 2, 1, 1000);  // touches nothing: falls
  Baseline<float> baseline(volume, parameters);
  baseline.gravity();
  EXPECT_TRUE(baseline.fields().cell(2, 2, 1).liquid);
  EXPECT_FALSE(baseline.fields().cell(4, 2, 1).liquid);
  EXPECT_FALSE(baseline.fields().cell(6, 2, 1).liquid);
}

TEST(BaselineRules, ConductionIsEquationOne) {
  for (const int neighbours : {6, 18, 26}) {
    rule::Parameters parameters = worlds::paper_showcase();
    parameters.heat.enabled = true;
    parameters.heat.neighbours = neighbours;
    parameters.heat.weight_face = 2086;
    parameters.heat.weight_edge = 1043;
    parameters.heat.weight_corner = 695;
    parameters.material.melting_point = 65535;
    state::Volume volume(state::Grid{5, 5, 5});
    worlds::for_each({1, 1, 1, 4, 4, 4}, [&](int x, int y, int z) { worlds::put_solid(volume, x, y, z); });
    volume.heat[volume.at(2, 2, 2)] = 32768;
    Baseline<double> baseline(volume, parameters);
    baseline.heat();
    const double hot = 32768.0 / 65535;
    const auto got = [&](int x, int y, int z) { return baseline.fields().cell(x, y, z).temperature / hot; };
    const double face = 2086 / 65536.0, edge = neighbours >= 18 ? 1043 / 65536.0 : 0,
                 corner = neighbours >= 26 ? 695 / 65536.0 : 0;
    EXPECT_NEAR(got(1, 2, 2), face, 1e-12);
    EXPECT_NEAR(got(2, 3, 1), edge, 1e-12);
    EXPECT_NEAR(got(1, 3, 3), corner, 1e-12);
    EXPECT_NEAR(got(2, 2, 2), 1 - 6 * face - 12 * edge - 8 * corner, 1e-12);
    EXPECT_EQ(got(0, 2, 2), 0) << "air does not conduct";
  }
}

TEST(BaselineRules, MeltsAtTheMeltingPoint) {
  rule::Parameters parameters = worlds::paper_showcase();
  parameters.heat.enabled = true;
  parameters.material.melting_point = 32768;
  state::Volume volume(state::Grid{5, 5, 5});
  worlds::put_solid(volume, 2, 0, 2, 3000, 32000);
  worlds::put_solid(volume, 0, 0, 0, 3000, 32767);
  state::Field<std::uint16_t> irradiance(volume.grid);
  irradiance[volume.at(2, 0, 2)] = 16 * 100;  // 100 units per step: the eighth one melts it
  Baseline<float> baseline(volume, parameters);
  const std::vector<float> light = irradiance_of<float>(volume.grid, irradiance);
  for (int step = 1; step <= 8; ++step) {
    baseline.heat(light);
    const Cell<float> cell = baseline.fields().cell(2, 0, 2);
    EXPECT_EQ(cell.solid, step < 8) << step;
    EXPECT_EQ(cell.liquid, step == 8) << step;
    EXPECT_EQ(cell.energy, step == 8 ? 3000 / 4096.0f : 0.0f);
    EXPECT_NEAR(cell.temperature, static_cast<float>(32000 + 100 * step) / 65535, 1e-6f);
  }
  EXPECT_TRUE(baseline.fields().cell(0, 0, 0).solid) << "a unit below the melting point, and in the dark";
}

TEST(BaselineRules, UpdateIsTheBinomialFilter) {
  state::Volume volume(state::Grid{9, 9, 9});
  worlds::put(volume, 4, 4, 4, rule::kOne);
  Baseline<float> one(volume, worlds::paper_showcase());
  one.update();
  const auto filtered = [](const Baseline<float>& b, int x, int y, int z) {
    return int{b.fields().filtered[b.fields().at(x, y, z)]};
  };
  EXPECT_EQ(filtered(one, 4, 4, 4), 32);  // 255 x 8 / 64
  EXPECT_EQ(filtered(one, 5, 4, 4), 16);
  EXPECT_EQ(filtered(one, 4, 3, 5), 8);
  EXPECT_EQ(filtered(one, 3, 5, 5), 4);
  EXPECT_EQ(filtered(one, 6, 4, 4), 0);

  worlds::fill(volume, {2, 2, 2, 7, 7, 7}, 2 * rule::kOne);
  Baseline<float> block(volume, worlds::paper_showcase());
  block.update();
  EXPECT_EQ(filtered(block, 4, 4, 4), 255);
  EXPECT_EQ(filtered(block, 2, 4, 4), 191);  // a quarter of the kernel is outside
}

TEST(BaselineRules, RefusesWhatItDoesNotRun) {
  const state::Volume volume(state::Grid{3, 3, 3});
  EXPECT_THROW(Baseline<float>(volume, worlds::viscous(1)), std::invalid_argument);
  rule::Parameters printed;
  printed.flow.paper.reading = rule::EnergyReading::printed;
  EXPECT_THROW(Baseline<float>(volume, printed), std::invalid_argument);
}

}  // namespace
}  // namespace voxmelt::baseline
