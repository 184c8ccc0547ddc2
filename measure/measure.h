// The functions here time workloads, and the paper's program on the same state in the same minutes. Every
// timed result is checked.
//
// A time is a minimum: every timed step is repeated from the same state, and each of its phases counts with
// the shortest time that any round needed. Other work on the machine only adds to a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "kernel/automaton/step/stepper.h"
#include "measure/rounds.h"
#include "measure/workloads.h"

namespace voxmelt::run {
class Simulation;
}

namespace voxmelt::measure {

// Is thrown if an implementation gave other bits than the reference, or its ledgers do not balance.
class Mismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Candidate {
  const step::Implementation* implementation = nullptr;
  int threads = 1;
};

// Returns the digest after workload.lead_steps + workload.steps, as the workload's judge computes it.
std::uint64_t expected_digest(const Workload& workload);

// Holds the seconds of one step.
struct Seconds {
  std::array<double, step::kPhaseCount> phase{};  // indexed by step::Phase
  double flow() const;                            // gravity + spread + excess
  double heat() const;                            // heat + melt
  double total() const;
};
using Steps = std::vector<Seconds>;  // the timed steps of one run, in their order

Seconds mean(const Steps& steps);

struct Medians {
  double flow = 0, heat = 0;
};

// Throws Mismatch unless the state has `expected` for a digest, and the ledgers balance.
void check_result(const run::Simulation& simulation, const Workload& workload, const Candidate& candidate,
                  std::uint64_t expected);

// Runs one fresh simulation: workload.lead_steps untimed, then workload.steps timed. Throws Mismatch unless
// the state has `expected` for a digest afterwards and the ledgers balance.
Steps timed_run(const Workload& workload, const Candidate& candidate, std::uint64_t expected);

// Keeps the least time of each phase of each step over all rounds.
class Fastest {
 public:
  void add(const Steps& round);  // every round has the same steps
  int rounds() const { return rounds_; }
  Seconds step() const { return mean(least_); }  // the mean step of these least times
  Medians median() const;  // over the rounds' mean steps: it shows how busy the machine was

 private:
  Steps least_;
  std::vector<Seconds> means_;  // one for each round
  int rounds_ = 0;
};

struct Timing {
  Candidate candidate;
  Seconds step;
  Medians median;
};

struct Result {
  int rounds = 0;
  std::vector<Timing> timings;
  // The paper's program is plainly written, and also compiled for this processor. Both are empty if it cannot
  // run.
  std::optional<Seconds> plain, native;
};

// Measures in rounds. A round is: plain baseline, native baseline, each candidate.
Result measure(const Workload& workload, const std::vector<Candidate>& candidates, const Rounds& rounds,
               bool baseline);

}  // namespace voxmelt::measure
