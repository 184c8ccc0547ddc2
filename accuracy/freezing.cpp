// Melts freeze: from a cold wall, from above, by their own glow, and while they flow.
#include "accuracy/freezing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/cooling_sheet.h"
#include "accuracy/measure.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

using Strings = std::vector<std::string>;

constexpr double kGamma = 0.3, kSpan = 0.97, kCold = 0.02, kHalfTheWall = 0.5;

// Is a column of liquid that freezes from above. St is by how much the melting point is above what cools it,
// over the latent heat, and `number_of_liquid` by how much the liquid is above the melting point.
struct Freezing {
  std::string law;
  double number, number_of_liquid;
  int cells;

  double latent() const { return kSpan / (1 + number + number_of_liquid); }
  double melting_point() const { return kCold + number * latent(); }
  double lambda() const { return stefan_lambda(number, number_of_liquid); }
  double time_of(double front) const { return std::pow(front / (2 * lambda()), 2) / diffusivity(kGamma, 6); }
  double front(double time) const { return 2 * lambda() * std::sqrt(diffusivity(kGamma, 6) * time); }

  Trial trial(const Conditions& conditions, Strings sets, bool wall) const {
    sets.push_back(fmt::format("grid.size=[1,{},1]", cells + 1));
    sets.push_back(fmt::format("heat.gamma={}", kGamma));
    sets.push_back(fmt::format("inert.0.at=[0.5,{},0.5]", cells + 0.5));
    sets.push_back(fmt::format("inert.0.temperature={}", kCold));
    sets.push_back(fmt::format("material.melting_point={}", melting_point()));
    sets.push_back(fmt::format("material.latent_heat={}", latent()));
    sets.push_back(fmt::format("material.freezing_point={}", melting_point()));
    sets.push_back(fmt::format("flow.law=\"{}\"", law));
    if (law == "viscous") sets.emplace_back("flow.viscous.kappa=0.02");
    const double heat = kHottest * (melting_point() + latent() * (1 + number_of_liquid));
    return {conditions, "column", sets, [this, heat, wall](state::Volume& v) {
              for (int y = 0; y < cells; ++y) {
                put_liquid(v, 0, y, 0, 1);
                v.heat[v.at(0, y, 0)] = to_units(heat);
              }
              if (!wall) return;
              put_inert(v, 0, cells, 0);
              v.heat[v.at(0, cells, 0)] = to_units(kCold * kHottest);
            }};
  }
  // Returns how many cells of latent heat the column has given off.
  double given_off(const state::Volume& v) const {
    return cells - melted_cells(v, melting_point() * kHottest, latent() * kHottest);
  }
};

// Is the dam of cooling_flow. On finer grids all lengths, times and diffusivities grow by `scale`.
struct CoolingDam {
  double exchange;
  int scale;
  static constexpr double kHot = 0.9, kFreezing = 0.4, kLatent = 0.08, kGammaOfOne = 0.125;
  static constexpr int kParts = 2;

  int length() const { return 160 * scale; }
  int dam() const { return 30 * scale; }
  double depth() const { return 8 * scale; }
  double kappa() const { return 0.05 / (scale * scale); }
  double gamma() const { return kGammaOfOne * scale; }

  Trial trial(const Conditions& conditions) const {
    return {conditions,
            "flow",
            {fmt::format("grid.size=[{},{},1]", length(), 12 * scale),
             fmt::format("flow.viscous.kappa={}", kappa()), fmt::format("heat.gamma={}", gamma()),
             fmt::format("heat.air.exchange={}", exchange), fmt::format("heat.air.bottom={}", kCold),
             fmt::format("material.melting_point={}", kFreezing),
             fmt::format("material.freezing_point={}", kFreezing),
             fmt::format("material.latent_heat={}", kLatent)},
            [this](state::Volume& v) {
              for (int x = 0; x < dam(); ++x) {
                put_column(v, x, 0, depth());
                for (int y = 0; y < depth(); ++y)
                  v.heat[v.at(x, y, 0)] = to_units((kHot + kLatent) * kHottest);
              }
            }};
  }
  std::vector<double> model() const {
    std::vector<double> start(static_cast<std::size_t>(length()) * kParts, 0.0);
    std::fill_n(start.begin(), dam() * kParts, depth());
    return CoolingSheet{kappa(), exchange, diffusivity(gamma(), 6), kLatent, kCold, kFreezing}.at_rest(
        start, kHot, kParts);
  }
};

// Returns the depth of solid and liquid together, along x.
std::vector<double> depths(const state::Volume& v) {
  std::vector<double> depth(static_cast<std::size_t>(v.grid.x), 0.0);
  for_each_cell(v.grid, [&](int x, int y, int z) {
    depth[static_cast<std::size_t>(x)] += v.amount[v.at(x, y, z)] / kOne;
  });
  return depth;
}
// Returns the distance of a part's middle from the closed end.
double middle(std::size_t i, int parts) { return (static_cast<double>(i) + 0.5) / parts; }
// Returns the length of a box with the same root mean square of x.
double length(const std::vector<double>& depth, int parts) {
  double sum = 0, sum_x2 = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    sum += depth[i];
    sum_x2 += depth[i] * middle(i, parts) * middle(i, parts);
  }
  return std::sqrt(3 * sum_x2 / sum);
}
Curve profile(const std::string& name, const std::vector<double>& depth, int parts, bool exact) {
  Curve curve{.name = name, .exact = exact};
  for (std::size_t i = 0; i < depth.size(); ++i) curve.points.push_back({middle(i, parts), depth[i]});
  return curve;
}

int solids(const state::Volume& v) { return static_cast<int>(v.solid.count()); }

Row solid_row(const Trial& trial, const std::string& setting, double exact) {
  return {.setting = setting,
          .quantity = "solid cells",
          .value = 1. * solids(trial.volume()),
          .exact = exact,
          .measure = Measure::absolute,
          .gate = 1.5,
          .note = "the mask knows whole cells",
          .speed = trial.speed()};
}

}  // namespace

// Runs the Stefan problems backwards: liquid under a cold wall.
Outcome measure_freezing(const Conditions& conditions) {
  Outcome outcome;
  for (const std::string law : {"paper", "viscous"})
    for (const Freezing& freezing : {Freezing{law, 0.1, 0, 64}, Freezing{law, 0.5, 0, 64},
                                     Freezing{law, 1, 0.5, conditions.quick ? 128 : 320}}) {
      const bool two = freezing.number_of_liquid > 0;
      const double last = two ? (conditions.quick ? 24 : 64) : 48;
      Trial trial = freezing.trial(conditions, {}, true);
      trial.run_to(step_at(freezing.time_of(last)));
      const double exact = freezing.front(trial.steps());
      std::string setting = fmt::format("{}, St {:g}", law, freezing.number);
      if (two) setting += fmt::format(", liquid {:g} above", freezing.number_of_liquid);
      outcome.rows.push_back({.setting = setting,
                              .quantity = "front, cells",
                              .value = kHalfTheWall + freezing.given_off(trial.volume()),
                              .exact = exact,
                              .gate = 0.01,
                              .speed = trial.speed()});
      outcome.rows.push_back(solid_row(trial, setting, exact - kHalfTheWall));
    }
  return outcome;
}

// Lets cold air freeze a pool from above. The film of air counts as so much more of the crust.
Outcome measure_crust(const Conditions& conditions) {
  constexpr double kExchange = 0.66666;
  const double film = diffusivity(kGamma, 6) / kExchange;
  const Freezing freezing{"viscous", 0.2, 0, 64};
  Trial trial = freezing.trial(
      conditions, {fmt::format("heat.air.exchange={}", kExchange), fmt::format("heat.air.bottom={}", kCold)},
      false);
  Outcome outcome;
  std::vector<Point> crusts;
  Curve measured{.name = "automaton"}, exact{.name = "exact", .exact = true};
  for (const double thickness : {6., 12., 24., 48.}) {
    trial.run_to(step_at(freezing.time_of(thickness)));
    const double crust = freezing.given_off(trial.volume()) + film, right = freezing.front(trial.steps());
    crusts.push_back({1. * trial.steps(), crust});
    measured.points.push_back({1. * trial.steps(), crust - film});
    exact.points.push_back({1. * trial.steps(), right - film});
    const std::string setting = fmt::format("step {}", trial.steps());
    outcome.rows.push_back({.setting = setting,
                            .quantity = "thickness and the film's, cells",
                            .value = crust,
                            .exact = right,
                            .gate = 0.02,
                            .speed = trial.speed()});
    if (thickness == 48) outcome.rows.push_back(solid_row(trial, setting, right - film));
  }
  outcome.rows.push_back(
      {.setting = fmt::format("step {}", trial.steps()),
       .quantity = "exponent of the thickness over time",
       .value = std::log(crusts.back().y / crusts.front().y) / std::log(crusts.back().x / crusts.front().x),
       .exact = 0.5,
       .gate = 0.02,
       .speed = trial.speed()});
  outcome.charts.push_back({.title = "Crust on a pool",
                            .x_label = "step",
                            .y_label = "thickness, cells",
                            .curves = {std::move(exact), std::move(measured)}});
  return outcome;
}

// Lets one cell in the void glow at a sky. It loses with the fourth power: 1 / T^3 grows steadily.
Outcome measure_glow(const Conditions& conditions) {
  constexpr double kGlow = 0.004, kArea = 1.5, kHot = 0.95;  // of three exposed axes
  Trial trial(conditions, "column",
              {"grid.size=[3,3,3]", "heat.gamma=0", fmt::format("heat.air.glow={}", kGlow),
               "material.melting_point=1", "material.latent_heat=0"},
              [](state::Volume& v) { put_solid(v, 1, 1, 1, kHot * kHottest); });
  Outcome outcome;
  Curve measured{.name = "automaton"}, exact{.name = "exact", .exact = true};
  for (const std::uint32_t step : {100u, 400u, 1600u, 6400u}) {
    trial.run_to(step);
    const double value = trial.volume().heat[trial.volume().at(1, 1, 1)] / kHottest;
    const double right = std::pow(std::pow(kHot, -3) + 3 * kGlow * kArea * step, -1. / 3);
    measured.points.push_back({1. * step, value});
    exact.points.push_back({1. * step, right});
    outcome.rows.push_back({.setting = fmt::format("step {}", step),
                            .quantity = "temperature",
                            .value = value,
                            .exact = right,
                            .gate = 0.01,
                            .speed = trial.speed()});
  }
  outcome.charts.push_back({.title = "A cell glows",
                            .x_label = "step",
                            .y_label = "temperature",
                            .curves = {std::move(exact), std::move(measured)},
                            .logarithmic_x = true});
  return outcome;
}

// Lets a dam break in a channel under cold air. It stops by itself.
Outcome measure_cooling_flow(const Conditions& conditions) {
  Outcome outcome;
  for (const CoolingDam& dam :
       {CoolingDam{0.002, 1}, CoolingDam{0.008, 1}, CoolingDam{0.002, 2}, CoolingDam{0.008, 2}}) {
    if (conditions.quick && dam.scale > 1) continue;
    Trial trial = dam.trial(conditions);
    trial.run_to(step_at(12 * dam.depth() / dam.exchange));
    const std::vector<double> rests = depths(trial.volume());
    trial.run_to(trial.steps() + 200);
    const std::vector<double> later = depths(trial.volume());
    const std::vector<double> exact = dam.model();

    const std::string setting = fmt::format("depth {}, exchange {}", dam.depth(), dam.exchange);
    outcome.rows.push_back({.setting = setting,
                            .quantity = "length at rest, cells",
                            .value = length(rests, 1),
                            .exact = length(exact, CoolingDam::kParts),
                            .gate = 0.1,
                            .speed = trial.speed()});
    double moved = 0;
    for (std::size_t i = 0; i < rests.size(); ++i) moved += std::abs(later[i] - rests[i]);
    outcome.rows.push_back({.setting = setting,
                            .quantity = "cells moved in 200 steps",
                            .value = moved,
                            .exact = 0,
                            .measure = Measure::absolute,
                            .gate = 0,
                            .speed = trial.speed()});
    outcome.charts.push_back({.title = "At rest, " + setting,
                              .x_label = "distance from the wall, cells",
                              .y_label = "depth, cells",
                              .curves = {profile("one dimension", exact, CoolingDam::kParts, true),
                                         profile("automaton", rests, 1, false)}});
  }
  return outcome;
}

}  // namespace voxmelt::accuracy
