// How far above the ground a ray is, so that samples can be left out. No picture depends on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/rule/fixed_point.h"
#include "render/rule/heights.h"

namespace voxmelt::render {

// For tiles of 4, 16 and 64 columns a side: no less than the largest height over a tile and the eight around
// it. A position above it stays outside of the ground for as many cells as a tile has.
class GroundTiles {
 public:
  static constexpr std::array<int, 3> kSizeBits = {2, 4, 6};

  GroundTiles() = default;
  GroundTiles(picture::Vector cells, const std::vector<std::int32_t>& heights);

  std::int32_t highest() const { return highest_; }

  // As many samples behind `position`, which is outside of the ground but in the box around it, are outside
  // as well. The steps of the ray are within 2^-spacing cells.
  std::int64_t leap(picture::Vector position, std::int64_t step_up, int spacing) const;

  struct Level {
    std::int64_t x = 0, z = 0;
    std::vector<std::int32_t> highest;
  };
  const Level& level(std::size_t i) const { return levels_[i]; }

 private:
  std::array<Level, kSizeBits.size()> levels_;
  std::int32_t highest_ = 0;
};

}  // namespace voxmelt::render
