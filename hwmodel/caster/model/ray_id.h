// The name of a ray in a picture, and what may take it time.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel::raycast {

// A ray goes through sample `sample` of a pixel, whose bytes come together in a buffer of its tile.
struct RayId {
  std::int32_t x = 0, y = 0;
  std::int16_t sample = 0, buffer = 0;
  std::int32_t number = 0;  // of the ray in its pipe and pass, where rays are counted: no wire
};

// What a ray may do that takes time: steps of two kinds end, and words are asked for.
enum class Asked : std::uint8_t {
  look,
  ground_end,
  sample,
  walk_end,
  hit,  // the same, in matter
  crossing,
  normal,
  texel,
  matter,
  light
};

}  // namespace voxmelt::hwmodel::raycast
