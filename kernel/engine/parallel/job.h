// Every phase of a step gets a job.
#pragma once

#include <cstdint>

#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/engine/parallel/tiles.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::parallel {

// Returns what the kernels get to know of a moment.
simd::Step step_of(const rule::Parameters& parameters, step::Phase phase, step::Moment moment,
                   const std::uint32_t* keys, const step::Irradiance* irradiance);

struct Job {
  const simd::View& view;
  const simd::Step& step;
  const simd::Kernels& kernels;
  cpu::Workers& workers;
  bool sleep;          // false: every tile is awake in every phase
  bool ahead = false;  // spread follows at once, so gravity may be put off into it
};

}  // namespace voxmelt::parallel
