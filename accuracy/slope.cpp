// These cases hold films and blobs that run down a plane against Nusselt's film.
#include "accuracy/slope.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

enum class Bed { smooth, stairs };

// Puts a column of inert cells with its surface at `height`, and `depth` of liquid on it.
void put_bed(state::Volume& v, int x, int z, double height, double depth, Bed bed) {
  if (bed == Bed::smooth) return put_column_on_bed(v, x, z, height, depth);
  const int top = static_cast<int>(std::lround(height));
  for (int y = 0; y < top; ++y) put_inert(v, x, y, z);
  put_column(v, x, z, depth, top);
}

// A uniform film lies on a plane that falls along x. After `lead` steps its flux through 20 columns in the
// middle is counted. It is compared with Nusselt's at the depth that the film has there meanwhile.
struct Film {
  double slope, depth;
  Bed bed = Bed::smooth;
  int length = 96, width = 33;
  std::uint32_t lead = 64, counted = 256;
  double kappa = 0.1;
  std::vector<std::string> sets{};  // beside the grid and kappa
  double heat = 0;                  // of the liquid, 0..65535

  int first() const { return length / 2 - 10; }
  int last() const { return length / 2 + 10; }
  double volume_after(const Columns& c, int x) const {
    double sum = 0;
    for (; x < c.nx; ++x) sum += c.at(x, width / 2);
    return sum;
  }
  double mean_depth(const Columns& c) const {
    return (volume_after(c, first()) - volume_after(c, last())) / (last() - first());
  }
  Row measure(const Conditions& conditions) const {
    const int high = static_cast<int>(std::ceil(slope * length)) + 1;
    std::vector<std::string> all = sets;
    all.push_back(fmt::format("grid.size=[{},{},{}]", length, high + 4, width));
    all.push_back(fmt::format("flow.viscous.kappa={}", kappa));
    Trial trial(conditions, "flow", all, [&](state::Volume& v) {
      for (int z = 0; z < width; ++z)
        for (int x = 0; x < length; ++x) put_bed(v, x, z, 1 + slope * (length - 0.5 - x), depth, bed);
      if (heat == 0) return;
      for_each_cell(v.grid, [&](int x, int y, int z) {
        if (v.liquid.test(x, y, z)) v.heat[v.at(x, y, z)] = to_units(heat);
      });
    });
    trial.run_to(lead);
    const Columns before(trial.volume());
    trial.run_to(lead + counted);
    const Columns after(trial.volume());
    double flux = 0;
    for (int x = first(); x < last(); ++x) flux += volume_after(after, x) - volume_after(before, x);
    flux /= (last() - first()) * static_cast<double>(counted);
    const double h = (mean_depth(before) + mean_depth(after)) / 2;
    return {.setting = fmt::format("slope {:g}, depth {:g}, along the grid", slope, depth),
            .quantity = fmt::format("flux over Nusselt's, at depth {:.3f}", h),
            .value = flux / (kappa / 3 * nusselt(slope) * h * h * h),
            .exact = 1,
            .speed = trial.speed()};
  }
};

// A film lies on a plane of solid cells. The uppermost of each column is partly full, or full and partly
// melted, or warmed where there is no latent heat. Where it melts, a sun that
// stands above takes a cell from each column in kSteps steps. The flux through the columns of the middle is
// compared with Nusselt's at the mean depth of each moment.
struct MeltingFilm {
  static constexpr int kLength = 96, kWidth = 9, kMiddle = 20;
  static constexpr std::uint32_t kSteps = 2000;
  static constexpr std::array kNames{"cold", "half melted", "half warmed", "a cell melts in 2,000 steps"};
  double slope, depth;
  enum class Solid { cold, half_melted, half_warmed, melts } solid;
  bool melts() const { return solid == Solid::melts; }
  double latent_heat() const { return solid == Solid::half_warmed ? 0 : 0.3; }

  // Returns the heat of a solid cell of which `part` has not melted yet.
  double heat_of(double part) const {
    if (solid == Solid::half_melted) return (0.5 + 0.3 * (1 - part)) * kHottest;
    return 0.5 * kHottest - (solid == Solid::half_warmed ? part * kOne : 0);
  }

  void fill(state::Volume& v) const {
    for (int z = 0; z < kWidth; ++z)
      for (int x = 0; x < kLength; ++x) {
        const double height = 2 + slope * (kLength - 0.5 - x);
        int y = 0;
        for (; y + 0.25 <= height; ++y) {  // as a shape leaves them
          const double part = std::min(1.0, height - y);
          put_solid(v, x, y, z, heat_of(part));
          if (solid == Solid::cold || melts()) v.amount[v.at(x, y, z)] = to_units(kOne * part);
        }
        put_column(v, x, z, depth, y);
      }
    for_each_cell(v.grid, [&](int x, int y, int z) {
      if (v.liquid.test(x, y, z)) v.heat[v.at(x, y, z)] = to_units(0.8 * kHottest);
    });
  }

  // Returns liquid and solid of a column of the middle row. Solids hold what has not flown yet.
  static double held(const state::Volume& v, int x, bool liquid_alone) {
    double sum = 0;
    for (int y = 0; y < v.grid.y; ++y)
      if (v.liquid.test(x, y, kWidth / 2) || (!liquid_alone && v.solid.test(x, y, kWidth / 2)))
        sum += v.amount[v.at(x, y, kWidth / 2)] / kOne;
    return sum;
  }

  Row measure(const Conditions& conditions) const {
    const double kappa = melts() ? 0.02 : 0.1;
    const int high = static_cast<int>(std::ceil(slope * kLength)) + 8;
    Trial trial(conditions, "film",
                {fmt::format("grid.size=[{},{},{}]", kLength, high, kWidth),
                 fmt::format("flow.viscous.kappa={}", kappa), "flow.viscous.substeps=1",
                 fmt::format("material.latent_heat={}", latent_heat()),
                 fmt::format("heat_source.0.power={}", melts() ? 0.3 / kSteps : 0)},
                [&](state::Volume& v) { fill(v); });
    const std::uint32_t lead = melts() ? kSteps / 2 : 64, counted = melts() ? kSteps : 256, sample = 16;
    trial.run_to(lead);
    const int first = (kLength - kMiddle) / 2;
    const auto beyond = [&] {  // summed over the faces of the middle
      double sum = 0;
      for (int x = first; x < kLength; ++x)
        sum += std::min(x - first + 1, kMiddle) * held(trial.volume(), x, false);
      return sum;
    };
    const double before = beyond();
    double exact = 0, depths = 0;
    for (std::uint32_t step = 0; step < counted; step += sample) {
      double mean = 0;
      for (int x = first; x < first + kMiddle; ++x) mean += held(trial.volume(), x, true) / kMiddle;
      depths += mean * sample / counted;
      exact += sample * kappa / 3 * nusselt(slope) * mean * mean * mean;
      trial.run_to(lead + step + sample);
    }
    return {.setting = fmt::format("slope {:g}, depth {:g} at first, {}", slope, depth,
                                   kNames[static_cast<int>(solid)]),
            .quantity = fmt::format("flux over Nusselt's, at depth {:.3f}", depths),
            .value = (beyond() - before) / kMiddle / exact,
            .exact = 1,
            .speed = trial.speed()};
  }
};

// Walls have no effect on a film, as the case narrow_film shows. So it may be narrow where time is short.
Film film_of(const Conditions& conditions, double slope, double depth) {
  Film film{slope, depth};
  if (conditions.quick) film.width = 9;
  return film;
}

}  // namespace

Outcome measure_melting_film(const Conditions& conditions) {
  Outcome outcome;
  using Solid = MeltingFilm::Solid;
  for (const Solid solid : {Solid::cold, Solid::half_melted, Solid::half_warmed, Solid::melts})
    for (const double slope : {0.1, 0.25, 0.5, 1.0})
      for (const double depth : {0.5, 1.5}) {
        const bool melts = solid == Solid::melts;
        if (conditions.quick && (melts || slope != 0.25)) continue;
        Row row = MeltingFilm{slope, depth, solid}.measure(conditions);
        // A cell that melts is thicker than the thinnest film on the gentlest slope. Its drops are reported.
        if (!(melts && slope == 0.1 && depth == 0.5)) row.gate = 0.05;
        outcome.rows.push_back(std::move(row));
      }
  return outcome;
}

Outcome measure_nusselt(const Conditions& conditions) {
  Outcome outcome;
  Chart chart{.title = "Flux of a film over Nusselt's", .x_label = "slope", .y_label = "flux over exact"};
  Curve one{.name = "exact", .points = {{0, 1}, {0.55, 1}}, .exact = true};
  chart.curves.push_back(std::move(one));
  for (const double depth : {0.8, 1.6}) {
    Curve curve{.name = fmt::format("depth {:g}", depth)};
    for (const double slope : {0.1, 0.25, 0.5}) {
      Row row = film_of(conditions, slope, depth).measure(conditions);
      row.gate = 0.05;
      curve.points.push_back({slope, row.value});
      outcome.rows.push_back(std::move(row));
    }
    chart.curves.push_back(std::move(curve));
  }
  Row deep = film_of(conditions, 0.1, 2).measure(conditions);
  deep.gate = 0.05;
  outcome.rows.push_back(std::move(deep));
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

Outcome measure_narrow_film(const Conditions& conditions) {
  Outcome outcome;
  for (const int width : {1, 2, 3, 5, 9})
    for (const double slope : {0.1, 0.5}) {
      Film film{slope, 1.6};
      film.width = width;
      Row row = film.measure(conditions);
      row.setting = fmt::format("slope {:g}, {} cells wide", slope, width);
      row.gate = 0.02;
      outcome.rows.push_back(std::move(row));
    }
  return outcome;
}

// The film has one kappa at its temperature. So it carries what the film without a thermal law carries.
Outcome measure_thermal_film(const Conditions& conditions) {
  Outcome outcome;
  const double cold = film_of(conditions, 0.25, 1.6).measure(conditions).value;
  for (const double doubling : {0.5, 0.12, 0.02, 0.005})
    for (const double octaves : {-3.3, -0.7, 0.0, 0.5, 2.2}) {
      const double temperature = 0.5 + octaves * doubling;
      if (temperature < 0 || temperature > 1) continue;
      Film film = film_of(conditions, 0.25, 1.6);
      film.heat = std::round(temperature * kHottest);
      const double wanted = std::exp2((film.heat / kHottest - 0.5) / doubling);
      film.kappa /= wanted;
      film.sets = {"heat.gamma=1e-9", "flow.thermal.reference=0.5",
                   fmt::format("flow.thermal.doubling={}", doubling)};
      Row row = film.measure(conditions);
      row.setting =
          fmt::format("doubling {:g}, mobility {:.3f} times that at the reference", doubling, wanted);
      row.quantity = "flux over that without a thermal law";
      row.value /= wanted * cold;  // the row's kappa was smaller by as much
      row.gate = 0.01;
      outcome.rows.push_back(std::move(row));
    }
  return outcome;
}

Outcome measure_stairs(const Conditions& conditions) {
  Outcome outcome;
  const std::vector<double> depths =
      conditions.quick ? std::vector<double>{0.5} : std::vector<double>{0.5, 1, 1.6};
  for (const double depth : depths) {
    // It runs until the liquid has found its depth on each step, and ends before the end of the film comes.
    Film film{.slope = 0.1, .depth = depth, .bed = Bed::stairs, .length = 180, .width = 9};
    film.lead = static_cast<std::uint32_t>(5000 / (depth * depth));
    film.counted = film.lead / 4;
    Row row = film.measure(conditions);
    row.setting = fmt::format("slope 0.1, depth {:g}, steps of whole cells", depth);
    outcome.rows.push_back(std::move(row));
  }
  return outcome;
}

namespace {

constexpr double kBlobKappa = 0.1;

// Puts a paraboloid in the middle of a plane that falls by so much per cell along x and z.
Trial blob_on_plane(const Conditions& conditions, double fall_x, double fall_z) {
  constexpr int kHalf = 32;
  constexpr double kDepth = 1.6, kRadius = 12;
  const int high = static_cast<int>(std::ceil(kHalf * (fall_x + fall_z) * 2)) + 1;
  return Trial(conditions, "flow",
               {fmt::format("grid.size=[{0},{1},{0}]", 2 * kHalf + 1, high + 5),
                fmt::format("flow.viscous.kappa={}", kBlobKappa)},
               [&](state::Volume& v) {
                 for (int z = 0; z <= 2 * kHalf; ++z)
                   for (int x = 0; x <= 2 * kHalf; ++x) {
                     const double r2 = (x - kHalf) * (x - kHalf) + (z - kHalf) * (z - kHalf);
                     put_column_on_bed(v, x, z, 1 + fall_x * (2 * kHalf - x) + fall_z * (2 * kHalf - z),
                                       kDepth * (1 - r2 / (kRadius * kRadius)));
                   }
               });
}

}  // namespace

// The centre of mass of any shape of liquid moves by kappa / 3 x nusselt(slope) x sum h^3 / sum h per step.
Outcome measure_blob(const Conditions& conditions) {
  constexpr std::uint32_t kSample = 16;
  Outcome outcome;
  Chart chart{.title = "Error of the way of a blob down a plane",
              .x_label = "exact way, cells",
              .y_label = "error, %",
              .band = 5};
  for (const double slope : {0.1, 0.25, 0.5, 0.75, 1.0})
    for (const double angle : {0., 22.5, 45.}) {
      const double a = angle * std::numbers::pi / 180;
      Trial trial = blob_on_plane(conditions, slope * std::cos(a), slope * std::sin(a));
      const auto rate = [&](const Columns& c) {
        double sum = 0, cubes = 0;
        for (const double h : c.depth) {
          sum += h;
          cubes += h * h * h;
        }
        return kBlobKappa / 3 * nusselt(slope) * cubes / sum;
      };
      Columns columns(trial.volume());
      const Moments start = moments(columns);
      double expected = 0, before = rate(columns), along = 0, aside = 0;
      Curve curve{.name = fmt::format("slope {:g}, {:g} degrees", slope, angle)};
      for (std::uint32_t step = kSample; step <= 16 * kSample; step += kSample) {
        trial.run_to(step);
        columns = Columns(trial.volume());
        const double now = rate(columns);
        expected += kSample * (before + now) / 2;
        before = now;
        const Moments m = moments(columns);
        along = (m.x - start.x) * std::cos(a) + (m.z - start.z) * std::sin(a);
        aside = (m.z - start.z) * std::cos(a) - (m.x - start.x) * std::sin(a);
        curve.points.push_back({expected, 100 * (along / expected - 1)});
      }
      const std::string setting = fmt::format("slope {:g}, {:g} degrees to the grid", slope, angle);
      outcome.rows.push_back({.setting = setting,
                              .quantity = "way of the centre over exact",
                              .value = along / expected,
                              .exact = 1,
                              .gate = slope < 1 ? 0.05 : 0.08,
                              .speed = trial.speed()});
      outcome.rows.push_back({.setting = setting,
                              .quantity = "way aside over the exact way along",
                              .value = aside / expected,
                              .measure = Measure::absolute,
                              .gate = slope < 1 ? 0.025 : 0.04,
                              .speed = trial.speed()});
      if (slope != 0.25 || angle == 0) chart.curves.push_back(std::move(curve));
    }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

}  // namespace voxmelt::accuracy
