// These cases ask how much of the regular grid is left in what the automaton does: discs, balls and fronts
// that have no corners of their own.
#include "accuracy/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/ball_state.h"
#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/roundness.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr double kWet = 0.25;  // a column counts as wet from this depth on, in cells

Row absolute(const std::string& setting, const std::string& quantity, double value, const Trial& trial) {
  return {.setting = setting,
          .quantity = quantity,
          .value = value,
          .measure = Measure::absolute,
          .speed = trial.speed()};
}

// Returns the part of a column's square that a disc about the middle of the grid covers, in 64 points.
double covered(int x, int z, double middle, double radius) {
  int count = 0;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      count += std::hypot(x + (i - 3.5) / 8 - middle, z + (j - 3.5) / 8 - middle) < radius ? 1 : 0;
  return count / 64.0;
}

// Puts a cylinder of liquid with a round rim. Its cells have all or none of the paper's energy.
void put_disc(state::Volume& v, double radius, double depth, bool energetic) {
  const double middle = (v.grid.x - 1) / 2.0;
  for (int z = 0; z < v.grid.z; ++z)
    for (int x = 0; x < v.grid.x; ++x) {
      put_column(v, x, z, depth * covered(x, z, middle, radius));
      for (int y = 0; y < depth && energetic; ++y) v.energy[v.at(x, y, z)] = v.amount[v.at(x, y, z)];
    }
}

void add_disc_rows(Outcome& outcome, Chart& chart, const std::string& setting, double wanted,
                   const Trial& trial, std::optional<double> gate) {
  const Columns columns(trial.volume());
  const Outline outline = outline_of(columns, kWet);
  const std::string name = fmt::format("{}, {:g} cells", setting, wanted);
  outcome.rows.push_back(absolute(name, "a4 - 1 of the mass", moments(columns).a4 - 1, trial));
  outcome.rows.push_back(absolute(name, "cos 4 phi of the outline over its radius", outline.c4, trial));
  outcome.rows.back().note = fmt::format("radius {:.1f}, step {}", outline.mean, trial.steps());
  outcome.rows.push_back(absolute(name, "cos 8 phi of the outline over its radius", outline.c8, trial));
  for (std::size_t i = outcome.rows.size() - 3; i < outcome.rows.size(); ++i) outcome.rows[i].gate = gate;
  outcome.rows.push_back(absolute(name, "rms of the rest of the outline, cells", outline.rest, trial));
  if (chart.curves.empty() || chart.curves.back().name != setting) chart.curves.push_back({.name = setting});
  chart.curves.back().points.push_back({wanted, 100 * outline.c4});
}

// The paper's law as a scene of it has it. `pile` starts without energy, and as high as a cone of the slope
// `slump` would be. With 4 neighbours nothing goes along diagonals: this shows what an artefact looks like.
struct PaperScene {
  const char* name;
  double start;                             // radius of the disc at the start over that in the end, nearly
  double threshold, slump, liquid, ground;  // the last two are alphas
  bool pile = false;
  int neighbours = 8;
};
constexpr PaperScene kPaperScenes[] = {
    {"paper law, lava", 0.36, 0.2, 0.3, 0.99, 0.99},
    {"paper law, goblet", 0.52, 0.3, 0.35, 0.96, 0.92},
    {"paper law, a pile without energy", 0.625, 0.3, 0.35, 0.96, 0.92, true},
    {"paper law, the pile with 4 neighbours", 0.625, 0.3, 0.35, 0.96, 0.92, true, 4}};

Trial paper_disc(const Conditions& conditions, const PaperScene& scene, double radius) {
  const double start = scene.start * radius;
  // The volume of the cone of that radius, over the disc's area.
  const double depth = scene.pile ? std::round(radius * scene.slump / 3 / (scene.start * scene.start)) : 4;
  return Trial(conditions, "paper_drop",
               {fmt::format("grid.size=[{0},{1},{0}]", 2 * static_cast<int>(1.2 * radius) + 9,
                            static_cast<int>(depth) + 2),
                fmt::format("flow.paper.neighbours={}", scene.neighbours),
                fmt::format("flow.paper.threshold={}", scene.threshold),
                fmt::format("flow.paper.slump={}", scene.slump),
                fmt::format("flow.paper.alpha_liquid={}", scene.liquid),
                fmt::format("flow.paper.alpha_solid={}", scene.ground),
                fmt::format("flow.paper.alpha_floor={}", scene.ground)},
               [&](state::Volume& v) { put_disc(v, start, depth, !scene.pile); });
}

}  // namespace

// Huppert's drop says when a disc of 5/8 of the radius has reached it. The paper's law comes to rest where
// its energy ends.
Outcome measure_round_disc(const Conditions& conditions) {
  constexpr double kKappa = 0.4, kDepth = 4;
  Outcome outcome;
  Chart chart{.title = "Cos 4 phi of a disc's outline",
              .x_label = "radius in the end, cells",
              .y_label = "over the radius, %",
              .logarithmic_x = true};
  const std::vector<double> radii =
      conditions.quick ? std::vector<double>{16} : std::vector<double>{16, 32, 64, 128};
  for (const double radius : radii) {
    const double start = 5. / 8 * radius;
    const Drop drop{kKappa, std::numbers::pi * start * start * kDepth};
    Trial trial(conditions, "flow",
                {fmt::format("grid.size=[{0},{1},{0}]", 2 * static_cast<int>(1.1 * radius) + 9, 6),
                 fmt::format("flow.viscous.kappa={}", kKappa)},
                [&](state::Volume& v) { put_disc(v, start, kDepth, false); });
    trial.run_to(step_at(drop.time_of_front(radius)));
    add_disc_rows(outcome, chart, "viscous law", radius, trial, 0.005);
  }
  for (const PaperScene& scene : kPaperScenes)
    for (const double radius : radii) {
      if (scene.pile && radius > 64) continue;  // it would be 58 cells high
      Trial trial = paper_disc(conditions, scene, radius);
      trial.run_to(step_at(conditions.quick ? 500 : 500 * radius / 16));
      add_disc_rows(outcome, chart, scene.name, radius, trial,
                    scene.neighbours == 8 ? std::optional(0.02) : std::nullopt);
    }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

// A ball at its melting point in hot air loses what melts at once. It stays a ball if its surface recedes
// alike everywhere. The area of air is right on the mean over all directions alone: by hand, a plane at 45
// degrees between two axes recedes by 5/4 / sqrt 2 = 0.884 of what a face does, one between three by 0.866.
Outcome measure_round_ball(const Conditions& conditions) {
  constexpr double kMelting = 0.4;
  Outcome outcome;
  Chart chart{.title = "Reach of what is left of a ball, over a ball of that volume",
              .x_label = "part that has melted, %",
              .y_label = "deviation, %"};
  for (const double radius : {12., 24., 48.}) {
    if (conditions.quick && radius > 12) continue;
    const int side = static_cast<int>(2 * radius) + 4;
    Trial trial(conditions, "oven",
                {fmt::format("grid.size=[{0},{0},{0}]", side), fmt::format("drain.0.radius={}", 2 * side)},
                [&](state::Volume& v) { put_ball(v, radius, kMelting * kHottest, 0); });
    const double all = unmelted(trial);
    Curve axes{.name = fmt::format("axes, radius {:g}", radius)},
        spaces{.name = fmt::format("diagonals of space, radius {:g}", radius)};
    for (const double part : {0., 0.25, 0.5, 0.75}) {
      while (unmelted(trial) > (1 - part) * all) trial.run_to(trial.steps() + (radius > 12 ? 8 : 2));
      const Extents e =
          extents_of(trial.volume().grid, [&](int x, int y, int z) { return unmelted_of(trial, x, y, z); });
      const std::string setting = fmt::format("radius {:g}, {:g} % melted", radius, 100 * part);
      const auto add = [&](const std::string& where, double extent) {
        outcome.rows.push_back({.setting = setting,
                                .quantity = "reach along " + where + " over that of an equal ball",
                                .value = extent,
                                .exact = 1,
                                .gate = 0.03,
                                .speed = trial.speed()});
      };
      add("axes", e.axes);
      add("diagonals of faces", e.faces);
      add("diagonals of space", e.spaces);
      axes.points.push_back({100 * part, 100 * (e.axes - 1)});
      spaces.points.push_back({100 * part, 100 * (e.spaces - 1)});
    }
    chart.curves.push_back(std::move(axes));
    chart.curves.push_back(std::move(spaces));
  }
  outcome.charts.push_back(std::move(chart));
  return outcome;
}

namespace {

// A film lies uphill of a straight line on a plane that falls along a direction, and its front runs down. The
// front keeps its shape, so it moves by its flux over its depth, kappa / 3 x nusselt(slope) x depth^2.
struct StraightFront {
  double slope, degrees;
  int side;
  double depth = 1.6, kappa = 0.1;

  double angle() const { return degrees * std::numbers::pi / 180; }
  double speed() const { return kappa / 3 * nusselt(slope) * depth * depth; }
  int high() const {
    return static_cast<int>(std::ceil(slope * side * (std::cos(angle()) + std::sin(angle())))) + 7;
  }
  // `line` is the place of the front at the start, from the middle.
  void fill(state::Volume& v, double line, bool energetic) const {
    const double middle = (side - 1) / 2.0;
    for (int z = 0; z < side; ++z)
      for (int x = 0; x < side; ++x) {
        const double along = (x - middle) * std::cos(angle()) + (z - middle) * std::sin(angle());
        const double height = (high() - 4) / 2.0 - slope * along;
        const int top = static_cast<int>(std::lround(height));
        for (int y = 0; y < top; ++y) put_inert(v, x, y, z, y + 1 == top ? height - top : 0);
        put_column(v, x, z, depth * std::clamp(line - along + 0.5, 0.0, 1.0), top);
        for (int y = top; y < v.grid.y && energetic; ++y) v.energy[v.at(x, y, z)] = v.amount[v.at(x, y, z)];
      }
  }
};

struct Run {
  Front last;
  double speed;  // from a quarter of the steps to the end
  std::string way;
};
Run run_front(const StraightFront& film, Trial& trial, std::uint32_t end) {
  const auto front = [&](std::uint32_t step) {
    trial.run_to(step);
    return front_of(Columns(trial.volume()), film.angle(), film.side / 8.0, kWet);
  };
  const std::uint32_t begin = end / 4;
  const Front first = front(begin), last = front(end);
  return {last, (last.place - first.place) / (end - begin),
          fmt::format("from {:.1f} to {:.1f} cells", first.place, last.place)};
}

}  // namespace

// The paper's law is no viscous liquid: its speed stands beside its own along the grid.
Outcome measure_straight_front(const Conditions& conditions) {
  Outcome outcome;
  const int side = conditions.quick ? 49 : 97;
  const int line = side / 16, way = side / 6;
  for (const bool viscous : {true, false})
    for (const double slope : {0.1, 0.25, 0.5}) {
      std::optional<double> along_the_grid;
      for (const double degrees : {0., 15., 30., 45.}) {
        if (conditions.quick && (slope != 0.25 || degrees == 15 || degrees == 45)) continue;
        const StraightFront film{slope, degrees, side};
        std::vector<std::string> sets{fmt::format("grid.size=[{0},{1},{0}]", side, film.high())};
        if (viscous) sets.push_back(fmt::format("flow.viscous.kappa={}", film.kappa));
        Trial trial(conditions, viscous ? "flow" : "paper_drop", sets,
                    [&](state::Volume& v) { film.fill(v, line, !viscous); });
        const Run run = run_front(film, trial,
                                  viscous            ? step_at(way / film.speed())
                                  : conditions.quick ? 100
                                                     : 300);
        if (!along_the_grid) along_the_grid = run.speed;
        const std::string setting = fmt::format("{} law, slope {:g}, {:g} degrees to the grid",
                                                viscous ? "viscous" : "paper", slope, degrees);
        outcome.rows.push_back({.setting = setting,
                                .quantity = viscous ? "speed of the front over exact"
                                                    : "speed of the front over that at 0 degrees",
                                .value = run.speed / (viscous ? film.speed() : *along_the_grid),
                                .exact = 1,
                                .note = run.way,
                                .speed = trial.speed()});
        if (viscous) outcome.rows.back().gate = 0.05;
        outcome.rows.push_back(
            absolute(setting, "rms deviation from a straight line, cells", run.last.roughness, trial));
        outcome.rows.back().gate = viscous ? 0.1 : 0.5;
      }
    }
  return outcome;
}

}  // namespace voxmelt::accuracy
