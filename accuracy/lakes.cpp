// Runs deep lakes, whose liquid wants many sub-steps though it hardly moves.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/spreading.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr double kKappa = 0.01, kDepth = 20, kHeight = 1;
constexpr int kLength = 64, kWidth = 3;

double wave_at(int x) { return std::cos(std::numbers::pi * (x + 0.5) / kLength); }

// Returns the height of the wave, its part in the depth of all columns.
double height_of_wave(const state::Volume& volume) {
  const Columns columns(volume);
  double sum = 0;
  for (int z = 0; z < kWidth; ++z)
    for (int x = 0; x < kLength; ++x)
      sum +=
          columns.depth[static_cast<std::size_t>(z) * columns.nx + static_cast<std::size_t>(x)] * wave_at(x);
  return 2 * sum / (kLength * kWidth);
}

}  // namespace

// Lets a wave of half a length on a lake level out. In lubrication theory its height goes as exp(-rate t),
// with rate = (kappa / 3) depth^3 (pi / length)^2. Heads that differ by 1/512 cell rest, which holds the wave
// back in the end.
Outcome measure_deep_lake(const Conditions& conditions) {
  struct Way {
    std::string name;
    int substeps_max, stages_max;
    bool gated;
  };
  const double wave_number = std::numbers::pi / kLength;
  const double rate = kKappa / 3 * std::pow(kDepth, 3) * wave_number * wave_number;
  Outcome outcome;
  for (const Way& way : {Way{"as many sub-steps as needed", 1024, 1, true},
                         Way{"4 sub-steps, relaxed", 4, 16, true}, Way{"1 sub-step, relaxed", 1, 16, true},
                         Way{"8 sub-steps", 8, 1, false}, Way{"1 sub-step", 1, 1, false}}) {
    Trial trial(conditions, "flow",
                {fmt::format("grid.size=[{},{},{}]", kLength, static_cast<int>(kDepth) + 4, kWidth),
                 fmt::format("flow.viscous.kappa={}", kKappa),
                 fmt::format("flow.viscous.substeps_max={}", way.substeps_max),
                 fmt::format("flow.viscous.stages_max={}", way.stages_max)},
                [&](state::Volume& v) {
                  for (int z = 0; z < kWidth; ++z)
                    for (int x = 0; x < kLength; ++x) put_column(v, x, z, kDepth + kHeight * wave_at(x));
                });
    const double first = height_of_wave(trial.volume());
    for (const std::uint32_t step : {8u, 24u}) {
      trial.run_to(step);
      Row row{.setting = fmt::format("{}, step {}", way.name, step),
              .quantity = "height of the wave, part of the first",
              .value = height_of_wave(trial.volume()) / first,
              .exact = std::exp(-rate * step),
              .measure = Measure::absolute,
              .speed = trial.speed()};
      if (way.gated) row.gate = step == 8 ? 0.02 : 0.04;
      outcome.rows.push_back(std::move(row));
    }
  }
  return outcome;
}

namespace {

// A deep part of a lake stands beside a shallow one, and floods it. Its cells at the cliff give to cells that
// stand on the shallow runs.
struct Flood {
  static constexpr int kLong = 64, kAway = 24;  // cells; how many are deep
  static constexpr double kFlowing = 0.02;      // kappa
  double deep, shallow;

  Columns after(const Conditions& conditions, std::uint32_t steps, int substeps_max, Speed& speed) const {
    Trial trial(conditions, "flow",
                {fmt::format("grid.size=[{},{},{}]", kLong, static_cast<int>(deep) + 3, kWidth),
                 fmt::format("flow.viscous.kappa={}", kFlowing),
                 fmt::format("flow.viscous.substeps_max={}", substeps_max),
                 fmt::format("flow.viscous.stages_max={}", substeps_max > 16 ? 1 : 16)},
                [&](state::Volume& v) {
                  for (int z = 0; z < kWidth; ++z)
                    for (int x = 0; x < kLong; ++x) put_column(v, x, z, x < kAway ? deep : shallow);
                });
    trial.run_to(steps);
    speed = trial.speed();
    return Columns(trial.volume());
  }

  void measure(const Conditions& conditions, Outcome& outcome) const {
    for (const std::uint32_t steps : {10u, 40u}) {
      Speed speed;
      const Columns exact = after(conditions, steps, 1024, speed);
      for (const int substeps : {1, 4}) {
        const Columns relaxed = after(conditions, steps, substeps, speed);
        double elsewhere = 0, moved = 0;
        for (int x = 0; x < kLong; ++x) {
          const double depth = exact.at(x, kWidth / 2);
          elsewhere += std::abs(relaxed.at(x, kWidth / 2) - depth) / 2;
          moved += std::abs(depth - (x < kAway ? deep : shallow)) / 2;
        }
        outcome.rows.push_back(
            {.setting = fmt::format("{:g} beside {:g} deep, at most {} sub-steps, step {}", deep, shallow,
                                    substeps, steps),
             .quantity = "liquid that lies elsewhere than with all sub-steps, part of what moved",
             .value = elsewhere / moved,
             .measure = Measure::absolute,
             .gate = deep > 12 || substeps == 1 ? std::nullopt : std::optional(steps == 10 ? 0.08 : 0.03),
             .speed = speed});
      }
    }
  }
};

}  // namespace

Outcome measure_flood(const Conditions& conditions) {
  Outcome outcome;
  for (const double deep : {12., 24.})
    for (const double shallow : {0., 1.5, 6.}) Flood{deep, shallow}.measure(conditions, outcome);
  return outcome;
}

}  // namespace voxmelt::accuracy
