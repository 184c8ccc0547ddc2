// A driver of CUDA and a compiler whose card is this machine's processor: they run the kernels as C++. So the
// host of CUDA is tested without a card.
#pragma once

#include <string>
#include <vector>

#include "kernel/engine/gpu/cuda.h"

namespace voxmelt::gpu {

// It tells what shall happen, and what was seen. There is one card.
struct FakeCard {
  bool hangs = false;  // from now on it does not go on
  bool compiler_refuses = false;
  int memory_left = 1 << 30;              // pieces that it still gives
  int alive = 0;                          // things that were taken and not given back
  std::vector<std::string> options;       // of the last program
  std::string text;                       // of the last program
  std::vector<std::string> broken_rules;  // of the driver
};

// Begins anew with a card that works, and takes what was never given back.
FakeCard& new_fake_card();

// Both stay the same.
Cuda fake_cuda();

}  // namespace voxmelt::gpu
