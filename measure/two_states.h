// A scene before and after a few steps: a volume that goes from one to the other as often as wanted, and
// tells its changes as the simulation told them.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "measure/workloads.h"

namespace voxmelt::measure {

class TwoStates {
 public:
  // `steps` after the workload's lead steps.
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
  bool all_ = false;  // nobody told what changed
};

}  // namespace voxmelt::measure
