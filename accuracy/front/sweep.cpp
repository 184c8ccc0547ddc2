#include "accuracy/front/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "accuracy/formats/twin.h"
#include "accuracy/trial.h"
#include "kernel/scene/scene.h"
#include "measure/baseline_run.h"
#include "measure/clocks.h"

namespace voxmelt::accuracy::front {
namespace {

// This clock does not count the time of other work on the machine.
double processor_seconds() { return measure::now(measure::Clock::thread); }

// Times the paper's program from this state on, and takes the fastest of a few steps.
std::optional<double> baseline_cells_per_second(const rule::Parameters& parameters,
                                                const state::Volume& start) {
  measure::Workload workload;
  workload.parameters = parameters;
  workload.start = start;
  workload.times_heat = parameters.heat.enabled;
  const auto runs = measure::BaselineRuns::of(workload);
  if (!runs) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  for (const measure::Seconds& step : runs->plain()) least = std::min(least, step.total());
  return static_cast<double>(start.grid.cells()) / least;
}

struct Ran {
  Curves curves;
  double seconds = 0, cells_per_second = 0;
  std::optional<double> baseline{};  // the paper's program from the middle of the run on
  int state_bits = 0;
};

// Keeps all runs of one subject. The twin's runs are computed once each.
class Runs {
 public:
  Runs(const Subject& subject, const Conditions& conditions)
      : subject_(subject), conditions_(conditions), twin_threads_(conditions.threads) {
    conditions_.threads = conditions_.threads_always = 1;
    conditions_.baseline = false;
  }

  Ran by_engine(const Setting& setting, bool with_baseline, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> sets = subject_.sets(setting);
    sets.insert(sets.end(), more.begin(), more.end());
    Trial trial(conditions_, subject_.scene, sets);
    Ran ran;
    for (std::uint32_t i = 1; i <= subject_.samples; ++i) {
      const double start = processor_seconds();
      trial.run_to(subject_.steps_to(setting, i));
      ran.seconds += processor_seconds() - start;
      ran.curves.push_back(sample_of(trial.volume(), subject_.scale(setting)));
      if (with_baseline && i == subject_.samples / 2)
        ran.baseline = baseline_cells_per_second(trial.simulation().parameters(), trial.volume());
    }
    ran.cells_per_second = static_cast<double>(trial.volume().grid.cells()) * trial.steps() / ran.seconds;
    ran.state_bits = trial.speed().state_bits;
    return ran;
  }

  const Subject& subject() const { return subject_; }

  // Runs the twin at all of these settings, on the threads of the conditions.
  void prepare(const std::vector<Setting>& settings) {
    for (const Setting& setting : settings)
      if (std::none_of(by_twin_.begin(), by_twin_.end(),
                       [&](const auto& one) { return one.first == setting; }))
        by_twin_.emplace_back(setting, Ran{});
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t i = next++; i < by_twin_.size(); i = next++)
        by_twin_[i].second = run_twin(by_twin_[i].first);
    };
    std::vector<std::jthread> others;
    for (int thread = 1; thread < twin_threads_; ++thread) others.emplace_back(work);
    work();
  }

  // Returns the twin's run at a setting that was prepared.
  const Ran& by_twin(const Setting& setting) const {
    const auto found =
        std::find_if(by_twin_.begin(), by_twin_.end(), [&](const auto& one) { return one.first == setting; });
    if (found == by_twin_.end()) throw std::logic_error("the twin was not run at this setting");
    return found->second;
  }

  const Ran& in_double(Setting setting) const {
    setting.arithmetic = kExact;
    return by_twin(setting);
  }

 private:
  Ran run_twin(const Setting& setting) const {
    std::vector<std::string> sets = subject_.sets(setting);
    sets.insert(sets.end(), conditions_.sets.begin(), conditions_.sets.end());
    const scene::Scene scene = scene::load(conditions_.scenes / (subject_.scene + ".toml"), sets);
    const std::unique_ptr<Twin> twin = make_twin(setting.arithmetic, scene.parameters, scene.initial);
    Ran ran;
    ran.state_bits = state_bits(setting.arithmetic.number, scene.parameters);
    std::uint32_t done = 0;
    for (std::uint32_t i = 1; i <= subject_.samples; ++i) {
      const double start = processor_seconds();
      for (; done < subject_.steps_to(setting, i); ++done) twin->step();
      ran.seconds += processor_seconds() - start;
      ran.curves.push_back(sample_of(*twin, subject_.scale(setting)));
    }
    ran.cells_per_second =
        static_cast<double>(scene.initial.grid.cells()) * done / std::max(ran.seconds, 1e-9);
    return ran;
  }

  const Subject& subject_;
  Conditions conditions_;
  int twin_threads_;
  std::vector<std::pair<Setting, Ran>> by_twin_;
};

constexpr int kSeeds = 3;
constexpr std::uint64_t kFirstSeed = 1001;
constexpr int kRounds = 3;

// The twin runs what the engine has no arithmetic for. For a fair comparison it also runs in the engine's
// own.
bool needs_twin(const Choice& choice) { return choice.axis == Axis::format || choice.axis == Axis::rounding; }

Measured by_twin(const Runs& runs, const Choice& choice) {
  Measured point{.choice = choice, .twin = true};
  const Ran& ran = runs.by_twin(choice.setting);
  Setting engines = choice.setting;
  engines.arithmetic = kEngine;
  point.cost = {ran.state_bits, std::nullopt, ran.cells_per_second, std::nullopt,
                ran.cells_per_second / runs.by_twin(engines).cells_per_second};
  return point;
}

// Lists every setting at which the twin must run: as chosen, in double, and in the engine's format.
std::vector<Setting> twins_of(const std::vector<Choice>& chosen, Setting reference) {
  reference.arithmetic = kExact;
  std::vector<Setting> needed{reference};
  for (const Choice& choice : chosen) {
    Setting setting = choice.setting;
    if (setting.grid != reference.grid) continue;
    if (needs_twin(choice)) needed.push_back(setting);
    setting.arithmetic = kExact;
    needed.push_back(setting);
    if (needs_twin(choice)) {
      setting.arithmetic = kEngine;
      needed.push_back(setting);
    }
  }
  return needed;
}

void compare(const Runs& runs, const Curves& found, const Curves& reference, Measured& point) {
  point.whole = errors(found, reference);
  if (runs.subject().viscous) return;
  const Curves& exact = runs.in_double(point.choice.setting).curves;
  point.arithmetic = errors(found, exact);
  point.model = errors(exact, reference);
}

// Runs further rounds, each over all points, so that other work on the machine hits them alike. The shortest
// time of a point counts.
void time_again(const Runs& runs, int rounds, std::vector<Measured>& points) {
  for (int round = 1; round < rounds; ++round)
    for (Measured& point : points) {
      if (point.twin) continue;
      const Ran ran = runs.by_engine(point.choice.setting, false);
      if (ran.seconds >= *point.cost.run_seconds) continue;
      point.cost.run_seconds = ran.seconds;
      point.cost.cells_per_second = ran.cells_per_second;
    }
}

}  // namespace

Swept sweep(const Subject& subject, Extent extent, const Conditions& conditions,
            const std::function<void(const Choice&)>& told) {
  Swept swept{&subject, reference_of(subject, extent), finest_grid(extent), 0, {}};
  const Setting usual = usual_setting(extent);
  Runs runs(subject, conditions);
  const std::vector<Choice> chosen = choices(subject, extent);
  if (!subject.viscous) runs.prepare(twins_of(chosen, swept.reference));
  const Curves reference = subject.viscous ? runs.by_engine(swept.reference, false).curves
                                           : runs.in_double(swept.reference).curves;
  const Curves on_finest_grid = runs.by_engine(swept.finest_grid, false).curves;
  Curves first;  // the curves of the usual setting
  for (const Choice& choice : chosen) {
    told(choice);
    if (needs_twin(choice)) {
      swept.points.push_back(by_twin(runs, choice));
      compare(runs, runs.by_twin(choice.setting).curves, reference, swept.points.back());
      continue;
    }
    const Ran ran = runs.by_engine(choice.setting, true);
    Measured point{.choice = choice};
    point.cost = {ran.state_bits, ran.seconds, ran.cells_per_second, ran.baseline, 0};
    if (choice.setting.grid == usual.grid) compare(runs, ran.curves, reference, point);
    if (choice.axis == Axis::grid || choice.axis == Axis::usual)
      point.grid = errors(ran.curves, on_finest_grid);
    if (choice.axis == Axis::usual) first = ran.curves;
    swept.points.push_back(point);
  }
  time_again(runs, extent == Extent::quick ? 1 : kRounds, swept.points);
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
    const Ran other = runs.by_engine(usual, false, {fmt::format("run.seed={}", seed)});
    swept.seed_error = std::max(swept.seed_error, errors(other.curves, first).largest());
  }
  return swept;
}

}  // namespace voxmelt::accuracy::front
