// The first difference between the ray caster and what is expected of it.
#pragma once

#include <cstdint>
#include <string>

#include "hwmodel/caster/model/ray.h"

namespace voxmelt::hwmodel::raycast {

struct Difference {
  std::string stage, name;
  std::int32_t x = 0, y = 0;  // of the pixel; of a tile, its first one
  int sample = 0;
  std::int64_t cycle = 0;
  std::string expected, actual;
  Vec position;  // of the sample or of the surface, in 2^-20 cells
  bool has_position = false;
  std::int64_t address = -1;  // of a line in memory, which belongs to no pixel
};
std::string text_of(const Difference& difference);

}  // namespace voxmelt::hwmodel::raycast
