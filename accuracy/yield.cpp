// Liquid with a yield stress comes to rest as a heap whose shape is known.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/rest.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr int kWidth = 3;  // walls have no effect, as the case dam_width shows

// A block stands at a wall and runs out. It rests where the depth times the fall of its surface is the yield
// stress. Then it is sqrt(2 yield d) deep at a distance d from its end (Liu and Mei 1989, Slow spreading of a
// sheet of Bingham fluid).
struct Heap {
  static constexpr double kKappa = 0.5, kHigh = 4;
  static constexpr int kWide = 5, kDry = 8;  // cells
  static constexpr std::uint32_t kSteps = 12000, kWatched = 200;
  double yield;
  bool relaxed;

  double volume() const { return kHigh * kWide; }
  double length() const { return std::pow(1.5 * volume() / std::sqrt(2 * yield), 2. / 3); }
  // Returns the mean depth of a column.
  double exact(int x) const {
    const auto beyond = [&](double d) { return d > 0 ? std::sqrt(2 * yield) * std::pow(d, 1.5) / 1.5 : 0; };
    return beyond(length() - x) - beyond(length() - x - 1);
  }

  void measure(const Conditions& conditions, Outcome& outcome) const {
    const int cells = static_cast<int>(std::ceil(length())) + kDry;
    Trial trial(conditions, "flow",
                {fmt::format("grid.size=[{},{},{}]", cells, static_cast<int>(kHigh) + 2, kWidth),
                 fmt::format("flow.viscous.kappa={}", kKappa), fmt::format("flow.viscous.yield={}", yield),
                 fmt::format("flow.viscous.substeps_max={}", relaxed ? 1 : 1024),
                 fmt::format("flow.viscous.stages_max={}", relaxed ? 16 : 1)},
                [&](state::Volume& v) {
                  for (int z = 0; z < kWidth; ++z)
                    for (int x = 0; x < kWide; ++x) put_column(v, x, z, kHigh);
                });
    trial.run_to(kSteps);
    const Columns columns(trial.volume());
    const double moved = motion(trial, kWatched);
    double squares = 0, end = 0;
    for (int x = 0; x < cells; ++x) {
      const double depth = columns.at(x, kWidth / 2), error = depth - exact(x);
      squares += error * error / length();
      if (depth > 0) end = x + 1;
    }
    const std::string setting = fmt::format(
        "yield {:g}, {}", yield, relaxed ? "one sub-step, relaxed" : "as many sub-steps as needed");
    outcome.rows.push_back(
        {.setting = setting,
         .quantity = fmt::format("cells moved in steps {} to {}", kSteps, kSteps + kWatched),
         .value = moved,
         .measure = Measure::absolute,
         .gate = 0,
         .speed = trial.speed()});
    outcome.rows.push_back({.setting = setting,
                            .quantity = "rms difference of the profile over the depth at the wall",
                            .value = std::sqrt(squares) / std::sqrt(2 * yield * length()),
                            .measure = Measure::absolute,
                            .gate = relaxed ? 0.1 : 0.05,
                            .speed = trial.speed()});
    outcome.rows.push_back({.setting = setting,
                            .quantity = "length, cells",
                            .value = end,
                            .exact = length(),
                            .measure = Measure::absolute,
                            .gate = relaxed ? 2 : 1.5,
                            .speed = trial.speed()});
  }
};

}  // namespace

Outcome measure_yield_heap(const Conditions& conditions) {
  Outcome outcome;
  for (const double yield : {0.02, 0.05, 0.1, 0.2})
    for (const bool relaxed : {false, true}) Heap{yield, relaxed}.measure(conditions, outcome);
  return outcome;
}

}  // namespace voxmelt::accuracy
