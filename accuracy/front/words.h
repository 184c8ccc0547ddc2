// The functions here put the front in words: they say which setting to take for which error.
#pragma once

#include <string>
#include <vector>

#include "accuracy/front/sweep.h"

namespace voxmelt::accuracy::front {

inline constexpr double kBounds[] = {0.01, 0.001};

struct Pick {
  std::string bound;                // "1 %", "0.1 %", "best"
  const Measured* point = nullptr;  // null if no point keeps the bound
};

std::vector<Pick> picks_of_settings(const Swept& swept);  // the fastest run whose whole error keeps the bound
std::vector<Pick> picks_of_formats(const Swept& swept);   // the fewest bits whose arithmetic error keeps it

// Returns the settings that are both faster and better than the usual one: at most three, the fastest first.
std::vector<const Measured*> faster_and_better(const Swept& swept);

}  // namespace voxmelt::accuracy::front
