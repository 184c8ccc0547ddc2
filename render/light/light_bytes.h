// Bytes of light, and of the matter that stops it, are plain data here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/rule/light_grid.h"

namespace voxmelt::render {

// Holds a byte per cell of light, x fastest.
struct LightPlane {
  picture::Vector count;
  std::vector<std::uint8_t> cells;

  LightPlane() = default;
  LightPlane(picture::Vector size, std::uint8_t fill) : count(size), cells(size.x * size.y * size.z, fill) {}
  std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return (z * count.y + y) * count.x + x;
  }
};

// Holds the matter that stops light and the matter that sends it.
struct LightMatter {
  LightPlane density, emission;  // emission is empty if nothing glows
};

// Holds bytes in the order of the ray caster, as two words of 64 bits.
struct LightBytes {
  std::uint8_t lamp = 255;
  std::array<std::uint8_t, picture::kSides> open{255, 255, 255, 255, 255, 255};
  std::uint8_t none = 0;
  std::array<std::uint8_t, picture::kSides> glow{};
  std::array<std::uint8_t, 2> nothing{};

  friend bool operator==(const LightBytes&, const LightBytes&) = default;
};
static_assert(sizeof(LightBytes) == 16);

}  // namespace voxmelt::render
