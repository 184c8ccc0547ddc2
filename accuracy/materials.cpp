// Bodies of several materials conduct and melt as each of them does.
#include "accuracy/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/trial.h"
#include "accuracy/two_layers.h"

namespace voxmelt::accuracy {
namespace {

// The plain baseline knows no materials.
Conditions without_baseline(Conditions conditions) {
  conditions.baseline = false;
  return conditions;
}

constexpr int kCells = 64;
constexpr double kWall = 0.45;  // with a capacity of 2, heat has no room for more

// Is a column under an isothermal wall. The half of it that is near the wall is of one material, the other
// half of another. One of them is the scene's first.
struct Layers {
  double gamma, conductivity, capacity;  // the last two are those of the other material
  bool first_is_near;
  double melting_point = 1;  // of the far material
  static constexpr int kNear = kCells / 2;
  static constexpr double kNever = 1, kToTheWall = 1;  // cells from the wall's centre to the first one

  std::string name() const {
    return fmt::format("conductivity {:g}, capacity {:g}, {}", conductivity, capacity,
                       first_is_near ? "behind" : "in front");
  }
  TwoLayers exact() const {
    const double d = diffusivity(gamma, 6), other = d * conductivity;
    TwoLayers layers{{kNear + kToTheWall / 2, kCells - kNear}, {d, other}, {1, capacity}};
    if (!first_is_near) {
      std::swap(layers.conductivity[0], layers.conductivity[1]);
      std::swap(layers.capacity[0], layers.capacity[1]);
    }
    return layers;
  }
  Trial trial(const Conditions& conditions) const {
    const double first = first_is_near ? kNever : melting_point,
                 other = first_is_near ? melting_point : kNever;
    // A material that never melts must not need more heat than there is.
    const double fits = std::min(other, 1 / capacity);
    return {
        without_baseline(conditions),
        "column",
        {fmt::format("grid.size=[1,{},1]", kCells + 1), fmt::format("heat.gamma={}", gamma),
         fmt::format("inert.0.at=[0.5,{},0.5]", kCells + 0.5), fmt::format("inert.0.temperature={}", kWall),
         fmt::format("material.melting_point={}", first), "material.latent_heat=0.0",
         fmt::format("materials=[{{name=\"other\", melting_point={}, conductivity={}, capacity={}}}]", fits,
                     conductivity, capacity)},
        [this](state::Volume& v) {
          for (int y = 0; y < kCells; ++y) {
            put_solid(v, 0, y, 0, 0);
            const bool near = y >= kCells - kNear;
            v.material[v.at(0, y, 0)] = near == first_is_near ? 0 : 1;
          }
          put_inert(v, 0, kCells, 0);
          v.heat[v.at(0, kCells, 0)] = to_units(kWall * kHottest);
        }};
  }
  // Returns the temperature of a cell, over the wall's.
  double temperature(const state::Volume& v, int y) const {
    const state::Slot cell = v.at(0, y, 0);
    return v.heat[cell] / (v.material[cell] == 1 ? capacity : 1) / (kWall * kHottest);
  }
};

double depth_of(int y) { return kCells - y; }  // below the centre of the wall

Row temperature_row(const Conditions& conditions, const Layers& layers, Chart& chart) {
  Trial trial = layers.trial(conditions);
  const TwoLayers exact = layers.exact();
  Row row{.setting = layers.name(),
          .quantity = "largest difference of temperature, part of the wall's",
          .measure = Measure::absolute,
          .gate = 0.01};
  for (const double part : {0.1, 0.3, 0.6}) {
    const double time = exact.time_of(depth_of(0), part);
    trial.run_to(step_at(time));
    Curve measured{.name = fmt::format("automaton, step {}", trial.steps())},
        wanted{.name = "exact", .exact = true};
    for (int y = kCells - 1; y >= 0; --y) {
      const double t = layers.temperature(trial.volume(), y);
      const double right = exact.temperature(depth_of(y), trial.steps());
      measured.points.push_back({depth_of(y), t});
      wanted.points.push_back({depth_of(y), right});
      if (std::abs(t - right) > std::abs(row.value)) row.value = t - right;
    }
    chart.curves.push_back(std::move(wanted));
    chart.curves.push_back(std::move(measured));
  }
  row.speed = trial.speed();
  return row;
}

// The far material melts at half the wall's temperature, without latent heat. The first cell that does is the
// one at the border.
Row melting_row(const Conditions& conditions, Layers layers) {
  layers.melting_point = kWall / 2;
  Trial trial = layers.trial(conditions);
  const double time = layers.exact().time_of(depth_of(kCells - Layers::kNear - 1), 0.5);
  while (trial.volume().liquid.count() == 0 && trial.steps() < 2 * time) trial.run_to(trial.steps() + 1);
  return {.setting = layers.name(),
          .quantity = "step at which the second layer begins to melt",
          .value = static_cast<double>(trial.steps()),
          .exact = time,
          .gate = 0.01,
          .speed = trial.speed()};
}

struct Numbers {
  double melting_point, latent_heat, capacity;
};
constexpr std::array<Numbers, 3> kBody{{{0.4, 0.2, 1}, {0.3, 0.1, 1.5}, {0.6, 0.05, 1.2}}};
constexpr double kStart = 6000, kRadius = 6.2;
constexpr int kSide = 16;

// Returns the heat at which a material is liquid, and that of the first material then, as the scene's numbers
// are rounded.
double liquid_from(const Numbers& n) {
  return std::ceil(65536 * std::round(n.melting_point * kHottest) / std::floor(65536 / n.capacity)) +
         std::round(n.latent_heat * kHottest);
}
double as_first(const Numbers& n) {
  if (&n == kBody.data()) return liquid_from(n);
  const bool higher = n.melting_point > kBody[0].melting_point;
  return std::round(n.melting_point * kHottest) + (higher ? std::round(kBody[0].latent_heat * kHottest) : 0);
}

}  // namespace

Outcome measure_two_layers(const Conditions& conditions) {
  std::vector<Layers> all{{0.1, 4, 1.5, true}, {0.1, 4, 1.5, false}, {0.4, 0.25, 1, true}};
  if (!conditions.quick)
    all.insert(all.end(), {{0.4, 0.25, 1, false}, {0.02, 25, 2, true}, {0.3, 0.1, 2, false}});
  Outcome outcome;
  for (const Layers& layers : all) {
    Chart chart{.title = "Two layers: " + layers.name(), .x_label = "depth, cells", .y_label = "temperature"};
    outcome.rows.push_back(temperature_row(conditions, layers, chart));
    if (layers.first_is_near) outcome.rows.push_back(melting_row(conditions, layers));
    outcome.charts.push_back(std::move(chart));
  }
  return outcome;
}

// A ball of three materials, a third of its height each, melts in an oven. A drain takes at once what melts.
Outcome measure_body_of_materials(const Conditions& conditions) {
  std::array<double, 3> cells{};
  Trial trial(without_baseline(conditions), "oven",
              {"heat.gamma=0.1",
               "materials=[{name=\"soft\", melting_point=0.3, latent_heat=0.1, capacity=1.5, conductivity=2},"
               "{name=\"hard\", melting_point=0.6, latent_heat=0.05, capacity=1.2, conductivity=0.5}]"},
              [&](state::Volume& v) {
                for_each_cell(v.grid, [&](int x, int y, int z) {
                  const double m = (kSide - 1) / 2.0;
                  if (std::hypot(x - m, y - m, z - m) > kRadius) return;
                  const std::size_t material = y < 6 ? 0 : y < 10 ? 1 : 2;
                  put_solid(v, x, y, z, kStart);
                  v.material[v.at(x, y, z)] = static_cast<std::uint8_t>(material);
                  ++cells[material];
                });
              });
  while (trial.volume().solid.count() > 0 && trial.steps() < 20000) trial.run_to(trial.steps() + 1);
  trial.run_to(trial.steps() + 2);  // the last is drained
  double needed = 0, renamed = 0;
  for (std::size_t m = 0; m < kBody.size(); ++m) {
    needed += kOne * cells[m] * (liquid_from(kBody[m]) - kStart);
    renamed += kOne * cells[m] * (as_first(kBody[m]) - liquid_from(kBody[m]));
  }
  const state::HeatLedger& heat = trial.simulation().ledger().heat;
  const auto number = [](state::Sum sum) { return static_cast<double>(sum); };
  // Cells were drained with what they had taken up beyond their melting points, in the step of melting.
  const double beyond =
      number(heat.removed) - (needed + renamed + kOne * kStart * (cells[0] + cells[1] + cells[2]));
  Outcome outcome;
  const auto row = [&](const char* quantity, double value, double exact) {
    outcome.rows.push_back({.setting = "a ball of three materials, in thirds",
                            .quantity = quantity,
                            .value = value,
                            .exact = exact,
                            .measure = Measure::absolute,
                            .gate = 0,
                            .speed = trial.speed()});
  };
  row("cells that did not melt", static_cast<double>(trial.volume().solid.count()), 0);
  row("heat between the materials at their melting points, units", number(heat.melted), renamed);
  row("heat to melt the body, units",
      number(heat.warmed) - number(heat.cooled) + number(heat.conducted) + number(heat.rounded) - beyond,
      needed);
  return outcome;
}

}  // namespace voxmelt::accuracy
