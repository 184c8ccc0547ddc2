// Times workloads, and the paper's program on the same state in the same minutes. Nothing is timed whose
// result is not checked.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/measure/machine.h"
#include "bench/measure/workloads.h"
#include "kernel/automaton/step/stepper.h"

namespace voxmelt::measure {

// An implementation gave other bits than the reference, or its ledgers do not balance.
class Mismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Candidate {
  const step::Implementation* implementation = nullptr;
  int threads = 1;
};

// The digest after workload.lead_steps + workload.steps, as the workload's judge computes it.
std::uint64_t expected_digest(const Workload& workload);

// Seconds per step.
struct Seconds {
  std::array<double, step::kPhaseCount> phase{};
  double flow() const;  // gravity + spread + excess
  double heat() const;  // heat + melt
  double total() const;
};

// One fresh simulation: workload.lead_steps untimed, then workload.steps timed. Throws Mismatch unless the
// state has `expected` for a digest afterwards and the ledgers balance.
Seconds timed_run(const Workload& workload, const Candidate& candidate, std::uint64_t expected);

// One timed run: seconds per step, and what the machine could do right before or after it, whichever was
// more.
struct Round {
  double flow = 0, heat = 0;
  LaneRates rates;
};

struct Timing {
  Candidate candidate;
  std::vector<Round> rounds;
  Seconds median;                                       // of each phase
  double flow = 0, heat = 0;                            // median seconds per step
  std::optional<double> flow_ratio, flow_native_ratio;  // median of the ratios, baseline / ours
  std::optional<double> heat_ratio, heat_native_ratio;
};

struct Result {
  std::vector<Timing> timings;
  // The paper's program; empty where it cannot run the scene.
  std::optional<double> plain_flow, native_flow, plain_heat, native_heat;
  std::optional<double> plain_gravity, plain_spread;  // spread with excess, as the paper counts
};

// Rounds of: plain baseline, native baseline, each candidate; an untimed run of each candidate comes first.
// At least `fewest` rounds, and more, up to kMostRounds, while `seconds` are not over.
struct Rounds {
  int fewest = 5;
  double seconds = 3;
};
inline constexpr int kMostRounds = 41;
// `rates_now`: asked before and after each timed run of a candidate.
using RatesNow = std::function<LaneRates(const Candidate&)>;
Result measure(const Workload& workload, const std::vector<Candidate>& candidates, const Rounds& rounds,
               bool baseline, const RatesNow& rates_now = {});

double median(std::vector<double> values);

}  // namespace voxmelt::measure
