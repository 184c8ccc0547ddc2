// A film that is fed at the top of a horizontal cylinder runs down its side, against Nusselt's film.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/slope.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr int kAxis = 6;  // height of the cylinder's axis above the floor, on which the liquid gathers
constexpr double kKappa = 0.2;
constexpr double kDegree = std::numbers::pi / 180;

enum class Bed { shape, surface, solid };
constexpr Bed kBeds[] = {Bed::shape, Bed::surface, Bed::solid};

const char* name_of(Bed bed) {
  switch (bed) {
    case Bed::shape:
      return "inert shape";
    case Bed::surface:
      return "inert, surface known";
    case Bed::solid:
      return "cold solid";
  }
  return "";
}

struct FilmOnCylinder {
  int radius;
  double thickness;  // of the exact film where the side is upright
  Bed bed;

  double rate() const { return std::round(kOne * kKappa / 3 * std::pow(thickness, 3)) / kOne; }

  Trial trial(const Conditions& conditions) const {
    const int wide = radius + 8, high = kAxis + radius + 8;
    const std::string shape =
        fmt::format("{{shape=\"cylinder\",radius={},height=3,at=[0,{},-1],rotate=[90,0,0]}}", radius, kAxis);
    std::vector<std::string> sets{
        fmt::format("grid.size=[{},{},1]", wide, high),
        fmt::format("vent.0.at=[0.5,{},0.5]", kAxis + radius + 0.5), fmt::format("vent.0.rate={}", rate()),
        fmt::format("flow.viscous.kappa={}", kKappa),
        // A scene must have something of its own, so the inert shape stays where the bed is written.
        bed == Bed::solid ? "inert=[]" : fmt::format("inert=[{}]", shape)};
    if (bed == Bed::solid) sets.push_back(fmt::format("solid=[{}]", shape));
    if (bed == Bed::surface) return {conditions, "cylinder", sets, [this](state::Volume& v) { put_bed(v); }};
    return {conditions, "cylinder", sets};
  }

  // Writes inert cells whose offsets say where the surface lies, as a height field does.
  void put_bed(state::Volume& v) const {
    for (int x = 0; x < radius; ++x) {
      const double height = kAxis + height_at(x + 0.5);
      const int top = static_cast<int>(std::lround(height));
      for (int y = 0; y < top; ++y) put_inert(v, x, y, 0, y + 1 == top ? height - top : 0);
    }
  }
  double height_at(double along) const { return std::sqrt(radius * radius - along * along); }

  // Runs until the film is steady. Returns the mean depth of each column over a while, in cells.
  std::vector<double> steady_depths(Trial& trial) const {
    constexpr int kSamples = 64, kBetween = 4;
    trial.run_to(step_at(6 * radius / (kKappa * thickness * thickness)));  // some three times its way down
    std::vector<double> depths(radius);
    for (int sample = 0; sample < kSamples; ++sample) {
      trial.run_to(trial.steps() + kBetween);
      const Columns columns(trial.volume());
      for (int x = 0; x < radius; ++x) depths[x] += columns.at(x, 0) / kSamples;
    }
    return depths;
  }

  // Returns thickness over exact, the mean of the columns within 5 degrees of so many, if there are any.
  std::optional<double> found(const std::vector<double>& depths, double degrees) const {
    double sum = 0;
    int count = 0;
    for (int x = 0; x < radius; ++x) {
      const double along = x + 0.5, surface = height_at(along) + depths[x];
      const double angle = std::atan2(along, surface);
      if (std::abs(angle / kDegree - degrees) > 5) continue;
      sum += (std::hypot(along, surface) - radius) / cylinder_film(kKappa, rate(), angle);
      ++count;
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
  }
};

}  // namespace

// A column stands beside the next one as long as the bed falls by at most a cell per cell: down to 45
// degrees.
Outcome measure_cylinder_film(const Conditions& conditions) {
  constexpr int kGentle = 40;
  Outcome outcome;
  Chart chart{.title = "Thickness of a film on a cylinder over Nusselt's",
              .x_label = "degrees from the top",
              .y_label = "thickness over exact"};
  chart.curves.push_back({.name = "exact", .points = {{30, 1}, {80, 1}}, .exact = true});
  for (const Bed bed : kBeds)
    for (const FilmOnCylinder& film :
         {FilmOnCylinder{20, 1, bed}, FilmOnCylinder{40, 0.5, bed}, FilmOnCylinder{40, 1, bed}}) {
      Trial trial = film.trial(conditions);
      const std::vector<double> depths = film.steady_depths(trial);
      Curve curve{.name =
                      fmt::format("{}, radius {}, film of {:g}", name_of(bed), film.radius, film.thickness)};
      for (int degrees = 30; degrees <= 80; degrees += 10) {
        const std::optional<double> found = film.found(depths, degrees);
        if (!found) continue;
        Row row{.setting = fmt::format("{}, {} degrees", curve.name, degrees),
                .quantity = "thickness over exact",
                .value = *found,
                .exact = 1,
                .speed = trial.speed()};
        if (degrees <= kGentle) row.gate = 0.1;
        curve.points.push_back({1. * degrees, row.value});
        outcome.rows.push_back(std::move(row));
      }
      if (film.radius == 40 && film.thickness == 1) chart.curves.push_back(std::move(curve));
    }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

}  // namespace voxmelt::accuracy
