// A ball melts from outside, in a mould that is full and in an oven, against a plain program in one
// dimension.
#include "accuracy/ball.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/ball_state.h"
#include "accuracy/cells.h"
#include "accuracy/radial.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr double kRadii[] = {12, 20};
constexpr double kParts[] = {0.25, 0.5, 0.75, 0.9};
constexpr double kLate = 0.8;  // what is left then is rough, and has more corners

int side_of(double radius) { return static_cast<int>(2 * radius) + 4; }

Chart chart_of(const std::string& title) {
  Chart chart{.title = title, .x_label = "part that has melted, %", .y_label = "steps over exact"};
  chart.curves.push_back({.name = "exact", .points = {{25, 1}, {90, 1}}, .exact = true});
  return chart;
}

// Runs until each part has melted. Gives the steps over the exact ones.
void follow(Outcome& outcome, Chart& chart, Trial& trial, const std::string& setting,
            const std::function<double(double)>& exact) {
  const double all = unmelted(trial);
  Curve curve{.name = setting};
  double before = 0, now = 0;
  for (const double part : kParts) {
    const double wanted = exact(part);
    while (now < part && trial.steps() < 3 * wanted) {
      trial.run_to(trial.steps() + 1);
      before = now;
      now = 1 - unmelted(trial) / all;
    }
    const double steps = trial.steps() - (now - part) / std::max(now - before, 1e-9);
    outcome.rows.push_back({.setting = fmt::format("{}, {:g} % melted", setting, 100 * part),
                            .quantity = "steps over exact",
                            .value = steps / wanted,
                            .exact = 1,
                            .gate = part < kLate ? 0.02 : 0.03,
                            .note = now < part ? "not in three times the exact steps" : "",
                            .speed = trial.speed()});
    curve.points.push_back({100 * part, steps / wanted});
  }
  chart.curves.push_back(std::move(curve));
}

}  // namespace

// The wall's temperature is that of the centres of its cells. Behind a face along axis i of a plane with the
// normal n they lie up to |n_i| beyond it, and |n_i| such faces are on each unit of area. So their mean
// distance is (sum n_i^2 / 2) / sum |n_i|. Over a sphere that is (1/2) / (3/2). The melt stays where it is.
Outcome measure_ball_in_mould(const Conditions& conditions) {
  constexpr double kGamma = 0.3, kBeyond = 1. / 3, kMelting = 0.02, kLatent = 0.4, kWall = 0.42;
  Outcome outcome;
  Chart chart = chart_of("Time that a ball in a mould takes, over exact");
  for (const std::string law : {"paper", "viscous"})
    for (const double radius : kRadii) {
      const bool viscous = law == "viscous";
      if (viscous && conditions.quick && radius > 12) continue;
      double equal = 0;
      std::vector<std::string> sets{fmt::format("grid.size=[{0},{0},{0}]", side_of(radius)),
                                    fmt::format("heat.gamma={}", kGamma)};
      if (viscous) sets.insert(sets.end(), {"flow.law=\"viscous\"", "flow.viscous.kappa=0.02"});
      Trial trial(conditions, "mould", sets, [&](state::Volume& v) {
        equal = put_ball(v, radius, kMelting * kHottest, (kWall + kLatent) * kHottest);
      });
      const MouldedBall ball{equal, kBeyond, diffusivity(kGamma, 6), (kWall - kMelting) / kLatent};
      const auto exact = [&](double part) { return ball.time_of(part); };
      follow(outcome, chart, trial, fmt::format("{} law, radius {:g}", law, radius), exact);
    }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

Outcome measure_ball_in_oven(const Conditions& conditions) {
  constexpr double kExchange = 0.02, kAir = 0.9, kMelting = 0.4, kLatent = 0.2;
  Outcome outcome;
  Chart chart = chart_of("Time that a ball in an oven takes, over exact");
  for (const double radius : kRadii) {
    double equal = 0;
    const int side = side_of(radius);
    Trial trial(conditions, "oven",
                {fmt::format("grid.size=[{0},{0},{0}]", side), fmt::format("drain.0.radius={}", 2 * side),
                 fmt::format("heat.air.exchange={}", kExchange)},
                [&](state::Volume& v) { equal = put_ball(v, radius, kMelting * kHottest, 0); });
    const BaredBall ball{equal, kExchange * (kAir - kMelting) / kLatent};
    const auto exact = [&](double part) { return ball.time_of(part); };
    follow(outcome, chart, trial, fmt::format("radius {:g}", radius), exact);
  }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

}  // namespace voxmelt::accuracy
