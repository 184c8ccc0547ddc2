// Liquid that fills a closed cavity has nowhere to go, whatever the shape of the ceiling.
#include "accuracy/cavities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "accuracy/cells.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr int kSide = 20;
constexpr std::uint32_t kSteps = 100;

// A place is given from the middle of the grid.
struct Cavity {
  const char* name;
  bool (*holds)(double x, double y, double z);
};

bool in_box(double x, double y, double z) { return std::abs(x) < 7 && std::abs(y) < 5 && std::abs(z) < 7; }

// The box is turned by 25 degrees about z, and then by 15 about x.
bool in_tilted_box(double x, double y, double z) {
  constexpr double kAboutZ = 25 * std::numbers::pi / 180, kAboutX = 15 * std::numbers::pi / 180;
  const double y1 = std::cos(kAboutX) * y + std::sin(kAboutX) * z;
  const double z1 = std::cos(kAboutX) * z - std::sin(kAboutX) * y;
  return in_box(std::cos(kAboutZ) * x + std::sin(kAboutZ) * y1,
                std::cos(kAboutZ) * y1 - std::sin(kAboutZ) * x, z1);
}

constexpr Cavity kCavities[] = {
    {"a box", in_box},
    {"a cylinder that stands",
     [](double x, double y, double z) { return std::hypot(x, z) < 8 && std::abs(y) < 6; }},
    {"a cylinder that lies",
     [](double x, double y, double z) { return std::hypot(x, y) < 8 && std::abs(z) < 6; }},
    {"a ball", [](double x, double y, double z) { return std::hypot(x, y, z) < 8; }},
    {"a tilted box", in_tilted_box},
};

// Every layer is hotter than the one below.
double heat_of_layer(int y) { return 20000 + 1500. * y; }

Trial full(const Conditions& conditions, const Cavity& cavity) {
  return {conditions,
          "flow",
          {fmt::format("grid.size=[{0},{0},{0}]", kSide), "flow.viscous.kappa=0.05", "heat.gamma=1e-9"},
          [&](state::Volume& v) {
            for_each_cell(v.grid, [&](int x, int y, int z) {
              constexpr double kMiddle = (kSide - 1) / 2.0;
              if (!cavity.holds(x - kMiddle, y - kMiddle, z - kMiddle)) return put_inert(v, x, y, z);
              put_liquid(v, x, y, z, 1);
              v.heat[v.at(x, y, z)] = to_units(heat_of_layer(y));
            });
          }};
}

struct Found {
  double least = 1, most = 1;  // amounts of cells
  double heat_elsewhere = 0;   // rms change of a place's heat over the rms spread of all heat
};

Found look(const state::Volume& now, const state::Volume& start) {
  Found found;
  double sum = 0, squares = 0, all = 0, changes = 0;
  for_each_cell(start.grid, [&](int x, int y, int z) {
    const state::Slot cell = start.at(x, y, z);
    if (!start.liquid.test(x, y, z)) return;
    const double amount = now.amount[cell] / kOne, heat = start.heat[cell];
    found.least = std::min(found.least, amount);
    found.most = std::max(found.most, amount);
    all += 1;
    sum += heat;
    squares += heat * heat;
    changes += amount * (now.heat[cell] - heat) * (now.heat[cell] - heat);
  });
  found.heat_elsewhere = std::sqrt(changes / (squares - sum * sum / all));
  return found;
}

}  // namespace

// Where the ceiling is not level, columns of different head stand beside each other, all of them shut.
Outcome measure_cavities(const Conditions& conditions) {
  Outcome outcome;
  for (const Cavity& cavity : kCavities) {
    Trial trial = full(conditions, cavity);
    const state::Volume start = trial.volume();
    trial.run_to(kSteps);
    const Found found = look(trial.volume(), start);
    const auto row = [&](const std::string& quantity, double value, double exact) {
      outcome.rows.push_back({.setting = fmt::format("{}, step {}", cavity.name, kSteps),
                              .quantity = quantity,
                              .value = value,
                              .exact = exact,
                              .measure = Measure::absolute,
                              .gate = 0.02,
                              .speed = trial.speed()});
    };
    row("largest amount of a cell", found.most, 1);
    row("smallest amount of a cell", found.least, 1);
    row("rms change of heat, part of its spread", found.heat_elsewhere, 0);
  }
  return outcome;
}

}  // namespace voxmelt::accuracy
