// These cases run a whole scene on finer grids and with shorter steps: its results should converge.
#include "accuracy/convergence.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

// The scale of a scene makes cells `finer` times as small and steps `shorter` times as short. Per step and
// cell, diffusivity goes with dt / dx^2, exchange with dt / dx, kappa with dt dx.
struct Scale {
  int finer, shorter;
};

struct Ball {
  std::string name;
  Scale scale;
  std::uint32_t steps;  // at scale 1
  std::function<Trial(const Conditions&, Scale)> trial;
};

// Runs scenes/accuracy/melting_ball.toml, a ball of radius 6 in hot air.
Trial melting(const Conditions& conditions, Scale s) {
  const int side = 32 * s.finer, high = 16 * s.finer, radius = 6 * s.finer;
  return {conditions,
          "melting_ball",
          {fmt::format("grid.size=[{0},{1},{0}]", side, high), fmt::format("solid.0.radius={}", radius),
           fmt::format("solid.0.at=[{0},{1},{0}]", side / 2, radius),
           fmt::format("heat.gamma={}", 0.15 * s.finer * s.finer / s.shorter),
           fmt::format("heat.air.exchange={}", 0.04 * s.finer / s.shorter),
           fmt::format("flow.viscous.kappa={}", 0.05 / s.finer / s.shorter)}};
}

// Runs a ball that has melted, of `diameter` cells at scale 1. kappa x steps is 1 at diameter 32, and kappa x
// steps x diameter is the same for all.
constexpr std::uint32_t kMeltedSteps = 800;
template <int diameter>
Trial melted(const Conditions& conditions, Scale s) {
  const int d = diameter * s.finer, side = 9 * d / 4 + 1;
  const double kappa = 1.0 / kMeltedSteps * 32 / diameter;
  return {conditions,
          "flow",
          {fmt::format("grid.size=[{0},{1},{0}]", side, d + 1),
           fmt::format("flow.viscous.kappa={:.9f}", kappa / s.finer / s.shorter)},
          [&](state::Volume& v) {
            for_each_cell(v.grid, [&](int x, int y, int z) {
              const double m = (side - 1) / 2.0;
              if (std::hypot(x - m, y + 0.5 - d / 2.0, z - m) <= d / 2.0) put_liquid(v, x, y, z, 1);
            });
          }};
}

struct Spread {
  double liquid;  // in cells of the coarsest grid
  double radius;  // rms of the liquid, in edges of those cells
};
Spread spread_of(const Trial& trial, int finer) {
  const Moments m = moments(Columns(trial.volume()));
  return {m.volume / (finer * finer * finer), m.rms_radius / finer};
}

// Compares each ball with the next, finer one. `gate` holds for the radii of the last two.
Outcome compare(const Conditions& conditions, const std::vector<Ball>& balls, const std::string& title,
                std::optional<double> gate) {
  Outcome outcome;
  Chart chart{.title = title,
              .x_label = "time, steps of the first",
              .y_label = "rms radius, cells of the coarsest grid"};
  std::vector<Spread> ends;
  std::vector<Speed> speeds;
  for (const Ball& ball : balls) {
    Trial trial = ball.trial(conditions, ball.scale);
    Curve curve{.name = ball.name};
    Spread spread{};
    for (std::uint32_t sample = 1; sample <= 12; ++sample) {
      const std::uint32_t time = ball.steps * sample / 12;
      trial.run_to(time * ball.scale.shorter);
      spread = spread_of(trial, ball.scale.finer);
      if (spread.liquid > 0) curve.points.push_back({1. * time, spread.radius});
    }
    ends.push_back(spread);
    speeds.push_back(trial.speed());
    chart.curves.push_back(std::move(curve));
  }
  for (std::size_t i = 0; i + 1 < balls.size(); ++i) {
    const std::string setting = balls[i].name + " beside " + balls[i + 1].name;
    Row radius{.setting = setting,
               .quantity = "rms radius of the liquid over the finer one's",
               .value = ends[i].radius / ends[i + 1].radius,
               .exact = 1,
               .note = fmt::format("{:.2f} beside {:.2f}", ends[i].radius, ends[i + 1].radius),
               .speed = speeds[i]};
    if (i + 2 == balls.size()) radius.gate = gate;
    outcome.rows.push_back(std::move(radius));
    outcome.rows.push_back({.setting = setting,
                            .quantity = "liquid over the finer one's",
                            .value = ends[i].liquid / ends[i + 1].liquid,
                            .exact = 1,
                            .note = fmt::format("{:.0f} beside {:.0f}", ends[i].liquid, ends[i + 1].liquid),
                            .speed = speeds[i]});
  }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

}  // namespace

// Steps become shorter by the same factor as cells become smaller.
Outcome measure_melted_ball(const Conditions& conditions) {
  std::vector<Ball> balls;
  if (conditions.quick)
    for (const int n : {1, 2})
      balls.push_back({fmt::format("{} cells", 16 * n), {n, n}, kMeltedSteps, melted<16>});
  else
    for (const int n : {1, 2, 4})
      balls.push_back({fmt::format("{} cells", 32 * n), {n, n}, kMeltedSteps, melted<32>});
  return compare(conditions, balls, "A melted ball on finer grids",
                 conditions.quick ? std::nullopt : std::optional(0.02));
}

// Conduction needs steps that are shorter by the square of that factor.
Outcome measure_convergence_in_grid(const Conditions& conditions) {
  std::vector<Ball> balls;
  for (const int n : conditions.quick ? std::vector{1, 2} : std::vector{1, 2, 4})
    balls.push_back({fmt::format("{} cells", 32 * n), {n, n * n}, 600, melting});
  return compare(conditions, balls, "A melting ball on finer grids", std::nullopt);
}

Outcome measure_convergence_in_step(const Conditions& conditions) {
  std::vector<Ball> balls;
  for (const int n : {1, 2, 4})
    balls.push_back({n == 1 ? "whole steps" : fmt::format("1/{} steps", n), {1, n}, 600, melting});
  return compare(conditions, balls, "A melting ball in shorter steps", std::nullopt);
}

}  // namespace voxmelt::accuracy
