// Radiation against Lambert's cosine, the cross-section of a ball, and the edge of a shadow.
#include "accuracy/light.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

using Direction = std::array<double, 3>;

constexpr std::uint32_t kSteps = 16;  // a whole period of the lowest bits, in 1/16 unit
constexpr double kStrength = 1000;    // units of heat per step of a face that is turned to the source

Direction unit(Direction d) {
  const double length = std::hypot(d[0], d[1], d[2]);
  return {d[0] / length, d[1] / length, d[2] / length};
}
// `angle` from the vertical, `azimuth` from x, in degrees.
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
  // Rounds to a sixteenth of a cell, as the automaton does, so that the exact answer is for the same place.
  const auto place = [&](std::size_t a) { return std::round(16 * (centre[a] + distance * d[a])) / 16; };
  return {{place(0), place(1), place(2)}, std::round(kStrength / kHottest * distance * distance)};
}

Trial light(const Conditions& conditions, int nx, int ny, int nz, const Source& source,
            const Trial::Fill& fill) {
  Trial trial(conditions, "light",
              {fmt::format("grid.size=[{},{},{}]", nx, ny, nz),
               fmt::format("heat_source.0.at=[{},{},{}]", source.at[0], source.at[1], source.at[2]),
               fmt::format("heat_source.0.power={}", source.power)},
              fill);
  trial.run_to(kSteps);
  return trial;
}

// Heat per step, in the scene's range x cells, of the columns of a rectangle.
double taken_up(const state::Volume& v, int x0, int x1, int z0, int z1) {
  double sum = 0;
  for_each_cell(v.grid, [&](int x, int y, int z) {
    if (x >= x0 && x < x1 && z >= z0 && z < z1) sum += v.heat[v.at(x, y, z)];
  });
  return sum / (kHottest * kSteps);
}

std::string text_of(const Direction& d) { return fmt::format("({:g}, {:g}, {:g})", d[0], d[1], d[2]); }

}  // namespace

// A plane of 65 x 65 cells; its middle third, which the rim does not reach, is measured.
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
      double wanted = 0;  // power x cosine / distance^2 at the middle of each face
      for (int z = kRim; z < kSide - kRim; ++z)
        for (int x = kRim; x < kSide - kRim; ++x) {
          const double dx = source.at[0] - x - 0.5, dy = source.at[1] - kTop, dz = source.at[2] - z - 0.5;
          wanted += source.power * dy / std::pow(dx * dx + dy * dy + dz * dz, 1.5);
        }
      const double ratio = taken_up(trial.volume(), kRim, kSide - kRim, kRim, kSide - kRim) / wanted;
      measured.points.push_back({angle, ratio * std::cos(angle * std::numbers::pi / 180)});
      if (std::abs(ratio - 1) >= std::abs(row.value - 1)) row.value = ratio, row.speed = trial.speed();
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

// A ball of radius 20, the source 50 radii away: three directions by name, and the 20 corners of
// a dodecahedron.
Outcome measure_lit_ball(const Conditions& conditions) {
  constexpr int kSide = 48;
  constexpr double kRadius = 20, kDistance = 50 * kRadius;
  const double g = std::numbers::phi;
  std::vector<Direction> directions{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}};
  const std::size_t named = directions.size();
  for (const double a : {-1., 1.})
    for (const double b : {-1., 1.}) {
      for (const double c : {-1., 1.}) directions.push_back({a, b, c});
      directions.insert(directions.end(), {{0, a / g, b * g}, {a / g, b * g, 0}, {b * g, 0, a / g}});
    }
  Outcome outcome;
  Row worst{.setting = "worst of 20 directions",
            .quantity = "energy taken up over exact",
            .value = 1,
            .exact = 1,
            .gate = 0.1};
  Curve measured{.name = "automaton", .joined = false},
      one{.name = "exact", .points = {{1, 1}, {20, 1}}, .exact = true};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double m = kSide / 2.0;
    const Source source = far_source({m, m, m}, directions[i], kDistance);
    const Trial trial = light(conditions, kSide, kSide, kSide, source, [&](state::Volume& v) {
      for_each_cell(v.grid, [&](int x, int y, int z) {
        if (std::hypot(x + 0.5 - m, y + 0.5 - m, z + 0.5 - m) <= kRadius) put_solid(v, x, y, z);
      });
    });
    const double ratio =
        taken_up(trial.volume(), 0, kSide, 0, kSide) / (source.power * ball_intercepts(kRadius, kDistance));
    if (i < named) {
      outcome.rows.push_back({.setting = "from " + text_of(directions[i]),
                              .quantity = worst.quantity,
                              .value = ratio,
                              .exact = 1,
                              .gate = 0.1,
                              .speed = trial.speed()});
    } else {
      measured.points.push_back({static_cast<double>(i - named + 1), ratio});
      if (std::abs(ratio - 1) >= std::abs(worst.value - 1)) worst.value = ratio, worst.speed = trial.speed();
    }
  }
  outcome.rows.push_back(std::move(worst));
  outcome.charts.push_back({.title = "A ball lit from 20 directions",
                            .x_label = "direction",
                            .y_label = "energy taken up over exact",
                            .curves = {std::move(one), std::move(measured)}});
  return outcome;
}

// A wall 12 cells high is on a floor, with the source to its left. Where does its shadow end?
Outcome measure_shadow_edge(const Conditions& conditions) {
  constexpr int kWide = 96, kDeep = 9, kFloor = 2, kWallEnd = 24, kWallTop = kFloor + 12;
  Outcome outcome;
  Curve measured{.name = "automaton", .joined = false}, exact{.name = "exact", .exact = true};
  for (const double angle : {15., 25., 35., 42., 50., 60., 70.}) {
    const Source source = far_source({kWallEnd, kWallTop, kDeep / 2.0}, from_angles(180 - angle, 0), -500);
    const Trial trial = light(conditions, kWide, kWallTop + 2, kDeep, source, [](state::Volume& v) {
      for_each_cell({kWide, kFloor, kDeep}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
      for_each_cell({kWallEnd, kWallTop, kDeep}, [&](int x, int y, int z) {
        if (x >= kWallEnd - 3) put_solid(v, x, y, z);
      });
    });
    const auto lit = [&](int x) {
      return trial.volume().heat[trial.volume().at(x, kFloor - 1, kDeep / 2)] > 0;
    };
    int edge = kWallEnd;
    while (edge < kWide && !lit(edge)) ++edge;
    const double slope = (source.at[1] - kWallTop) / (kWallEnd - source.at[0]);
    const double wanted = (kWallTop - kFloor) / slope;
    measured.points.push_back({angle, static_cast<double>(edge - kWallEnd)});
    exact.points.push_back({angle, wanted});
    outcome.rows.push_back({.setting = fmt::format("{:g} degrees", angle),
                            .quantity = "length of the shadow, cells",
                            .value = static_cast<double>(edge - kWallEnd),
                            .exact = wanted,
                            .measure = Measure::absolute,
                            .note = edge == kWide ? "the floor is dark" : "",
                            .speed = trial.speed()});
  }
  outcome.charts.push_back({.title = "The shadow of a wall 12 cells high",
                            .x_label = "angle of the light from the vertical, degrees",
                            .y_label = "length, cells",
                            .curves = {std::move(exact), std::move(measured)}});
  return outcome;
}

}  // namespace voxmelt::accuracy
