// The implementations of this program are collected here.
#pragma once

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::run {

// Lists all that are linked, the reference first. kernel/run/trial/fastest.h finds the fastest.
const step::Registry& implementations();

}  // namespace voxmelt::run
