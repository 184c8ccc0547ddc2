// Communicating vessels: both surfaces end at one height.
#include "accuracy/level.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/cells.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

struct Shaft {
  int x0, x1, z0, z1;  // cells, end not included
};

// Liquid above `bottom`, per column.
double height(const state::Volume& v, const Shaft& s, int bottom) {
  double sum = 0;
  for (int z = s.z0; z < s.z1; ++z)
    for (int y = bottom; y < v.grid.y; ++y)
      for (int x = s.x0; x < s.x1; ++x)
        if (v.liquid.test(x, y, z)) sum += v.amount[v.at(x, y, z)] / kOne;
  return sum / ((s.x1 - s.x0) * (s.z1 - s.z0));
}

struct Vessels {
  Shaft left, right;
  int bottom;
  double level;       // where both end
  double level_gate;  // of each height, absolute
};

Outcome follow(Trial& trial, const Vessels& vessels, const std::vector<std::uint32_t>& ends) {
  Outcome outcome;
  Curve left{.name = "left"}, right{.name = "right"};
  Curve exact{
      .name = "level", .points = {{0, vessels.level}, {1. * ends.back(), vessels.level}}, .exact = true};
  for (const std::uint32_t end : ends) {
    for (std::uint32_t step = trial.steps(); step <= end; step += std::max(1u, end / 40)) {
      trial.run_to(step);
      left.points.push_back({1. * step, height(trial.volume(), vessels.left, vessels.bottom)});
      right.points.push_back({1. * step, height(trial.volume(), vessels.right, vessels.bottom)});
    }
    trial.run_to(end);
    const double l = height(trial.volume(), vessels.left, vessels.bottom);
    const double r = height(trial.volume(), vessels.right, vessels.bottom);
    const std::string at = fmt::format("step {}", end);
    for (const auto& [name, value] : {std::pair{"left", l}, std::pair{"right", r}})
      outcome.rows.push_back({.setting = fmt::format("{}, {}", name, at),
                              .quantity = "height, cells",
                              .value = value,
                              .exact = vessels.level,
                              .measure = Measure::absolute,
                              .gate = vessels.level_gate,
                              .speed = trial.speed()});
    outcome.rows.push_back({.setting = at,
                            .quantity = "left less right, cells",
                            .value = l - r,
                            .measure = Measure::absolute,
                            .gate = 0.1,
                            .speed = trial.speed()});
  }
  outcome.charts.push_back({.title = "Heights in the two shafts",
                            .x_label = "step",
                            .y_label = "height, cells",
                            .curves = {std::move(exact), std::move(left), std::move(right)}});
  return outcome;
}

}  // namespace

// The scene lesson_tubes at its own end. 600 cells of liquid: 480 fill the tunnel, 60 each shaft of 30 cells.
Outcome measure_tubes(const Conditions& conditions) {
  Trial trial(conditions, "../lesson_tubes", {});
  const Vessels vessels{{4, 9, 3, 9}, {19, 24, 3, 9}, 2, 6, 0.1};
  return follow(trial, vessels, conditions.quick ? std::vector{4000u} : std::vector{4000u, 20000u});
}

// Two shafts of 3 x 3 above a tunnel 3 high, one filled 21 high and the other 3: level, both stand at 12. The
// liquid in the closed tunnel may be compressed, which lowers both by up to a tenth.
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
  return follow(trial, {{1, 4, 1, 4}, {7, 10, 1, 4}, 1, 12, 1.2}, {20000u});
}

}  // namespace voxmelt::accuracy
