// These cases hold conduction and melting against the heat kernel, the slab and the Stefan problems.
#include "accuracy/heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

using Strings = std::vector<std::string>;

// Sets a column of `cells` under an isothermal wall. Temperatures are 0..1.
Strings column(int cells, double gamma, double wall, double start) {
  return {fmt::format("grid.size=[1,{},1]", cells + 1),
          fmt::format("heat.gamma={}", gamma),
          fmt::format("inert.0.at=[0.5,{},0.5]", cells + 0.5),
          fmt::format("inert.0.temperature={}", wall),
          fmt::format("solid.0.size=[1,{},1]", cells),
          fmt::format("solid.0.at=[0.5,{},0.5]", cells / 2.0),
          fmt::format("solid.0.temperature={}", start)};
}

// Returns the depth below the centre of the wall, where its temperature is.
double depth_of(const state::Volume& v, int y) { return v.grid.y - 1 - y; }
constexpr double kHalfTheWall = 0.5;

struct Stefan {
  std::string law;
  double number, number_of_solid;
  static constexpr double kGamma = 0.3, kSpan = 0.97, kCold = 0.02;

  double latent() const { return kSpan / (1 + number + number_of_solid); }
  double melting_point() const { return kCold + number_of_solid * latent(); }
  double wall() const { return melting_point() + number * latent(); }
  double lambda() const { return stefan_lambda(number, number_of_solid); }
  double time_of(double front) const { return std::pow(front / (2 * lambda()), 2) / diffusivity(kGamma, 6); }
  Trial trial(const Conditions& conditions, int cells) const {
    Strings sets = column(cells, kGamma, wall(), kCold);
    sets.push_back(fmt::format("material.melting_point={}", melting_point()));
    sets.push_back(fmt::format("material.latent_heat={}", latent()));
    sets.push_back(fmt::format("flow.law=\"{}\"", law));
    if (law == "viscous") sets.emplace_back("flow.viscous.kappa=0.02");
    return {conditions, "column", sets};
  }
  double front(const Trial& trial) const {
    return kHalfTheWall + melted_cells(trial.volume(), melting_point() * kHottest, latent() * kHottest);
  }
};

// Runs until the front should be at `last`, with five samples on the way.
struct Followed {
  Row row;
  Curve error;
  Chart profile;
};
Followed follow(const Conditions& conditions, const Stefan& stefan, int cells, double last) {
  Trial trial = stefan.trial(conditions, cells);
  Followed found;
  found.error.name = fmt::format("St {:g}", stefan.number);
  double front = 0, time = 1;
  for (int sample = 1; sample <= 5; ++sample) {
    trial.run_to(step_at(stefan.time_of(last * sample / 5)));
    time = trial.steps();
    front = stefan.front(trial);
    const double exact = 2 * stefan.lambda() * std::sqrt(diffusivity(Stefan::kGamma, 6) * time);
    found.error.points.push_back({exact, 100 * (front / exact - 1)});
  }
  Row& row = found.row;
  row.setting = fmt::format("{}, St {:g}", stefan.law, stefan.number);
  if (stefan.number_of_solid > 0) row.setting += fmt::format(", solid {:g} below", stefan.number_of_solid);
  row.quantity = "front, cells";
  row.value = front;
  row.exact = 2 * stefan.lambda() * std::sqrt(diffusivity(Stefan::kGamma, 6) * time);
  if (front > cells) row.note = "the whole column has melted";
  row.speed = trial.speed();

  found.profile = {.title = "Temperature below the wall: " + row.setting,
                   .x_label = "depth, cells",
                   .y_label = "temperature (1 wall, 0 melting point)"};
  Curve measured{.name = "automaton"}, exact{.name = "exact", .exact = true};
  const double melting = stefan.melting_point() * kHottest, latent = stefan.latent() * kHottest;
  for (int y = cells - 1; y >= 0; --y) {
    const double depth = depth_of(trial.volume(), y), h = trial.volume().heat[trial.volume().at(0, y, 0)];
    const double t = h <= melting ? h : std::max(melting, h - latent);
    measured.points.push_back({depth, (t - melting) / (stefan.number * latent)});
    exact.points.push_back({depth, stefan_temperature(depth, time, diffusivity(Stefan::kGamma, 6),
                                                      stefan.number, stefan.number_of_solid)});
  }
  found.profile.curves = {std::move(exact), std::move(measured)};
  return found;
}

}  // namespace

// Runs a Gaussian of sigma 6 in a block of 10 final sigmas. The second moment triples.
Outcome measure_heat_kernel(const Conditions& conditions) {
  struct Setting {
    int neighbours;
    double gamma;
  };
  std::vector<Setting> settings{{6, 0.3}, {18, 0.2}, {26, 0.2}};
  if (!conditions.quick) settings.insert(settings.end(), {{6, 0.5}, {6, 0.02}, {26, 0.05}});
  constexpr double kVariance = 36;
  Outcome outcome;
  Chart chart{.title = "Second moment of heat",
              .x_label = "exact growth, cells²",
              .y_label = "error of the growth, %",
              .band = 0.5};
  for (const Setting& s : settings) {
    const int side = 105;
    Trial trial(conditions, "heat",
                {fmt::format("grid.size=[{0},{0},{0}]", side), fmt::format("heat.gamma={}", s.gamma),
                 fmt::format("heat.neighbours={}", s.neighbours)},
                [&](state::Volume& v) {
                  for_each_cell(v.grid, [&](int x, int y, int z) {
                    const double m = (side - 1) / 2.0;
                    const double r2 = (x - m) * (x - m) + (y - m) * (y - m) + (z - m) * (z - m);
                    put_solid(v, x, y, z, 60000 * std::exp(-r2 / (2 * kVariance)));
                  });
                });
    const double start = heat_second_moment(trial.volume()), d = diffusivity(s.gamma, s.neighbours);
    const double last = std::ceil(2 * kVariance / (2 * d));
    Curve curve{.name = fmt::format("{} neighbours, gamma {:g}", s.neighbours, s.gamma)};
    double growth = 0;
    for (int sample = 1; sample <= 5; ++sample) {
      trial.run_to(step_at(last * sample / 5));
      growth = heat_second_moment(trial.volume()) - start;
      curve.points.push_back({6 * d * trial.steps(), 100 * (growth / (6 * d * trial.steps()) - 1)});
    }
    outcome.rows.push_back({.setting = curve.name,
                            .quantity = "growth of the second moment, cells²",
                            .value = growth,
                            .exact = 6 * d * trial.steps(),
                            .gate = 0.005,
                            .speed = trial.speed()});
    chart.curves.push_back(std::move(curve));
  }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

// Runs a slab until half of the heat is in. One face is held at a temperature, and the other is insulated.
Outcome measure_slab(const Conditions& conditions) {
  constexpr int kCells = 64;
  constexpr double kGamma = 0.3, kWall = 0.9, kThick = kCells + kHalfTheWall;
  const double d = diffusivity(kGamma, 6);
  Strings sets = column(kCells, kGamma, kWall, 0);
  sets.emplace_back("material.melting_point=1.0");
  sets.emplace_back("material.latent_heat=0.0");
  Trial trial(conditions, "column", sets);
  Outcome outcome;
  Chart chart{.title = "A slab heated through one face", .x_label = "depth, cells", .y_label = "temperature"};
  Row row{.setting = "64 cells",
          .quantity = "largest difference of temperature, part of the wall's",
          .measure = Measure::absolute,
          .gate = 0.01};
  for (const double fourier : {0.02, 0.1, 0.3, 0.8}) {
    trial.run_to(static_cast<std::uint32_t>(fourier * kThick * kThick / d));
    Curve measured{.name = fmt::format("automaton, step {}", trial.steps())};
    Curve exact{.name = "exact", .exact = true};
    for (int y = kCells - 1; y >= 0; --y) {
      const double depth = depth_of(trial.volume(), y);
      const double t = trial.volume().heat[trial.volume().at(0, y, 0)] / (kWall * kHottest);
      const double wanted = slab_temperature(depth, trial.steps(), d, kThick);
      measured.points.push_back({depth, t});
      exact.points.push_back({depth, wanted});
      if (std::abs(t - wanted) > std::abs(row.value)) row.value = t - wanted;
    }
    chart.curves.push_back(std::move(exact));
    chart.curves.push_back(std::move(measured));
  }
  row.speed = trial.speed();
  outcome.rows.push_back(std::move(row));
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

Outcome measure_stefan(const Conditions& conditions) {
  const std::vector<double> numbers = conditions.quick ? std::vector<double>{0.05, 0.5, 2}
                                                       : std::vector<double>{0.01, 0.05, 0.1, 0.5, 1, 2, 10};
  Outcome outcome;
  const int cells = conditions.quick ? 40 : 64;
  std::vector<Chart> profiles;
  for (const std::string law : {"paper", "viscous"}) {
    Chart errors{.title = "Error of the front, " + law + " law",
                 .x_label = "exact depth of the front, cells",
                 .y_label = "error, %",
                 .band = 1};
    for (const double number : numbers) {
      Followed found = follow(conditions, {law, number, 0}, cells, 0.75 * cells);
      if (number >= 0.05) found.row.gate = 0.01;
      outcome.rows.push_back(std::move(found.row));
      errors.curves.push_back(std::move(found.error));
      if (number == 0.5) profiles.push_back(std::move(found.profile));
    }
    outcome.charts.push_back(std::move(errors));
  }
  for (Chart& profile : profiles) outcome.charts.push_back(std::move(profile));
  return outcome;
}

Outcome measure_stefan_two_phase(const Conditions& conditions) {
  Outcome outcome;
  for (const std::string law : {"paper", "viscous"}) {
    Followed found =
        follow(conditions, {law, 1, 0.5}, conditions.quick ? 192 : 320, conditions.quick ? 32 : 64);
    found.row.gate = 0.01;
    outcome.rows.push_back(std::move(found.row));
    outcome.charts.push_back(std::move(found.profile));
  }
  return outcome;
}

// Hot and cold cells alternate, at the largest gamma that a scene may have.
Outcome measure_checkerboard(const Conditions& conditions) {
  constexpr int kSide = 64;
  constexpr std::uint32_t kSteps = 100;
  Row row{.setting = "gamma 0.5236, 100 steps",
          .quantity = "swing left, part of the first, of a scene that is taken without a word",
          .measure = Measure::absolute,
          .gate = 0.05};
  Chart chart{.title = "A checkerboard of heat", .x_label = "step", .y_label = "swing, part of the first"};
  Curve swing{.name = "gamma 0.5236"};
  try {
    Trial trial(conditions, "heat", {fmt::format("grid.size=[{0},{0},{0}]", kSide), "heat.gamma=0.5236"},
                [](state::Volume& v) {
                  for_each_cell(v.grid, [&](int x, int y, int z) {
                    put_solid(v, x, y, z, (x + y + z) % 2 == 0 ? 60000 : 0);
                  });
                });
    double left = 1;
    for (std::uint32_t step = 0; step <= kSteps; step += 5) {
      trial.run_to(step);
      double sum = 0;
      for_each_cell(trial.volume().grid, [&](int x, int y, int z) {
        const double h = trial.volume().heat[trial.volume().at(x, y, z)];
        sum += (x + y + z) % 2 == 0 ? h : -h;
      });
      left = std::abs(sum) / (30000.0 * kSide * kSide * kSide);
      swing.points.push_back({static_cast<double>(step), left});
    }
    row.value = trial.warnings().empty() ? left : 0;
    row.note = trial.warnings().empty() ? "no warning" : trial.warnings().front();
    row.speed = trial.speed();
  } catch (const scene::InputError& refusal) {
    row.note = std::string("refused: ") + refusal.what();
  }
  chart.curves.push_back(std::move(swing));
  return {{std::move(row)}, {std::move(chart)}};
}

}  // namespace voxmelt::accuracy
