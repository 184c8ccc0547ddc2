// Snapshots are copies of a state that others hold for a while. One that nobody holds any more is filled
// anew: only pages that differ are copied then, and from step to step few do.
#pragma once

#include <memory>
#include <vector>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

class Snapshots {
 public:
  std::shared_ptr<state::Volume> of(const state::Volume& volume) {
    for (const std::shared_ptr<state::Volume>& one : held_)
      if (one.use_count() == 1) {
        *one = volume;
        return one;
      }
    return held_.emplace_back(std::make_shared<state::Volume>(volume));
  }

 private:
  std::vector<std::shared_ptr<state::Volume>> held_;
};

}  // namespace voxmelt::hwmodel
