// The implementations of this program are collected here.
#pragma once

#include <string>

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::run {

// Lists all that are linked, the reference first. kernel/run/trial/fastest.h finds the fastest.
const step::Registry& implementations();

// Lists the devices of this machine: gpu:0, gpu:cuda and so on. They run whole steps, and no single phase.
// The first call looks for their drivers, which may take a moment.
const step::Registry& devices();

// Returns what this machine lacks for devices of CUDA, or nothing.
std::string missing_for_cuda();

}  // namespace voxmelt::run
