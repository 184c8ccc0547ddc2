// Pieces that nothing holds fall, sink and float.
#include "accuracy/pieces.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/cells.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr int kSide = 24, kTop = 40, kCube = 8, kCubeAt = 8;  // the cube's place along x and z
constexpr double kPool = 14.3;                                // its depth
constexpr int kHeld = 22;                                     // height of the cube at the start

bool in_cube(int x, int z) {
  return x >= kCubeAt && x < kCubeAt + kCube && z >= kCubeAt && z < kCubeAt + kCube;
}

Trial cube_over_pool(const Conditions& conditions, const std::vector<std::string>& more) {
  std::vector<std::string> sets{fmt::format("grid.size=[{0},{1},{0}]", kSide, kTop), "flow.viscous.kappa=0.1",
                                "pieces.fall=true"};
  sets.insert(sets.end(), more.begin(), more.end());
  return {conditions, "flow", sets, [](state::Volume& v) {
            for (int z = 0; z < kSide; ++z)
              for (int x = 0; x < kSide; ++x) put_column(v, x, z, kPool);
            for_each_cell(v.grid, [&](int x, int y, int z) {
              if (in_cube(x, z) && y >= kHeld && y < kHeld + kCube) put_solid(v, x, y, z);
            });
          }};
}

int bottom_of_cube(const state::Volume& v) {
  int y = 0;
  while (y < kTop && !v.solid.test(kCubeAt, y, kCubeAt)) ++y;
  return y;
}

// Returns the mean height of the liquid beside the cube.
double level(const state::Volume& v) {
  double sum = 0, columns = 0;
  for (int z = 0; z < kSide; ++z)
    for (int x = 0; x < kSide; ++x) {
      if (in_cube(x, z)) continue;
      columns += 1;
      for (int y = 0; y < kTop; ++y) sum += v.amount[v.at(x, y, z)] / kOne;
    }
  return sum / columns;
}

}  // namespace

Outcome measure_pieces(const Conditions& conditions) {
  Outcome outcome;
  const std::uint32_t rest = conditions.quick ? 600 : 1200;
  const auto row = [&](const Trial& trial, const std::string& setting, const std::string& quantity,
                       double value, double exact, double gate) {
    outcome.rows.push_back({.setting = setting,
                            .quantity = quantity,
                            .value = value,
                            .exact = exact,
                            .measure = Measure::absolute,
                            .gate = gate,
                            .speed = trial.speed()});
  };
  {
    Trial trial = cube_over_pool(conditions, {"pieces.in_liquid=3"});
    constexpr int kSurface = 14;  // the highest cell with liquid below the cube
    trial.run_to(kHeld - kSurface - 1);
    row(trial, "in air", "height after 7 steps", bottom_of_cube(trial.volume()), kSurface + 1, 0);
    const std::uint32_t wades = trial.steps();
    trial.run_to(wades + 30);
    row(trial, "in liquid, 3 steps a cell", "cells sunk in 30 steps",
        kSurface + 1 - bottom_of_cube(trial.volume()), 10, 1);
    trial.run_to(rest);
    constexpr double kArea = double{kSide} * kSide, kVolume = double{kCube} * kCube * kCube;
    row(trial, "on the ground", "height of the cube", bottom_of_cube(trial.volume()), 0, 0);
    row(trial, "on the ground", "level of the pool", level(trial.volume()), kPool + kVolume / kArea, 0.05);
  }
  for (const double density : {0.25, 0.5, 0.75}) {
    if (conditions.quick && density != 0.5) continue;
    Trial trial = cube_over_pool(conditions, {fmt::format("pieces.density={}", density)});
    trial.run_to(rest);
    const double sunk = level(trial.volume()) - bottom_of_cube(trial.volume());
    row(trial, fmt::format("density {}", density), "part under the surface", sunk / kCube, density,
        1.0 / kCube);
  }
  return outcome;
}

}  // namespace voxmelt::accuracy
