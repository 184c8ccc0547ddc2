// These cases look at where liquid ends: at fronts of films on dry planes, and at a steep hump on a pool.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/slope.h"
#include "accuracy/spreading.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr int kWidth = 3;  // walls have no effect, as the cases narrow_film and dam_width show

// A film of depth h runs down a dry plane. Its front keeps its shape and goes with the film's mean velocity.
// In lubrication theory its surface falls by slope (h^2 / y^2 - 1) where it is y deep. So it is y deep at a
// distance h / slope (artanh(y / h) - y / h) from the line where the liquid ends.
struct FilmFront {
  static constexpr int kFilm = 80, kWay = 24, kDry = 10;  // cells
  using Sets = std::vector<std::string>;
  double slope, depth, kappa;
  std::string name;
  Sets sets;
  std::optional<double> gate;

  double speed() const { return kappa / 3 * nusselt(slope) * depth * depth; }
  std::uint32_t steps() const { return step_at(kWay / speed()); }
  double line(double step) const { return kFilm + speed() * step; }  // where the liquid ends
  double depth_behind(double distance) const {
    if (distance <= 0) return 0;
    double low = 0, high = 1;
    for (int halving = 0; halving < 50; ++halving) {
      const double part = (low + high) / 2;
      (depth / slope * (std::atanh(part) - part) < distance ? low : high) = part;
    }
    return depth * low;
  }
  // Returns the mean depth of a column.
  double exact(int x, double step) const {
    double sum = 0;
    for (int part = 0; part < 16; ++part) sum += depth_behind(line(step) - x - (part + 0.5) / 16) / 16;
    return sum;
  }

  void measure(const Conditions& conditions, Outcome& outcome) const {
    const int length = kFilm + kWay + kDry;
    Sets all = sets;
    all.push_back(fmt::format("grid.size=[{},{},{}]", length,
                              static_cast<int>(std::ceil(slope * length + depth)) + 3, kWidth));
    all.push_back(fmt::format("flow.viscous.kappa={}", kappa));
    Trial trial(conditions, "flow", all, [&](state::Volume& v) {
      for (int z = 0; z < kWidth; ++z)
        for (int x = 0; x < length; ++x)
          put_column_on_bed(v, x, z, 1 + slope * (length - 0.5 - x), exact(x, 0));
    });
    trial.run_to(steps());
    const Columns columns(trial.volume());
    double squares = 0, end = 0;
    const int first = kFilm + kWay / 2;  // what the film's own end has not come to
    for (int x = first; x < length; ++x) {
      const double at = columns.at(x, kWidth / 2), error = at - exact(x, steps());
      squares += error * error;
      if (at > 0) end = x + 1;
    }
    const std::string setting =
        fmt::format("slope {:g}, depth {:g}, kappa {:g}{}, step {}", slope, depth, kappa, name, steps());
    outcome.rows.push_back({.setting = setting,
                            .quantity = "rms difference of the front's profile over its depth",
                            .value = std::sqrt(squares / (length - first)) / depth,
                            .measure = Measure::absolute,
                            .gate = gate,
                            .speed = trial.speed()});
    outcome.rows.push_back({.setting = setting,
                            .quantity = "way of the line where liquid ends, cells",
                            .value = end - kFilm,
                            .exact = line(steps()) - kFilm,
                            .measure = Measure::absolute,
                            .gate = gate ? std::optional(1.5) : std::nullopt,
                            .speed = trial.speed()});
  }
};

}  // namespace

Outcome measure_film_front(const Conditions& conditions) {
  const FilmFront::Sets relaxed{"flow.viscous.substeps=1", "flow.viscous.stages_max=16"};
  Outcome outcome;
  for (const double slope : {0.1, 0.25, 0.5})
    for (const double depth : {0.8, 1.6, 2.5}) {
      if (conditions.quick && slope * depth < 0.6) continue;
      FilmFront front{slope, depth, 0.05, "", {}, 0.06};
      front.measure(conditions, outcome);
      if (depth < 2) continue;
      front.name = ", one sub-step, relaxed";
      front.sets = relaxed;
      front.gate = 0.08;
      front.measure(conditions, outcome);
      front.kappa = 0.2;  // four times as fast: the kinematic wave goes up to 0.8 cells in a step
      front.gate.reset();
      front.measure(conditions, outcome);
    }
  return outcome;
}

namespace {

// A Gaussian hump stands at the wall of a pool of depth 3. Cells of its upper part give to cells above runs.
struct Hump {
  static constexpr int kLength = 48, kParts = 8;
  static constexpr double kKappa = 0.05, kPool = 3, kTime = 24;
  double high, wide;
  bool relaxed;

  using Parts = std::vector<double>;  // depths, kParts to a cell
  static double column(const Parts& parts, int x) {
    const auto first = parts.begin() + std::ptrdiff_t{x} * kParts;
    return std::accumulate(first, first + kParts, 0.0) / kParts;
  }
  static double moved(const Parts& before, const std::function<double(int x)>& depth) {
    double sum = 0;
    for (int x = 0; x < kLength; ++x) sum += std::abs(depth(x) - column(before, x)) / 2;
    return sum;
  }
  Row measure(const Conditions& conditions) const {
    Parts start;
    for (int i = 0; i < kLength * kParts; ++i) {
      const double x = (i + 0.5) / kParts / wide;
      start.push_back(kPool + high * std::exp(-x * x / 2));
    }
    const Parts after = lubrication_flow(kKappa, start, kTime, kParts);
    Trial trial(conditions, "flow",
                {fmt::format("grid.size=[{},{},{}]", kLength, static_cast<int>(kPool + high) + 3, kWidth),
                 fmt::format("flow.viscous.kappa={}", kKappa),
                 fmt::format("flow.viscous.substeps_max={}", relaxed ? 1 : 1024),
                 fmt::format("flow.viscous.stages_max={}", relaxed ? 16 : 1)},
                [&](state::Volume& v) {
                  for (int z = 0; z < kWidth; ++z)
                    for (int x = 0; x < kLength; ++x) put_column(v, x, z, column(start, x));
                });
    trial.run_to(step_at(kTime));
    const Columns columns(trial.volume());
    return {.setting = fmt::format("{:g} high, {:g} wide, {}", high, wide,
                                   relaxed ? "one sub-step, relaxed" : "as many sub-steps as needed"),
            .quantity = "liquid that lies elsewhere, part of what moves",
            .value = moved(after, [&](int x) { return columns.at(x, kWidth / 2); }) /
                     moved(start, [&](int x) { return column(after, x); }),
            .measure = Measure::absolute,
            .gate = relaxed ? (high > 5 ? 0.08 : 0.015) : 0.01,
            .speed = trial.speed()};
  }
};

}  // namespace

Outcome measure_hump(const Conditions& conditions) {
  Outcome outcome;
  for (const double high : {2., 5., 10.})
    for (const double wide : {3., 6.})
      for (const bool relaxed : {false, true})
        outcome.rows.push_back(Hump{high, wide, relaxed}.measure(conditions));
  return outcome;
}

}  // namespace voxmelt::accuracy
