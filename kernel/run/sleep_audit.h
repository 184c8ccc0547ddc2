// A stepper lets tiles sleep that provably stay as they are. The audit steps them all the same: the same
// kernels run twice, once with every tile awake, and are compared after every phase.
//
// A rule that wakes too little may change nothing for long. So the audit also looks at the tiles themselves:
// a cell beside one that the flow has just changed must be awake in the next step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/state/ledger.h"
#include "kernel/run/simulation.h"

namespace voxmelt::run {

// Is a cell that sleeps in the next step, though the cell beside it was changed.
struct SleepsBeside {
  int x = 0, y = 0, z = 0;
  int changed_x = 0, changed_y = 0, changed_z = 0;
  std::string text() const;
};

// Returns the first such cell, or none. The flow, which is the last gravity and the last spread of a step,
// has made `after` of `before`.
std::optional<SleepsBeside> sleeps_beside_change(const state::Volume& before, const state::Volume& after,
                                                 const step::AwakeTiles& awake);

// Tells if a phase is the first one of the flow.
bool begins_flow(const std::vector<step::Phase>& phases, std::size_t i);

struct SleepFault {
  enum class Kind : std::uint8_t {
    cell,    // a cell is another one with every tile awake
    books,   // no cell is, but the ledgers are
    beside,  // a cell sleeps beside one that was changed
  };
  Kind kind = Kind::cell;
  std::uint32_t step = 0;
  step::Phase phase = step::Phase::source;
  int x = 0, y = 0, z = 0;
  std::string field;  // field of the cell, term of the ledgers, or what sleeps beside what
  state::Sum expected = 0, actual = 0;
  bool slept = false;  // the cell's tile was to sleep in this step
  std::string text() const;
};

class SleepAudit {
 public:
  SleepAudit(const rule::Parameters& parameters, const state::Volume& start, std::uint32_t first_step,
             const step::Implementation& implementation, step::Tuning tuning);

  // Runs one step. Returns the first fault, after which no step may follow.
  std::optional<SleepFault> step();

  const state::Volume& volume() const { return sleeping_.volume(); }
  // Count the tiles of all steps, and those that were to sleep.
  std::int64_t tiles() const { return tiles_; }
  std::int64_t asleep() const { return asleep_; }

 private:
  void count(const step::AwakeTiles& awake);
  std::optional<SleepFault> compare(step::Phase phase, const step::AwakeTiles& awake) const;

  Simulation sleeping_, awake_;
  std::int64_t tiles_ = 0, asleep_ = 0;
};

}  // namespace voxmelt::run
