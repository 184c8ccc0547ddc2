// A short run of every implementation: which one is the fastest on this processor?
#pragma once

#include <vector>

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::run {

struct TrialTime {
  const step::Implementation* implementation;
  double seconds;  // of this thread: for a dense volume and a thin one, the geometric mean
};

// Takes some 20 milliseconds for each implementation. A time is the least of several rounds, and every round
// times all of them. They run on one thread.
std::vector<TrialTime> trial(const std::vector<const step::Implementation*>& implementations);

}  // namespace voxmelt::run
