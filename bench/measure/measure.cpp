#include "bench/measure/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "bench/measure/baseline_run.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/run/simulation.h"

namespace voxmelt::measure {
namespace {

constexpr auto index(step::Phase phase) { return static_cast<std::size_t>(phase); }

run::Simulation fresh(const Workload& workload, const Candidate& candidate) {
  step::Tuning tuning;
  tuning.threads = candidate.threads;
  return {workload.parameters, workload.start, *candidate.implementation, tuning};
}

// The values of one quantity over all rounds.
using Series = std::vector<double>;

std::optional<double> median_ratio(const Series& baseline, const Series& ours) {
  if (baseline.empty() || ours.empty()) return std::nullopt;
  Series ratios;
  for (std::size_t i = 0; i < ours.size(); ++i)
    if (ours[i] > 0) ratios.push_back(baseline[i] / ours[i]);
  if (ratios.empty()) return std::nullopt;
  return median(ratios);
}

std::optional<double> median_or_none(const Series& values) {
  return values.empty() ? std::nullopt : std::optional(median(values));
}

struct Ours {
  std::array<Series, step::kPhaseCount> phase;
  Series flow, heat;
  std::vector<Round> rounds;

  void add(const Seconds& seconds, const LaneRates& before, const LaneRates& after) {
    for (std::size_t p = 0; p < phase.size(); ++p) phase[p].push_back(seconds.phase[p]);
    flow.push_back(seconds.flow());
    heat.push_back(seconds.heat());
    rounds.push_back({seconds.flow(),
                      seconds.heat(),
                      {std::max(before.multiply, after.multiply), std::max(before.add, after.add)}});
  }
};

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double Seconds::flow() const {
  using enum step::Phase;
  return phase[index(gravity)] + phase[index(spread)] + phase[index(excess)];
}
double Seconds::heat() const { return phase[index(step::Phase::heat)] + phase[index(step::Phase::melt)]; }
double Seconds::total() const {
  double sum = 0;
  for (const double one : phase) sum += one;
  return sum;
}

std::uint64_t expected_digest(const Workload& workload) {
  const step::Implementation* judge = run::implementations().find(workload.judge);
  run::Simulation simulation = fresh(workload, {judge, 1});
  for (int i = 0; i < workload.lead_steps + workload.steps; ++i) simulation.step();
  return state::digest(simulation.volume());
}

Seconds timed_run(const Workload& workload, const Candidate& candidate, std::uint64_t expected) {
  run::Simulation simulation = fresh(workload, candidate);
  for (int i = 0; i < workload.lead_steps; ++i) simulation.step();
  const auto before = simulation.seconds().phase;
  for (int i = 0; i < workload.steps; ++i) simulation.step();
  Seconds seconds;
  for (std::size_t p = 0; p < before.size(); ++p)
    seconds.phase[p] = (simulation.seconds().phase[p] - before[p]) / workload.steps;

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
  return seconds;
}

Result measure(const Workload& workload, const std::vector<Candidate>& candidates, const Rounds& rounds,
               bool baseline, const RatesNow& rates_now) {
  const std::uint64_t expected = expected_digest(workload);
  for (const Candidate& candidate : candidates) timed_run(workload, candidate, expected);

  std::optional<BaselineRuns> runs;
  if (baseline) runs = BaselineRuns::of(workload);
  std::vector<Ours> ours(candidates.size());
  Series plain_flow, native_flow, plain_heat, native_heat, plain_gravity, plain_spread;
  const auto start = std::chrono::steady_clock::now();
  const auto more = [&](int done) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return done < rounds.fewest || (done < kMostRounds && spent.count() < rounds.seconds);
  };
  const auto now = [&](const Candidate& candidate) { return rates_now ? rates_now(candidate) : LaneRates{}; };
  for (int round = 0; more(round); ++round) {
    if (runs) {
      const BaselineSeconds plain = runs->plain();
      const std::optional<BaselineSeconds> native = runs->native();
      if (workload.times_flow) {
        plain_flow.push_back(plain.flow());
        if (native) native_flow.push_back(native->flow());
        plain_gravity.push_back(plain.gravity);
        plain_spread.push_back(plain.spread + plain.excess);
      }
      if (workload.times_heat && runs->has_heat()) {
        plain_heat.push_back(plain.heat);
        if (native) native_heat.push_back(native->heat);
      }
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const LaneRates before = now(candidates[i]);
      const Seconds seconds = timed_run(workload, candidates[i], expected);
      ours[i].add(seconds, before, now(candidates[i]));
    }
  }

  Result result;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Timing timing;
    timing.candidate = candidates[i];
    timing.rounds = ours[i].rounds;
    for (std::size_t p = 0; p < timing.median.phase.size(); ++p)
      timing.median.phase[p] = median(ours[i].phase[p]);
    timing.flow = median(ours[i].flow);
    timing.heat = median(ours[i].heat);
    timing.flow_ratio = median_ratio(plain_flow, ours[i].flow);
    timing.flow_native_ratio = median_ratio(native_flow, ours[i].flow);
    timing.heat_ratio = median_ratio(plain_heat, ours[i].heat);
    timing.heat_native_ratio = median_ratio(native_heat, ours[i].heat);
    result.timings.push_back(timing);
  }
  result.plain_flow = median_or_none(plain_flow);
  result.native_flow = median_or_none(native_flow);
  result.plain_heat = median_or_none(plain_heat);
  result.native_heat = median_or_none(native_heat);
  result.plain_gravity = median_or_none(plain_gravity);
  result.plain_spread = median_or_none(plain_spread);
  return result;
}

}  // namespace voxmelt::measure
