// These cases run communicating vessels: both surfaces end at one height.
#include "accuracy/level.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

struct Shaft {
  int x0, x1, z0, z1;  // cells, end not included
};

// Returns the liquid above `bottom`, in cells per column.
double height(const state::Volume& v, const Shaft& s, int bottom) {
  double sum = 0;
  for (int z = s.z0; z < s.z1; ++z)
    for (int y = bottom; y < v.grid.y; ++y)
      for (int x = s.x0; x < s.x1; ++x)
        if (v.liquid.test(x, y, z)) sum += v.amount[v.at(x, y, z)] / kOne;
  return sum / ((s.x1 - s.x0) * (s.z1 - s.z0));
}

struct Vessels {
  Shaft left, right;  // a tunnel joins them, as wide as they are, with a ceiling
  int bottom;
  int ceiling;                                // in cells above the bottom
  std::optional<double> incompressible_gate;  // for the mean height against an incompressible liquid's

  static double area(const Shaft& s) { return (s.x1 - s.x0) * (s.z1 - s.z0); }
  double level(double volume, double stiffness) const {
    return conduit_level(volume, area(left) + area(right), area({left.x1, right.x0, left.z0, left.z1}),
                         ceiling, stiffness);
  }
};

Outcome follow(Trial& trial, const Vessels& vessels, const std::vector<std::uint32_t>& ends) {
  const int stiffness = trial.simulation().parameters().flow.viscous.stiffness;
  const double volume = moments(Columns(trial.volume())).volume;
  const double level = vessels.level(volume, stiffness);
  const double incompressible = vessels.level(volume, std::numeric_limits<double>::infinity());
  Outcome outcome;
  Curve left{.name = "left"}, right{.name = "right"};
  Curve exact{.name = "level", .points = {{1, level}, {1. * ends.back(), level}}, .exact = true};
  for (const std::uint32_t end : ends) {
    for (const std::uint32_t step : Trial::samples(trial.steps() + 1, end)) {
      trial.run_to(step);
      left.points.push_back({1. * step, height(trial.volume(), vessels.left, vessels.bottom)});
      right.points.push_back({1. * step, height(trial.volume(), vessels.right, vessels.bottom)});
    }
    const double l = height(trial.volume(), vessels.left, vessels.bottom);
    const double r = height(trial.volume(), vessels.right, vessels.bottom), mean = (l + r) / 2;
    const auto row = [&](const std::string& which, const std::string& quantity, double value, double wanted,
                         std::optional<double> gate) {
      outcome.rows.push_back({.setting = fmt::format("{}, step {}", which, end),
                              .quantity = quantity,
                              .value = value,
                              .exact = wanted,
                              .measure = Measure::absolute,
                              .gate = gate,
                              .speed = trial.speed()});
    };
    row("left", "height, cells", l, level, 0.1);
    row("right", "height, cells", r, level, 0.1);
    row("left less right", "difference of the heights, cells", l - r, 0, 0.1);
    row("mean of both", "height, cells", mean, level, 0.01);  // without the slope that heads may keep
    row("mean of both", "height, cells, beside an incompressible liquid's", mean, incompressible,
        vessels.incompressible_gate);
    outcome.rows.back().note =
        fmt::format("a conduit of stiffness {} takes up the rest under its roof", stiffness);
  }
  outcome.charts.push_back({.title = "Heights in the two shafts",
                            .x_label = "step",
                            .y_label = "height, cells",
                            .curves = {std::move(exact), std::move(left), std::move(right)},
                            .logarithmic_x = true});
  return outcome;
}

}  // namespace

// Runs the scene lesson_tubes to its own end. Its 600 cells of liquid would fill the tunnel with 480, and
// each shaft of 30 cells with 60 above it, if they were incompressible.
Outcome measure_tubes(const Conditions& conditions) {
  Trial trial(conditions, "../lesson_tubes", {});
  const Vessels vessels{{4, 9, 3, 9}, {19, 24, 3, 9}, 2, 4, {}};
  return follow(trial, vessels, conditions.quick ? std::vector{4000u} : std::vector{4000u, 20000u});
}

// Runs two shafts of 3 x 3 above a tunnel 3 high, one filled 21 high and the other 3. An incompressible
// liquid would stand at 12.
Outcome measure_u_tube(const Conditions& conditions) {
  Trial trial(conditions, "flow", {"grid.size=[11,30,5]", "flow.viscous.kappa=0.1"}, [](state::Volume& v) {
    for_each_cell(v.grid, [&](int x, int y, int z) {
      const bool across = z >= 1 && z < 4, left = x >= 1 && x < 4, right = x >= 7 && x < 10;
      const bool shaft = (left || right) && y >= 1 && y < 29, tunnel = x >= 1 && x < 10 && y >= 1 && y < 4;
      if (!across || !(shaft || tunnel))
        put_inert(v, x, y, z);
      else if (y < (left ? 22 : 4))
        put_liquid(v, x, y, z, 1);
    });
  });
  return follow(trial, {{1, 4, 1, 4}, {7, 10, 1, 4}, 1, 3, 1.2}, {20000u});
}

}  // namespace voxmelt::accuracy
