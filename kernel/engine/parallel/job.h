// What every phase of a step gets.
#pragma once

#include "kernel/engine/cpu/workers.h"
#include "kernel/engine/parallel/tiles.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::parallel {

struct Job {
  const simd::View& view;
  const simd::Step& step;
  const simd::Kernels& kernels;
  cpu::Workers& workers;
  bool sleep;  // false: every tile is awake in every phase
};

}  // namespace voxmelt::parallel
