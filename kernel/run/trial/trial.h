// A short trial of every implementation shows which one is the fastest on this processor.
#pragma once

#include <vector>

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::run {

struct TrialTime {
  const step::Implementation* implementation;
  double seconds;  // time of this thread: the geometric mean of a dense volume and a thin one
};

// Times every implementation, which takes some 20 milliseconds each. A time is the least of several rounds,
// and every round times all of them. They run on one thread.
std::vector<TrialTime> trial(const std::vector<const step::Implementation*>& implementations);

// Times whole steps by the clock, of volumes as large as the scenes that come with the program, and one fetch
// of the state after them. Processors take all their threads. A device that fails has no time.
std::vector<TrialTime> trial_of_steps(const std::vector<const step::Implementation*>& implementations);

}  // namespace voxmelt::run
