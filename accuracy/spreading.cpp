// These cases hold viscous gravity currents on a plane against Huppert (1982).
#include "accuracy/spreading.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/analytic.h"
#include "accuracy/cells.h"
#include "accuracy/measure.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

// A drop starts on Huppert's profile. Its age is the time since it was a point.
struct Start {
  double kappa, depth, front;

  Drop drop() const { return {kappa, 0.75 * std::numbers::pi * front * front * depth}; }
  double age() const { return drop().time_of_front(front); }
  // Returns the steps from the start until the depth has fallen by the factor `thinner`, as t^(-1/4).
  std::uint32_t steps_until(double thinner) const { return step_at(age() * (std::pow(thinner, 4) - 1)); }
  Trial trial(const Conditions& conditions, double thinnest) const {
    const int half = static_cast<int>(std::ceil(front * std::sqrt(thinnest))) + 5;
    return {conditions,
            "flow",
            {fmt::format("grid.size=[{0},{1},{0}]", 2 * half + 1, static_cast<int>(std::ceil(depth)) + 2),
             fmt::format("flow.viscous.kappa={}", kappa)},
            [&](state::Volume& v) {
              for (int z = 0; z < v.grid.z; ++z)
                for (int x = 0; x < v.grid.x; ++x)
                  put_column(v, x, z, drop().height(std::hypot(x - half, z - half), age()));
            }};
  }
};

struct Sample {
  double time, depth;  // time since the drop was a point; depth in the middle, by Huppert
  Moments moments;
  double radius_error;  // relative
};
Sample sample(const Start& start, const Trial& trial) {
  const Drop drop = start.drop();
  const double time = start.age() + trial.steps();
  const Moments m = moments(Columns(trial.volume()));
  return {time, drop.height(0, time), m, m.rms_radius / drop.rms_radius(time) - 1};
}

// Returns d log radius / d log time between two samples.
double exponent(const Sample& a, const Sample& b) {
  return std::log(b.moments.rms_radius / a.moments.rms_radius) / std::log(b.time / a.time);
}

Chart profile_chart(const std::string& title, const Trial& trial, double front,
                    const std::function<double(double radius)>& height) {
  Curve measured{.name = "automaton"}, exact{.name = "Huppert", .exact = true};
  const std::vector<double> rings = radial_profile(Columns(trial.volume()));
  const double end = 1.15 * front;
  for (std::size_t r = 0; r < rings.size() && static_cast<double>(r) < end; ++r)
    measured.points.push_back({static_cast<double>(r), rings[r]});
  for (int i = 1; i <= 120; ++i)  // from 1, as a current that is fed has no depth in its middle
    exact.points.push_back({end * i / 120, height(end * i / 120)});
  return {.title = title, .x_label = "radius, cells", .y_label = "depth, cells", .curves = {exact, measured}};
}
Chart profile_chart(const std::string& title, const Trial& trial, const Start& start, double time) {
  return profile_chart(title, trial, start.drop().front(time),
                       [&](double r) { return start.drop().height(r, time); });
}

Row radius_row(const std::string& setting, const Sample& at, const Drop& drop, const Trial& trial) {
  return {.setting = setting,
          .quantity = "rms radius, cells",
          .value = at.moments.rms_radius,
          .exact = drop.rms_radius(at.time),
          .gate = 0.01,
          .speed = trial.speed()};
}
Row exponent_row(const std::string& setting, double value, double exact, double gate, const Trial& trial) {
  return {.setting = setting,
          .quantity = "exponent of the radius over time",
          .value = value,
          .exact = exact,
          .measure = Measure::absolute,
          .gate = gate,
          .speed = trial.speed()};
}
Row roundness_row(const std::string& setting, double a4, std::optional<double> gate, const Trial& trial) {
  return {.setting = setting,
          .quantity = "four-fold moment a4",
          .value = a4,
          .exact = 1,
          .measure = Measure::absolute,
          .gate = gate,
          .speed = trial.speed()};
}
Row profile_row(const std::string& setting, const Trial& trial, const Start& start, double time) {
  const double error =
      profile_error(Columns(trial.volume()), [&](double r) { return start.drop().height(r, time); });
  return {.setting = setting,
          .quantity = "rms difference of the profile over its mean depth",
          .value = error,
          .measure = Measure::absolute,
          .gate = 0.04,
          .speed = trial.speed()};
}

// Returns the current of the flux that the vent has really given. Its rate, rounded to units of amount,
// decides that.
FedCurrent fed(const Trial& trial, double kappa) {
  return {kappa, static_cast<double>(trial.simulation().ledger().mass.added) / kOne / trial.steps()};
}

}  // namespace

// The drop goes from depth 10 to 2 at kappa 0.02. Each of five samples must hold.
Outcome measure_huppert(const Conditions& conditions) {
  const Start start{0.02, 10, 20};
  Trial trial = start.trial(conditions, 5);
  Outcome outcome;
  Curve error{.name = "depth 10 to 2, kappa 0.02"};
  std::vector<Sample> samples;
  for (const std::uint32_t step : {220u, 500u, 1200u, 2100u, 7000u}) {
    trial.run_to(step);
    samples.push_back(sample(start, trial));
    const std::string setting = fmt::format("depth {:.1f}, step {}", samples.back().depth, step);
    outcome.rows.push_back(radius_row(setting, samples.back(), start.drop(), trial));
    error.points.push_back({static_cast<double>(step), 100 * samples.back().radius_error});
    if (step == 220 || step == 7000)
      outcome.charts.push_back(profile_chart("Profile, " + setting, trial, start, samples.back().time));
  }
  const std::string last = "depth 4 to 2";
  outcome.rows.push_back(exponent_row(last, exponent(samples[2], samples[4]), 0.125, 0.003, trial));
  outcome.rows.push_back(profile_row("step 7000", trial, start, samples.back().time));
  outcome.rows.push_back(roundness_row("step 7000", samples.back().moments.a4, 0.005, trial));
  outcome.charts.insert(outcome.charts.begin(), {.title = "Error of the rms radius",
                                                 .x_label = "step",
                                                 .y_label = "error, %",
                                                 .curves = {std::move(error)},
                                                 .logarithmic_x = true,
                                                 .band = 1});
  return outcome;
}

// Films go from depth 2 to 1/2, and on to 0.4, where the dead zone of one unit of head has an effect.
Outcome measure_thin_film(const Conditions& conditions) {
  const Start start{0.1, 2, conditions.quick ? 14. : 20.};
  Trial trial = start.trial(conditions, 2 / 0.35);
  std::vector<double> depths{1.4, 1.0, 0.7, 0.5};
  if (!conditions.quick) depths.push_back(0.4);
  Outcome outcome;
  Curve error{.name = "depth 2 to 0.4, kappa 0.1"};
  std::vector<Sample> samples;
  for (const double depth : depths) {
    trial.run_to(start.steps_until(2 / depth));
    samples.push_back(sample(start, trial));
    const std::string setting = fmt::format("depth {:g}, step {}", depth, trial.steps());
    outcome.rows.push_back(radius_row(setting, samples.back(), start.drop(), trial));
    if (depth < 0.5) outcome.rows.back().gate.reset();
    error.points.push_back({samples.back().depth, 100 * samples.back().radius_error});
    if (depth == 0.5) {
      outcome.rows.push_back(profile_row(setting, trial, start, samples.back().time));
      outcome.rows.push_back(roundness_row(setting, samples.back().moments.a4, 0.005, trial));
      outcome.charts.push_back(profile_chart("Profile, " + setting, trial, start, samples.back().time));
    }
  }
  outcome.rows.push_back(
      exponent_row("depth 1.4 to 0.7", exponent(samples[0], samples[2]), 0.125, 0.003, trial));
  outcome.rows.push_back(
      exponent_row("depth 0.7 to 0.5", exponent(samples[2], samples[3]), 0.125, 0.003, trial));
  if (!conditions.quick) {
    outcome.rows.push_back(
        exponent_row("depth 0.5 to 0.4", exponent(samples[3], samples[4]), 0.125, 0.003, trial));
    outcome.rows.back().gate.reset();
  }
  outcome.charts.insert(outcome.charts.begin(), {.title = "Error of the rms radius of a thin film",
                                                 .x_label = "depth in the middle, cells",
                                                 .y_label = "error, %",
                                                 .curves = {std::move(error)},
                                                 .band = 1});
  return outcome;
}

namespace {

// Puts a vent of radius 3 that gives `flux` cells per step. The plane is as wide as the liquid will be at
// `steps`.
Trial vent_on_plane(const Conditions& conditions, double kappa, double flux, std::uint32_t steps) {
  constexpr double kVentCells = 76;  // cells with their centre within the radius
  const int half = static_cast<int>(1.12 * FedCurrent{kappa, flux}.front(steps)) + 4;
  return Trial(
      conditions, "vent",
      {fmt::format("grid.size=[{0},{1},{0}]", 2 * half + 1, 22),
       fmt::format("vent.0.at=[{0},0.5,{0}]", half + 0.5), fmt::format("vent.0.rate={}", flux / kVentCells),
       fmt::format("flow.viscous.kappa={}", kappa)});
}

}  // namespace

// Runs a vent of radius 3 that gives 5 cells per step. In the second moment its width cancels. It brings to
// the moment from the start what it takes away from the depth above the vent (Green's theorem on h^4 and
// r^2).
Outcome measure_flux_vent(const Conditions& conditions) {
  constexpr double kWet = 1.0 / 256;
  const std::uint32_t end = conditions.quick ? 1600 : 3200;
  Outcome outcome;
  Chart errors{.title = "Errors of the radii of what a vent feeds",
               .x_label = "step",
               .y_label = "error, %",
               .logarithmic_x = true,
               .band = 1};
  for (const double kappa : {0.02, 0.2}) {
    Trial trial = vent_on_plane(conditions, kappa, 5, end);
    const std::string setting = fmt::format("kappa {:g}", kappa);
    struct Radius {
      const char* name;
      double gate;
      std::vector<Point> values{};
      Curve error{};
    } rms{"rms radius", 0.01}, wet{"radius of the wet area", 0.04};
    for (const std::uint32_t step : {end / 32, end / 16, end / 8, end / 4, end / 2, end}) {
      trial.run_to(step);
      const Columns columns(trial.volume());
      const FedCurrent current = fed(trial, kappa);
      const auto note = [&](Radius& radius, double value, double wanted) {
        radius.values.push_back({1. * step, value});
        radius.error.points.push_back({1. * step, 100 * (value / wanted - 1)});
        if (step == end)
          outcome.rows.push_back(
              {.setting = fmt::format("{}, step {}", setting, end),
               .quantity = fmt::format("{}, cells, at {:.3f} cells per step", radius.name, current.flux),
               .value = value,
               .exact = wanted,
               .gate = radius.gate,
               .speed = trial.speed()});
      };
      note(rms, moments(columns).rms_radius, current.rms_radius(step));
      note(wet, wet_radius(columns, kWet), current.front(step));
    }
    for (Radius* one : {&rms, &wet}) {
      const auto& p = one->values;
      Row row = exponent_row(fmt::format("{}, steps {} to {}", setting, end / 4, end),
                             std::log(p[5].y / p[3].y) / std::log(4.0), 0.5, 0.01, trial);
      row.quantity = fmt::format("exponent of the {} over time", one->name);
      outcome.rows.push_back(std::move(row));
      one->error.name = fmt::format("{}, {}", one->name, setting);
      errors.curves.push_back(std::move(one->error));
    }
    outcome.rows.back().gate.reset();
    outcome.rows.back().note =
        "wet cells reach a good cell beyond the front at all times: a constant, which lowers the exponent";
    const FedCurrent current = fed(trial, kappa);
    outcome.charts.push_back(profile_chart(fmt::format("Profile, {}, step {}", setting, trial.steps()), trial,
                                           current.front(trial.steps()),
                                           [&](double r) { return current.height(r, trial.steps()); }));
  }
  outcome.charts.insert(outcome.charts.begin(), std::move(errors));
  return outcome;
}

}  // namespace voxmelt::accuracy
