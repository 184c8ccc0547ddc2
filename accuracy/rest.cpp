// Liquid that must rest rests, falling liquid stays whole, and nothing is compressed in the open.
#include "accuracy/rest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {

double motion(Trial& trial, std::uint32_t steps) {
  const auto before = trial.volume().amount;
  trial.run_to(trial.steps() + steps);
  double sum = 0;
  for_each_cell(trial.volume().grid, [&](int x, int y, int z) {
    const state::Slot cell = trial.volume().at(x, y, z);
    sum += std::abs(trial.volume().amount[cell] - before[cell]) / kOne;
  });
  return sum / 2;
}

namespace {

Trial flow(const Conditions& conditions, std::array<int, 3> size, std::vector<std::string> more,
           const Trial::Fill& fill) {
  more.insert(more.begin(), fmt::format("grid.size=[{},{},{}]", size[0], size[1], size[2]));
  return {conditions, "flow", more, fill};
}

Row absolute(const std::string& setting, const std::string& quantity, double value, double exact,
             std::optional<double> gate, const Trial& trial) {
  return {.setting = setting,
          .quantity = quantity,
          .value = value,
          .exact = exact,
          .measure = Measure::absolute,
          .gate = gate,
          .speed = trial.speed()};
}

}  // namespace

// A closed full box has no flow at all, a checkerboard of a pool goes flat, and a film with a yield stress
// stops.
Outcome measure_rest(const Conditions& conditions) {
  Outcome outcome;
  Trial box = flow(conditions, {12, 6, 12}, {"flow.viscous.kappa=20"}, [](state::Volume& v) {
    for_each_cell(v.grid, [&](int x, int y, int z) { put_liquid(v, x, y, z, 1); });
  });
  outcome.rows.push_back(
      absolute("a full box, closed", "cells moved in 200 steps", motion(box, 200), 0, 0, box));

  Trial pool = flow(conditions, {20, 8, 20}, {}, [](state::Volume& v) {
    for (int z = 0; z < 20; ++z)
      for (int x = 0; x < 20; ++x) put_column(v, x, z, (x + z) % 2 ? 4.25 : 3.25);
  });
  Chart chart{.title = "A checkerboard pool goes flat",
              .x_label = "step",
              .y_label = "largest difference of neighbours, cells",
              .logarithmic_x = true};
  Curve curve{.name = "kappa 0.02"};
  double rough = 0;
  for (const std::uint32_t step : Trial::samples(1, 1500)) {
    pool.run_to(step);
    const Columns columns(pool.volume());
    rough = 0;
    for (int z = 0; z + 1 < columns.nz; ++z)
      for (int x = 0; x + 1 < columns.nx; ++x)
        rough = std::max({rough, std::abs(columns.at(x, z) - columns.at(x + 1, z)),
                          std::abs(columns.at(x, z) - columns.at(x, z + 1))});
    curve.points.push_back({1. * step, rough});
  }
  outcome.rows.push_back(absolute("a checkerboard pool, step 1500", "largest difference of neighbours, cells",
                                  rough, 0, 0.01, pool));
  outcome.rows.push_back(
      absolute("a checkerboard pool, step 1500", "cells moved in 100 steps", motion(pool, 100), 0, 0, pool));
  chart.curves.push_back(std::move(curve));
  outcome.charts.push_back(std::move(chart));

  Trial film = flow(conditions, {41, 3, 41}, {"flow.viscous.kappa=2.0", "flow.viscous.yield=0.01"},
                    [](state::Volume& v) {
                      for (int z = 0; z < 41; ++z)
                        for (int x = 0; x < 41; ++x)
                          if (std::hypot(x - 20, z - 20) <= 8) put_column(v, x, z, 0.5);
                    });
  film.run_to(5000);
  outcome.rows.push_back(absolute("a film with a yield stress, step 5000", "cells moved in 200 steps",
                                  motion(film, 200), 0, 0, film));
  outcome.rows.push_back(absolute("a film with a yield stress, at rest", "four-fold moment a4",
                                  moments(Columns(film.volume())).a4, 1, 0.03, film));
  return outcome;
}

// A block of odd amounts falls one cell per step, whole. A funnel of one cell empties a basin of 243 cells.
Outcome measure_fall(const Conditions& conditions) {
  Outcome outcome;
  const auto amount = [](int x, int y, int z) { return (1 + (7 * x + 13 * y + 29 * z) % 97) / 97.0; };
  Trial block = flow(conditions, {9, 30, 9}, {}, [&](state::Volume& v) {
    for (int z = 3; z < 6; ++z)
      for (int y = 24; y < 29; ++y)
        for (int x = 3; x < 6; ++x) put_liquid(v, x, y, z, amount(x, y, z));
  });
  const state::Volume start = block.volume();
  int wrong = 0;
  for (int fallen = 1; fallen <= 24; ++fallen) {
    block.run_to(fallen);
    for_each_cell(start.grid, [&](int x, int y, int z) {
      const int above = y + fallen;
      const int wanted = above < start.grid.y ? start.amount[start.at(x, above, z)] : 0;
      wrong += block.volume().amount[start.at(x, y, z)] != wanted;
    });
  }
  outcome.rows.push_back(absolute("a block falls 24 cells in 24 steps",
                                  "cells that are not where they should be", wrong, 0, 0, block));

  Trial funnel = flow(conditions, {9, 14, 9}, {"flow.viscous.kappa=0.5"}, [](state::Volume& v) {
    for_each_cell({9, 10, 9}, [&](int x, int y, int z) {
      if (y == 6 && (x != 4 || z != 4)) put_inert(v, x, y, z);
      if (y > 6) put_liquid(v, x, y, z, 1);
    });
  });
  Chart chart{.title = "A funnel of one cell empties a basin",
              .x_label = "step",
              .y_label = "liquid above the funnel, cells"};
  Curve curve{.name = "kappa 0.5"};
  double left = 0;
  for (std::uint32_t step = 0; step <= 3000; step += 150) {
    funnel.run_to(step);
    left = 0;
    for_each_cell(funnel.volume().grid, [&](int x, int y, int z) {
      if (y > 6) left += funnel.volume().amount[funnel.volume().at(x, y, z)] / kOne;
    });
    curve.points.push_back({1. * step, left});
  }
  outcome.rows.push_back(absolute("a funnel of one cell, step 3000",
                                  "cells left of 243 (a film of half a cell)", left, 0, 40, funnel));
  chart.curves.push_back(std::move(curve));
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

// Finds the largest amount that a cell holds after a step, while a ball drops and a vent pours.
Outcome measure_filling(const Conditions& conditions) {
  Trial trial(conditions, "pour", {});
  Outcome outcome;
  Chart chart{.title = "The largest amount in the open", .x_label = "step", .y_label = "amount of one cell"};
  Curve curve{.name = "kappa 0.05"};
  double largest = 0;
  for (std::uint32_t step = 1; step <= 300; ++step) {
    trial.run_to(step);
    const auto amounts = trial.volume().amount.stored();
    const double now = *std::max_element(amounts.begin(), amounts.end()) / kOne;
    largest = std::max(largest, now);
    if (step % 5 == 0) curve.points.push_back({1. * step, now});
  }
  outcome.rows.push_back(
      absolute("a drop and a vent, 300 steps", "largest amount of a cell", largest, 1, 0.25, trial));
  chart.curves.push_back(std::move(curve));
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

// A column of cells that hold too little or too much becomes full cells. By right each takes the parts of the
// column between its own ends, with their heat. Liquid that passes through a cell mixes with it, which costs
// about the difference of one cell's heat from the next one's, 0.014 of the range.
Outcome measure_layers(const Conditions& conditions) {
  constexpr int kCells = 32, kGivenOne = 4096;
  const auto amount = [](int k) { return 3700 + 397 * k % 800; };
  const auto heat = [](int k) { return 36000. + 900 * k; };
  Trial column(conditions, "column", {R"(flow.law="viscous")", "flow.viscous.kappa=0.02", "heat.gamma=0"},
               [&](state::Volume& v) {
                 for (int y = 0; y < kCells; ++y) {
                   put_liquid(v, 0, y, 0, amount(y) / kOne);
                   v.heat[v.at(0, y, 0)] = to_units(heat(y));
                 }
               });
  column.run_to(1);
  double wrong = 0;
  int bottom = 0, part = 0, taken = 0;  // the part that is being laid down, and the amount of it laid so far
  while (part < kCells) {
    int held = 0;
    double sum = 0;
    while (held < kGivenOne && part < kCells) {
      const int gets = std::min(kGivenOne - held, amount(part) - taken);
      held += gets;
      taken += gets;
      sum += gets * heat(part);
      if (taken == amount(part)) {
        ++part;
        taken = 0;
      }
    }
    wrong = std::max(wrong, std::abs(column.volume().heat[column.volume().at(0, bottom++, 0)] - sum / held));
  }
  Outcome outcome;
  outcome.rows.push_back(absolute("32 cells of 0.9 to 1.1 settle",
                                  "largest difference of heat, part of the range", wrong / kHottest, 0, 0.02,
                                  column));
  return outcome;
}

}  // namespace voxmelt::accuracy
