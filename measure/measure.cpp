#include "measure/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "kernel/automaton/state/digest.h"
#include "kernel/run/simulation.h"
#include "measure/baseline_run.h"

namespace voxmelt::measure {
namespace {

run::Simulation fresh(const Workload& workload, const Candidate& candidate) {
  step::Tuning tuning;
  tuning.threads = candidate.threads;
  return {workload.parameters, workload.start, *candidate.implementation, tuning};
}

}  // namespace

double Seconds::flow() const {
  using enum step::Phase;
  return phase[index_of(gravity)] + phase[index_of(spread)] + phase[index_of(excess)];
}
double Seconds::heat() const {
  return phase[index_of(step::Phase::heat)] + phase[index_of(step::Phase::melt)];
}
double Seconds::total() const {
  double sum = 0;
  for (const double one : phase) sum += one;
  return sum;
}

Seconds mean(const Steps& steps) {
  Seconds result;
  for (const Seconds& step : steps)
    for (std::size_t p = 0; p < result.phase.size(); ++p)
      result.phase[p] += step.phase[p] / static_cast<double>(steps.size());
  return result;
}

void Fastest::add(const Steps& round) {
  if (rounds_++ == 0) least_ = round;
  means_.push_back(mean(round));
  for (std::size_t i = 0; i < least_.size(); ++i)
    for (std::size_t p = 0; p < least_[i].phase.size(); ++p)
      least_[i].phase[p] = std::min(least_[i].phase[p], round[i].phase[p]);
}

Medians Fastest::median() const {
  const auto the_one = [&](double (Seconds::*part)() const) {
    std::vector<double> all;
    for (const Seconds& one : means_) all.push_back((one.*part)());
    if (all.empty()) return 0.0;
    const auto middle = all.begin() + all.size() / 2;
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
  };
  return {the_one(&Seconds::flow), the_one(&Seconds::heat)};
}

std::uint64_t expected_digest(const Workload& workload) {
  const step::Implementation* judge = run::implementations().find(workload.judge);
  run::Simulation simulation = fresh(workload, {judge, 1});
  for (int i = 0; i < workload.lead_steps + workload.steps; ++i) simulation.step();
  return state::digest(simulation.volume());
}

void check_result(const run::Simulation& simulation, const Workload& workload, const Candidate& candidate,
                  std::uint64_t expected) {
  const auto fail = [&](const std::string& what) {
    throw Mismatch(fmt::format("{} on {}, {} threads: {}", candidate.implementation->name, workload.name,
                               candidate.threads, what));
  };
  const std::uint64_t digest = state::digest(simulation.volume());
  if (digest != expected)
    fail(fmt::format("digest {:016x} after {} steps; {} has {:016x}", digest,
                     workload.lead_steps + workload.steps, workload.judge, expected));
  const state::Drift drift = simulation.drift();
  if (drift.mass != 0 || drift.energy != 0 || drift.heat != 0) fail("the ledgers do not balance");
}

Steps timed_run(const Workload& workload, const Candidate& candidate, std::uint64_t expected) {
  run::Simulation simulation = fresh(workload, candidate);
  for (int i = 0; i < workload.lead_steps; ++i) simulation.step();
  Steps steps;
  for (int i = 0; i < workload.steps; ++i) {
    const state::Seconds before = simulation.seconds();
    simulation.step();
    Seconds& step = steps.emplace_back();
    for (std::size_t p = 0; p < step.phase.size(); ++p) {
      const auto time = step::time_of(static_cast<step::Phase>(p));
      step.phase[p] = simulation.seconds().*time - before.*time;
    }
  }

  check_result(simulation, workload, candidate, expected);
  return steps;
}

Result measure(const Workload& workload, const std::vector<Candidate>& candidates, const Rounds& rounds,
               bool baseline) {
  const std::uint64_t expected = expected_digest(workload);
  std::optional<BaselineRuns> runs;
  if (baseline) runs = BaselineRuns::of(workload);

  Fastest plain, native;
  std::vector<Fastest> ours(candidates.size());
  const RoundClock clock(rounds);
  Result result;
  for (; clock.more(result.rounds); ++result.rounds) {
    if (runs) {
      plain.add(runs->plain());
      if (const std::optional<Steps> steps = runs->native()) native.add(*steps);
    }
    for (std::size_t i = 0; i < candidates.size(); ++i)
      ours[i].add(timed_run(workload, candidates[i], expected));
  }

  for (std::size_t i = 0; i < candidates.size(); ++i)
    result.timings.push_back({candidates[i], ours[i].step(), ours[i].median()});
  if (plain.rounds() > 0) result.plain = plain.step();
  if (native.rounds() > 0) result.native = native.step();
  return result;
}

}  // namespace voxmelt::measure
