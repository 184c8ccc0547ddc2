// The implementations of this program.
#pragma once

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::run {

// All that are linked, the reference first. Which one is fastest: kernel/run/trial/fastest.h.
const step::Registry& implementations();

}  // namespace voxmelt::run
