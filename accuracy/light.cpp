// These cases hold radiation against Lambert's cosine, the cross-section of a ball, and the edge of a shadow.
#include "accuracy/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/silhouette.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

using Direction = std::array<double, 3>;

constexpr std::uint32_t kSteps = 16;  // a whole period of the lowest bits, in 1/16 unit
constexpr double kStrength = 1000;    // units of heat per step for a face that is turned to the source

Direction unit(Direction d) {
  const double length = std::hypot(d[0], d[1], d[2]);
  return {d[0] / length, d[1] / length, d[2] / length};
}
// Gives the unit vector at `angle` from the vertical and `azimuth` from x, in degrees.
Direction from_angles(double angle, double azimuth) {
  const double a = angle * std::numbers::pi / 180, b = azimuth * std::numbers::pi / 180;
  return {std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)};
}

struct Source {
  Direction at;
  double power;  // scene units: temperature range x cells^2 per step
};
Source far_source(Direction centre, Direction towards, double distance) {
  const Direction d = unit(towards);
  // Places are rounded to a sixteenth of a cell, as the automaton does, so that the exact answer is for the
  // same place.
  const auto place = [&](std::size_t a) { return std::round(16 * (centre[a] + distance * d[a])) / 16; };
  return {{place(0), place(1), place(2)}, std::round(kStrength / kHottest * distance * distance)};
}

Trial light(const Conditions& conditions, int nx, int ny, int nz, const Source& source,
            const Trial::Fill& fill, int rays_per_face = 1) {
  Trial trial(conditions, "light",
              {fmt::format("grid.size=[{},{},{}]", nx, ny, nz),
               fmt::format("heat_source.0.at=[{},{},{}]", source.at[0], source.at[1], source.at[2]),
               fmt::format("heat_source.0.power={}", source.power),
               fmt::format("heat.rays_per_face={}", rays_per_face)},
              fill);
  trial.run_to(kSteps);
  return trial;
}

// Returns the heat per step that the columns of a rectangle take up, in the scene's range x cells.
double taken_up(const state::Volume& v, int x0, int x1, int z0, int z1) {
  double sum = 0;
  for_each_cell(v.grid, [&](int x, int y, int z) {
    if (x >= x0 && x < x1 && z >= z0 && z < z1) sum += v.heat[v.at(x, y, z)];
  });
  return sum / (kHottest * kSteps);
}

// Gives the power that reaches the upper face of a cell, at the height y: power x cosine / distance^2 at its
// middle.
double on_floor(const Source& source, int x, int y, int z) {
  const double dx = source.at[0] - x - 0.5, dy = source.at[1] - y, dz = source.at[2] - z - 0.5;
  return source.power * dy / std::pow(dx * dx + dy * dy + dz * dz, 1.5);
}

std::string rays_text(int rays) { return fmt::format("{} ray{} per face", rays, rays == 1 ? "" : "s"); }

constexpr int kBallSide = 48;
constexpr double kBallRadius = 20, kBallDistance = 50 * kBallRadius;
constexpr Direction kBallMiddle{kBallSide / 2.0, kBallSide / 2.0, kBallSide / 2.0};

void put_ball(state::Volume& v) {
  for_each_cell(v.grid, [&](int x, int y, int z) {
    if (std::hypot(x + 0.5 - kBallMiddle[0], y + 0.5 - kBallMiddle[1], z + 0.5 - kBallMiddle[2]) <=
        kBallRadius)
      put_solid(v, x, y, z);
  });
}
state::Volume cells_of_ball() {
  state::Volume v(state::Grid{kBallSide, kBallSide, kBallSide});
  put_ball(v);
  return v;
}

struct LitBall {
  double energy;  // per step, over the power of the source
  Speed speed;

  LitBall(const Conditions& conditions, const Source& source, int rays_per_face) {
    const Trial trial = light(conditions, kBallSide, kBallSide, kBallSide, source, put_ball, rays_per_face);
    energy = taken_up(trial.volume(), 0, kBallSide, 0, kBallSide) / source.power;
    speed = trial.speed();
  }
};

// Spreads directions evenly over the sphere: equal steps of height, each turned by the golden angle.
std::vector<Direction> spiral(int count) {
  std::vector<Direction> directions;
  directions.reserve(count);
  for (int i = 0; i < count; ++i)
    directions.push_back(from_angles(std::acos(1 - (2.0 * i + 1) / count) * 180 / std::numbers::pi,
                                     360 * std::numbers::phi * i));
  return directions;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double worst(const std::vector<double>& ratios) {
  return *std::max_element(ratios.begin(), ratios.end(),
                           [](double a, double b) { return std::abs(a - 1) < std::abs(b - 1); });
}
Curve sorted_curve(const std::string& name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  Curve curve{.name = name};
  for (std::size_t i = 0; i < values.size(); ++i)
    curve.points.push_back(
        {100 * (static_cast<double>(i) + 0.5) / static_cast<double>(values.size()), values[i]});
  return curve;
}

std::string text_of(const Direction& d) { return fmt::format("({:g}, {:g}, {:g})", d[0], d[1], d[2]); }

}  // namespace

// Runs a plane of 65 x 65 cells. Its middle third, which the rim does not reach, is measured.
Outcome measure_lit_plane(const Conditions& conditions) {
  constexpr int kSide = 65, kRim = 22, kTop = 3;
  Outcome outcome;
  Curve measured{.name = "automaton", .joined = false}, exact{.name = "cosine", .exact = true};
  for (const double angle : {0., 15., 30., 40., 44., 46., 60., 70., 75.}) {
    Row row{.setting = fmt::format("{:g} degrees, worst of three azimuths", angle),
            .quantity = "heat taken up over exact",
            .exact = 1,
            .gate = 0.01};
    row.value = 1;
    for (const double azimuth : {0., 22.5, 45.}) {
      const Source source = far_source({kSide / 2.0, kTop, kSide / 2.0}, from_angles(angle, azimuth), 2000);
      const Trial trial = light(conditions, kSide, kTop + 2, kSide, source, [](state::Volume& v) {
        for_each_cell({kSide, kTop, kSide}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
      });
      double wanted = 0;
      for (int z = kRim; z < kSide - kRim; ++z)
        for (int x = kRim; x < kSide - kRim; ++x) wanted += on_floor(source, x, kTop, z);
      const double ratio = taken_up(trial.volume(), kRim, kSide - kRim, kRim, kSide - kRim) / wanted;
      measured.points.push_back({angle, ratio * std::cos(angle * std::numbers::pi / 180)});
      if (std::abs(ratio - 1) >= std::abs(row.value - 1)) {
        row.value = ratio;
        row.speed = trial.speed();
      }
    }
    outcome.rows.push_back(std::move(row));
  }
  for (int angle = 0; angle <= 90; angle += 2)
    exact.points.push_back({static_cast<double>(angle), std::cos(angle * std::numbers::pi / 180)});
  outcome.charts.push_back({.title = "A plane under a far source",
                            .x_label = "angle from the vertical, degrees",
                            .y_label = "heat taken up (1: upright)",
                            .curves = {std::move(exact), std::move(measured)}});
  return outcome;
}

namespace {

// Returns the silhouettes of the ball's cells, over that of the ball.
std::vector<double> silhouettes_of_cells(const std::vector<Source>& sources, double of_ball) {
  const state::Volume cells = cells_of_ball();
  std::vector<double> silhouettes;
  silhouettes.reserve(sources.size());
  for (const Source& source : sources) silhouettes.push_back(solid_angle(cells, source.at) / of_ball);
  return silhouettes;
}

}  // namespace

// Runs a ball of radius 20, the source 50 radii away, from three directions by name and 100 on a spiral over
// the sphere. A ball of cells has the symmetry of the grid, under which no two of the 100 are alike.
Outcome measure_lit_ball(const Conditions& conditions) {
  const int count = conditions.quick ? 40 : 100;
  const double exact = ball_intercepts(kBallRadius, kBallDistance);
  Conditions without_baseline = conditions;
  without_baseline.baseline = false;
  Outcome outcome;
  const auto row = [&](const std::string& setting, const std::string& over, double value,
                       std::optional<double> gate, const Speed& speed) {
    outcome.rows.push_back({.setting = setting,
                            .quantity = "energy taken up over the cross-section of " + over,
                            .value = value,
                            .exact = 1,
                            .gate = gate,
                            .speed = speed});
  };
  for (const Direction& d : {Direction{0, 1, 0}, Direction{1, 1, 0}, Direction{1, 1, 1}}) {
    const LitBall lit(conditions, far_source(kBallMiddle, d, kBallDistance), 1);
    row("1 ray per face, from " + text_of(d), "the ball", lit.energy / exact, 0.1, lit.speed);
  }

  std::vector<Source> sources;
  for (const Direction& d : spiral(count)) sources.push_back(far_source(kBallMiddle, d, kBallDistance));
  const std::vector<double> silhouettes = silhouettes_of_cells(sources, exact);
  struct Setting {
    int rays;
    std::optional<double> of_ball, of_cells, of_mean;  // gates
  };
  std::vector<Curve> curves;
  for (const Setting& setting :
       {Setting{1, {}, {}, {}}, Setting{4, {}, 0.1, 0.01}, Setting{16, 0.1, 0.1, 0.01}}) {
    const std::string name = rays_text(setting.rays);
    const std::string worst_of = fmt::format("{}, worst of {}", name, count);
    const std::string mean_of = fmt::format("{}, mean of {}", name, count);
    std::vector<double> of_ball, of_cells;
    Speed speed;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const LitBall lit(i == 0 ? conditions : without_baseline, sources[i], setting.rays);
      if (i == 0) speed = lit.speed;
      of_ball.push_back(lit.energy / exact);
      of_cells.push_back(of_ball.back() / silhouettes[i]);
    }
    row(worst_of, "the ball", worst(of_ball), setting.of_ball, speed);
    row(mean_of, "the ball", mean(of_ball), {}, speed);
    row(worst_of, "its cells", worst(of_cells), setting.of_cells, speed);
    row(mean_of, "its cells", mean(of_cells), setting.of_mean, speed);
    curves.push_back(sorted_curve(name, of_ball));
  }
  outcome.rows.push_back({.setting = fmt::format("mean of {} directions", count),
                          .quantity = "cross-section of the cells over that of the ball",
                          .value = mean(silhouettes),
                          .exact = 1,
                          .note = "cells whose centre lies in the ball reach beyond it"});
  curves.push_back(sorted_curve("cross-section of the cells", silhouettes));
  curves.push_back({.name = "ball", .points = {{0, 1}, {100, 1}}, .exact = true});
  outcome.charts.push_back({.title = fmt::format("A ball lit from {} directions", count),
                            .x_label = "directions in order of the value, %",
                            .y_label = "energy taken up over the ball's",
                            .curves = std::move(curves)});
  return outcome;
}

// A wall 12 cells high is on a floor, with the source to its left. The length of the shadow is the light that
// the floor behind it lacks beside an open floor, in whole cells. Rays stand 1/m of a cell apart, m along
// each side of a face, so that it may be wrong by 1/(2 m).
Outcome measure_shadow_edge(const Conditions& conditions) {
  constexpr int kWide = 96, kDeep = 9, kFloor = 2, kWallEnd = 24, kWallTop = kFloor + 12, kRow = kDeep / 2;
  const auto fill = [](state::Volume& v) {
    for_each_cell({kWide, kFloor, kDeep}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
    for_each_cell({kWallEnd, kWallTop, kDeep}, [&](int x, int y, int z) {
      if (x >= kWallEnd - 3) put_solid(v, x, y, z);
    });
  };
  Outcome outcome;
  Chart chart{.title = "The shadow of a wall 12 cells high",
              .x_label = "angle of the light from the vertical, degrees",
              .y_label = "error of its length, cells"};
  for (const int across : {1, 2, 4}) {
    const int rays = across * across;
    Conditions once = conditions;
    once.baseline = conditions.baseline && rays == 1;
    const std::string name = rays_text(rays);
    Curve error{.name = name};
    for (const double angle : {15., 25., 35., 42., 50., 60., 70.}) {
      const Source source = far_source({kWallEnd, kWallTop, kDeep / 2.0}, from_angles(180 - angle, 0), -2000);
      const Trial trial = light(once, kWide, kWallTop + 2, kDeep, source, fill, rays);
      double length = 0;
      for (int x = kWallEnd; x < kWide; ++x)
        length += 1 - taken_up(trial.volume(), x, x + 1, kRow, kRow + 1) / on_floor(source, x, kFloor, kRow);
      const double wanted = (kWallTop - kFloor) * (kWallEnd - source.at[0]) / (source.at[1] - kWallTop);
      error.points.push_back({angle, length - wanted});
      outcome.rows.push_back({.setting = fmt::format("{}, {:g} degrees", name, angle),
                              .quantity = "length of the shadow, cells",
                              .value = length,
                              .exact = wanted,
                              .measure = Measure::absolute,
                              .gate = 0.5 / across + 0.05,
                              .speed = trial.speed()});
    }
    chart.curves.push_back(std::move(error));
  }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

}  // namespace voxmelt::accuracy
