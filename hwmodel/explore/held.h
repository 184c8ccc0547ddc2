// The software tells what the memory holds in a run. On a DRAM this decides what moves.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "hwmodel/explore/content.h"
#include "hwmodel/explore/timing.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/automaton/step/stepper.h"

namespace voxmelt::hwmodel::explore {

class Held {
 public:
  // Runs the steps of `run` from `start`, by `software`. `poll` is called after each of them.
  Held(const TimedRun& run, const Design& design, const state::Volume& start,
       const step::Implementation& software, const std::function<void()>& poll);
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  // Makes the run ask this object from now on.
  void give_to(TimedRun& run) const;

 private:
  // `irradiance_` holds the irradiance from the first step, and from each step of visibility, on. With
  // hw.coded, `stored_` says which tokens are stored before each step, and after the last one.
  std::map<std::uint32_t, IrradianceStream> irradiance_;
  std::map<std::uint32_t, StoredTokens> stored_;
  std::map<std::uint32_t, FallStream> falls_;  // steps in which something falls
  std::vector<int> substeps_;                  // of each step
};

}  // namespace voxmelt::hwmodel::explore
