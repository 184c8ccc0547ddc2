#include "accuracy/front/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "accuracy/front/depth_map.h"
#include "accuracy/front/pick.h"
#include "accuracy/trial.h"
#include "measure/clocks.h"

namespace voxmelt::accuracy::front {
namespace {

constexpr int kSeeds = 3;
constexpr std::uint64_t kFirstSeed = 1001;
constexpr int kRounds = 3;
constexpr double kTimedOnce = 10;  // seconds: a run that takes longer is timed once

// This clock does not count the time of other work on the machine.
double processor_seconds() { return measure::now(measure::Clock::thread); }

struct Ran {
  Setting setting;
  Curves curves{};
  DepthMap map{};
  double seconds = 0;
};

// Keeps all runs of one subject, each computed once.
class Runs {
 public:
  Runs(const Subject& subject, const Conditions& conditions, const std::function<void()>& told)
      : subject_(subject), conditions_(conditions), told_(told) {
    conditions_.threads = conditions_.threads_always = 1;
    conditions_.baseline = false;
  }

  const Ran& at(const Setting& setting) {
    for (const Ran& ran : ran_)
      if (ran.setting == setting) return ran;
    return ran_.emplace_back(run(setting, {}));
  }

  Ran run(const Setting& setting, const std::vector<std::string>& more) const {
    std::vector<std::string> sets = subject_.sets(setting);
    sets.insert(sets.end(), more.begin(), more.end());
    Trial trial(conditions_, subject_.scene, sets);
    Ran ran{.setting = setting};
    for (std::uint32_t i = 1; i <= subject_.samples; ++i) {
      told_();
      const double start = processor_seconds();
      trial.run_to(subject_.steps_to(setting, i));
      ran.seconds += processor_seconds() - start;
      ran.curves.push_back(sample_of(trial.volume(), subject_.scale(setting)));
    }
    ran.map = map_of(trial.volume(), setting.grid);
    return ran;
  }

  // Runs further rounds, each over all these settings, so that other work on the machine hits them alike. The
  // shortest time of a run counts.
  void time_again(const std::vector<Setting>& settings, int rounds) {
    for (int round = 1; round < rounds; ++round)
      for (Ran& ran : ran_)
        if (ran.seconds < kTimedOnce &&
            std::find(settings.begin(), settings.end(), ran.setting) != settings.end())
          ran.seconds = std::min(ran.seconds, run(ran.setting, {}).seconds);
  }

 private:
  const Subject& subject_;
  Conditions conditions_;
  const std::function<void()>& told_;
  std::list<Ran> ran_;  // a list, because references to its members are kept
};

Difference difference(const Ran& found, const Ran& reference) {
  return {errors(found.curves, reference.curves), part_elsewhere(found.map, reference.map)};
}

std::vector<Measured> points_of(const std::vector<Ladder>& all, Runs& runs) {
  std::vector<Measured> points;
  for (const Ladder& ladder : all)
    for (const Setting& setting : ladder.settings)
      points.push_back({.axis = ladder.axis,
                        .setting = setting,
                        .reference = setting == ladder.reference(),
                        .difference = difference(runs.at(setting), runs.at(ladder.reference())),
                        .seconds = 0});
  return points;
}

// The viscous law and point sources draw no random bits (docs/automaton.md, section 2).
Noise noise_of(const Subject& subject, const Setting& usual, Runs& runs) {
  Noise noise;
  if (subject.viscous) return noise;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
    const Difference other = difference(runs.run(usual, {fmt::format("run.seed={}", seed)}), runs.at(usual));
    noise.curves = std::max(noise.curves, other.curves.largest());
    noise.map = std::max(noise.map, other.map);
  }
  return noise;
}

void tell_times(Runs& runs, Swept& swept) {
  for (Measured& point : swept.points) point.seconds = runs.at(point.setting).seconds;
  for (Pick& pick : swept.picks) pick.seconds = runs.at(pick.setting).seconds;
  swept.usual_seconds = runs.at(swept.usual).seconds;
}

// Picks for each bound. The settings that are picked are timed beside the usual one.
void pick_all(Runs& runs, int rounds, Swept& swept) {
  std::vector<Setting> settings{swept.usual};
  for (const double bound : kBounds) {
    swept.picks.push_back(pick(swept.points, swept.usual, swept.noise, bound));
    settings.push_back(runs.at(swept.picks.back().setting).setting);
  }
  runs.time_again(settings, rounds);
}

}  // namespace

double Difference::error() const { return std::max(curves.largest(), map); }

Swept sweep(const Subject& subject, Extent extent, const Conditions& conditions,
            const std::function<void()>& told) {
  Swept swept{.subject = &subject, .usual = usual_setting(extent)};
  const int rounds = extent == Extent::quick ? 1 : kRounds;
  Runs runs(subject, conditions, told);
  swept.points = points_of(ladders(subject, extent), runs);
  swept.noise = noise_of(subject, swept.usual, runs);
  std::vector<Setting> settings;
  for (const Measured& point : swept.points) settings.push_back(point.setting);
  runs.time_again(settings, rounds);
  tell_times(runs, swept);
  pick_all(runs, rounds, swept);
  tell_times(runs, swept);
  if (!subject.viscous) swept.formats = compare_formats(subject, extent, conditions);
  return swept;
}

}  // namespace voxmelt::accuracy::front
