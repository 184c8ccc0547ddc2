// The test tells if a heat that is wrong inside the phase is sure to be wrong at its end.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/pipeline/model/heat_word.h"

namespace voxmelt::hwmodel {

// The exchange follows conduction and convection. Radiation adds at most 4096 to a solid and saturates. Air
// can make two heats equal.
inline bool survives_exchange(const rule::Heat& heat, const HeatWord& word, std::int64_t right,
                              std::int64_t wrong) {
  if (heat.air && word.exposed > 0) return false;
  return !heat.radiation || word.liquid() || std::max(right, wrong) <= kHeatMax - 4096;
}

}  // namespace voxmelt::hwmodel
