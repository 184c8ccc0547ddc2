// These cases run dams that break in a channel, and drops that start from a disc.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/spreading.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

// Returns the middle row of a channel. The side walls bar diagonals, and have no effect there.
std::vector<double> middle_row(const Columns& columns) {
  const auto first = columns.depth.begin() + static_cast<std::ptrdiff_t>(columns.nz / 2) * columns.nx;
  return {first, first + columns.nx};
}
double mean_x(const std::vector<double>& depth) {  // distance from the closed end
  double sum = 0, sum_x = 0;
  for (std::size_t x = 0; x < depth.size(); ++x) {
    sum += depth[x];
    sum_x += depth[x] * (static_cast<double>(x) + 0.5);
  }
  return sum_x / sum;
}
double rms_x(const std::vector<double>& depth) {
  double sum = 0, sum_x2 = 0;
  for (std::size_t x = 0; x < depth.size(); ++x) {
    const double at = static_cast<double>(x) + 0.5;
    sum += depth[x];
    sum_x2 += depth[x] * at * at;
  }
  return std::sqrt(sum_x2 / sum);
}

Trial channel(const Conditions& conditions, double kappa, int length, int height, int width,
              const std::function<double(int x)>& depth, std::vector<std::string> sets = {}) {
  sets.push_back(fmt::format("grid.size=[{},{},{}]", length, height, width));
  sets.push_back(fmt::format("flow.viscous.kappa={}", kappa));
  return {conditions, "flow", std::move(sets), [&](state::Volume& v) {
            for (int z = 0; z < width; ++z)
              for (int x = 0; x < length; ++x) put_column(v, x, z, depth(x));
          }};
}

}  // namespace

// Runs a dam on Huppert's profile, from depth 4 to 2 (32 times its age).
Outcome measure_dam_length(const Conditions& conditions) {
  const double kappa = 0.05, front = 24;
  const Dam dam = dam_of_depth(kappa, 4, front);
  const double age = dam.time_of_front(front);
  Trial trial = channel(conditions, kappa, static_cast<int>(2 * front) + 8, 6, 33,
                        [&](int x) { return dam.height(x + 0.5, age); });
  Outcome outcome;
  Curve error{.name = "depth 4 to 2, kappa 0.05"};
  std::vector<Point> lengths;  // time, length
  for (const double older : {2., 4., 8., 16., 32.}) {
    trial.run_to(step_at(age * (older - 1)));
    const double time = age + trial.steps(), length = rms_x(middle_row(Columns(trial.volume())));
    lengths.push_back({time, length});
    error.points.push_back({static_cast<double>(trial.steps()), 100 * (length / dam.rms_length(time) - 1)});
  }
  const Point first = lengths[1], last = lengths.back();
  const std::string setting = fmt::format("step {}", trial.steps());
  outcome.rows.push_back({.setting = setting,
                          .quantity = "rms length, cells",
                          .value = last.y,
                          .exact = dam.rms_length(last.x),
                          .gate = 0.01,
                          .speed = trial.speed()});
  outcome.rows.push_back({.setting = setting,
                          .quantity = "exponent of the length over time",
                          .value = std::log(last.y / first.y) / std::log(last.x / first.x),
                          .exact = 0.2,
                          .measure = Measure::absolute,
                          .gate = 0.01,
                          .speed = trial.speed()});
  Curve measured{.name = "automaton"}, exact{.name = "Huppert", .exact = true};
  const std::vector<double> row = middle_row(Columns(trial.volume()));
  for (std::size_t x = 0; x < row.size(); ++x) {
    const double at = static_cast<double>(x) + 0.5;
    measured.points.push_back({at, row[x]});
    exact.points.push_back({at, dam.height(at, last.x)});
  }
  outcome.charts = {{.title = "Error of the rms length",
                     .x_label = "step",
                     .y_label = "error, %",
                     .curves = {std::move(error)},
                     .logarithmic_x = true,
                     .band = 1},
                    {.title = "Profile, " + setting,
                     .x_label = "distance from the wall, cells",
                     .y_label = "depth, cells",
                     .curves = {std::move(exact), std::move(measured)}}};
  return outcome;
}

// Runs the same dam from depth 4 to 2.6 between walls. A wide sheet has no walls, so the width has no effect.
Outcome measure_dam_width(const Conditions& conditions) {
  const double kappa = 0.05, front = 24, older = 8;
  const Dam dam = dam_of_depth(kappa, 4, front);
  const double age = dam.time_of_front(front);
  Outcome outcome;
  for (const int width : {1, 2, 3, 5, 9, 33}) {
    Trial trial = channel(conditions, kappa, static_cast<int>(2 * front) + 8, 6, width,
                          [&](int x) { return dam.height(x + 0.5, age); });
    const auto way = [&] { return rms_x(middle_row(Columns(trial.volume()))); };
    const double begin = way();
    trial.run_to(step_at(age * (older - 1)));
    outcome.rows.push_back({.setting = fmt::format("{} cells wide, step {}", width, trial.steps()),
                            .quantity = "growth of the rms length, cells",
                            .value = way() - begin,
                            .exact = dam.rms_length(age + trial.steps()) - dam.rms_length(age),
                            .gate = 0.01,
                            .speed = trial.speed()});
  }
  return outcome;
}

namespace {

// Returns the liquid of a row that lies elsewhere than in another one, part of all.
double elsewhere(const std::vector<double>& row, const std::vector<double>& exact) {
  double moved = 0, all = 0;
  for (std::size_t x = 0; x < row.size(); ++x) {
    moved += std::abs(row[x] - exact[x]) / 2;
    all += exact[x];
  }
  return moved / all;
}

// Runs a dam in cells of `size` units, and in steps as many times shorter. Kappa = g dt / nu in cells goes by
// the square of the size of a cell. Nothing is said of sub-steps. The rows are in cells.
Row refined_dam(const Conditions& conditions, const std::string& name, double kappa, double size, double time,
                const std::vector<double>& start, const std::vector<double>& exact) {
  const int length = static_cast<int>(start.size());
  const int high = static_cast<int>(*std::max_element(start.begin(), start.end())) + 2;
  Trial trial = channel(conditions, kappa * size * size, length, high, 3,
                        [&](int x) { return start[static_cast<std::size_t>(x)]; });
  trial.run_to(step_at(time / size));
  return {.setting = fmt::format("{}, cells of {:g}, step {}", name, size, trial.steps()),
          .quantity = "liquid that lies elsewhere, part of all",
          .value = elsewhere(middle_row(Columns(trial.volume())), exact),
          .measure = Measure::absolute,
          .speed = trial.speed()};
}

}  // namespace

// Runs a dam on Huppert's profile from depth 3 to 1.5, and a box 8 high and 16 long, beside which lubrication
// theory stands. A box has cliffs, which theory does not know. So it comes no closer than 2 %.
Outcome measure_dam_refined(const Conditions& conditions) {
  constexpr double kDepth = 3, kFront = 32, kOlder = 32, kSlow = 0.1;
  constexpr double kHigh = 8, kLong = 16, kChannel = 40, kTime = 48, kFast = 0.05;
  constexpr int kParts = 8;
  const Dam dam = dam_of_depth(kSlow, kDepth, kFront);
  const double age = dam.time_of_front(kFront);
  std::vector<double> box(static_cast<std::size_t>(kChannel) * kParts, 0.0);
  std::fill_n(box.begin(), static_cast<std::size_t>(kLong) * kParts, kHigh);
  const std::vector<double> broken = lubrication_flow(kFast, box, kTime, kParts);

  Outcome outcome;
  const std::vector<double> sizes = conditions.quick ? std::vector{2., 1.} : std::vector{2., 1., 0.5, 0.25};
  for (const double size : sizes) {
    std::vector<double> start, exact;
    for (double x = size / 2; x < 2.2 * kFront; x += size) {
      start.push_back(dam.height(x, age) / size);
      exact.push_back(dam.height(x, kOlder * age) / size);
    }
    outcome.rows.push_back(
        refined_dam(conditions, "Huppert's profile", kSlow, size, age * (kOlder - 1), start, exact));
    outcome.rows.back().gate = 0.003;
  }
  for (const double size : sizes) {
    const std::size_t cells = static_cast<std::size_t>(kChannel / size), parts = box.size() / cells;
    std::vector<double> start(cells), exact(cells, 0.0);
    for (std::size_t i = 0; i < box.size(); ++i) {
      start[i / parts] = box[i] / size;
      exact[i / parts] += broken[i] / size / static_cast<double>(parts);
    }
    outcome.rows.push_back(refined_dam(conditions, "a box", kFast, size, kTime, start, exact));
    outcome.rows.back().gate = 0.02;
  }
  return outcome;
}

// Compares dams 16 high and 32 long after equal kappa x steps. Only their viscosity differs.
Outcome measure_dam_viscosity(const Conditions& conditions) {
  constexpr int kHigh = 16, kLong = 32, kChannel = 112, kParts = 8;
  const int wide = conditions.quick ? 9 : 17;
  constexpr double kLater = 4;  // kappa x steps, when the far end of the dam has an effect at the wall
  Outcome outcome;
  Chart chart{.title = "Dams after kappa x steps = 4",
              .x_label = "distance from the wall, cells",
              .y_label = "depth, cells"};
  const auto exact_at = [&](double time) {
    std::vector<double> start(kChannel * kParts, 0.0);
    std::fill_n(start.begin(), kLong * kParts, double{kHigh});
    return lubrication_flow(1, start, time, kParts);
  };
  const std::vector<double> after_1 = exact_at(1), after_4 = exact_at(kLater);
  Curve exact{.name = "lubrication theory", .exact = true};
  for (std::size_t i = 0; i < after_4.size(); i += 4)
    exact.points.push_back({(static_cast<double>(i) + 0.5) / kParts, after_4[i]});
  chart.curves.push_back(std::move(exact));
  std::optional<double> first_height;
  for (const double kappa : {0.001, 0.01, 0.1}) {
    Trial trial = channel(conditions, kappa, kChannel, kHigh + 2, wide,
                          [&](int x) { return x < kLong ? kHigh : 0.; }, {"flow.viscous.substeps_max=1024"});
    const std::string setting = fmt::format("kappa {:g}", kappa);
    trial.run_to(step_at(1 / kappa));
    const double middle = mean_x(middle_row(Columns(trial.volume())));
    outcome.rows.push_back({.setting = setting + ", kappa x steps = 1",
                            .quantity = "centre of mass, cells from the wall",
                            .value = middle,
                            .exact = mean_x(after_1) / kParts,
                            .speed = trial.speed()});
    trial.run_to(step_at(kLater / kappa));
    const std::vector<double> row = middle_row(Columns(trial.volume()));
    if (first_height)
      outcome.rows.push_back({.setting = setting + ", kappa x steps = 4",
                              .quantity = "height at the wall over that at kappa 0.001",
                              .value = row[0] / *first_height,
                              .exact = 1,
                              .gate = 0.02,
                              .speed = trial.speed()});
    if (!first_height) first_height = row[0];
    outcome.rows.push_back({.setting = setting + ", kappa x steps = 4",
                            .quantity = "height at the wall, cells",
                            .value = row[0],
                            .exact = after_4[0],
                            .speed = trial.speed()});
    Curve curve{.name = setting};
    for (std::size_t x = 0; x < row.size() && row[x] > 0; ++x)
      curve.points.push_back({static_cast<double>(x) + 0.5, row[x]});
    chart.curves.push_back(std::move(curve));
  }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

// Runs a disc of radius 12 and depth 4 under both laws. The rows say how round it stays, and how fast it
// grows in the end.
Outcome measure_drop_shape(const Conditions& conditions) {
  constexpr int kHalf = 40;
  Outcome outcome;
  Chart chart{
      .title = "Roundness of a drop", .x_label = "step", .y_label = "a4 - 1, %", .logarithmic_x = true};
  for (const std::string law : {"viscous", "paper"}) {
    const bool viscous = law == "viscous";
    Trial trial(conditions, viscous ? "flow" : "paper_drop",
                {fmt::format("grid.size=[{0},7,{0}]", 2 * kHalf + 1)}, [&](state::Volume& v) {
                  for (int z = 0; z < v.grid.z; ++z)
                    for (int x = 0; x < v.grid.x; ++x) {
                      if (std::hypot(x - kHalf, z - kHalf) > 12) continue;
                      put_column(v, x, z, 4);
                      for (int y = 0; y < 4 && !viscous; ++y)
                        v.energy[v.at(x, y, z)] = v.amount[v.at(x, y, z)];
                    }
                });
    Curve curve{.name = law + " law"};
    std::vector<Point> radii;
    double a4 = 1;
    for (const std::uint32_t step : {50u, 100u, 200u, 400u, 800u, 1600u}) {
      trial.run_to(step);
      const Moments m = moments(Columns(trial.volume()));
      a4 = m.a4;
      radii.push_back({static_cast<double>(step), m.rms_radius});
      curve.points.push_back({static_cast<double>(step), 100 * (a4 - 1)});
    }
    Row round{.setting = law + " law, step 1600",
              .quantity = "four-fold moment a4",
              .value = a4,
              .exact = 1,
              .measure = Measure::absolute,
              .speed = trial.speed()};
    if (viscous) round.gate = 0.005;
    outcome.rows.push_back(std::move(round));
    outcome.rows.push_back({.setting = law + " law, steps 800 to 1600",
                            .quantity = "exponent of the radius over time",
                            .value = std::log2(radii[5].y / radii[4].y),
                            .exact = 0.125,
                            .measure = Measure::absolute,
                            .speed = trial.speed()});
    chart.curves.push_back(std::move(curve));
  }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

}  // namespace voxmelt::accuracy
