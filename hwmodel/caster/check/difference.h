// A difference tells where the ray caster first departs from what is expected of it.
#pragma once

#include <cstdint>
#include <string>

#include "hwmodel/caster/model/ray.h"

namespace voxmelt::hwmodel::raycast {

struct Difference {
  std::string stage, name;
  std::int32_t x = 0, y = 0;  // pixel, or the first one of a tile
  int sample = 0;
  std::int64_t cycle = 0;
  std::string expected, actual;
  Vec position;  // sample or surface, in 2^-20 cells
  bool has_position = false;
  std::int64_t address = -1;  // line in memory, which belongs to no pixel
};
std::string text_of(const Difference& difference);

}  // namespace voxmelt::hwmodel::raycast
