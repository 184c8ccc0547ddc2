// A ray of a picture is named by its pixel, its sample, and a buffer.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel::raycast {

// A ray goes through sample `sample` of a pixel, whose bytes come together in a buffer of its tile.
struct RayId {
  std::int32_t x = 0, y = 0;
  std::int32_t sample = 0, buffer = 0;
};

}  // namespace voxmelt::hwmodel::raycast
