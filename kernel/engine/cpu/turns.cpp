#include "kernel/engine/cpu/turns.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace voxmelt::cpu {

void Turns::sort(int count) {
  const std::size_t size = count;
  if (times_.size() != size) {
    times_.assign(size, std::chrono::nanoseconds{0});
    order_.resize(size);
    std::iota(order_.begin(), order_.end(), 0);
  }
  std::stable_sort(order_.begin(), order_.end(), [this](int a, int b) { return times_[a] < times_[b]; });
}

}  // namespace voxmelt::cpu
