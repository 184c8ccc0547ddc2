// A scene is kept before and after a few steps. The volume goes from one state to the other as often as
// wanted, and tells its changes as the simulation told them.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "measure/workloads.h"

namespace voxmelt::measure {

class TwoStates {
 public:
  // Keeps the state after the workload's lead steps, and the one `steps` later.
  TwoStates(const Workload& workload, int steps);

  const state::Volume& before() { return take(before_), volume_; }
  const state::Volume& after() { return take(after_), volume_; }
  const state::Volume& now() const { return volume_; }

 private:
  struct Mark {
    state::ChangedBricks::Part part;
    std::size_t word;
    int by, bz;
  };
  void take(const state::Volume& from);

  state::Volume before_, after_, volume_;
  std::vector<Mark> marks_;
  bool all_ = false;  // set if the simulation does not know what changed
};

}  // namespace voxmelt::measure
