// Packets of rays read the ground as plain data (docs/picture/ground.md).
#pragma once

#include <array>
#include <cstdint>

#include "render/rule/fixed_point.h"

namespace voxmelt::render {

// Columns are repeated at the ends of a table of heights, along x and z. There are kGroundBefore before the
// first and kGroundBehind behind the last. So a place of the grid, or one half a cell away, can be
// interpolated.
inline constexpr std::int64_t kGroundBefore = 1, kGroundBehind = 2;

class GroundMap;

struct GroundData {
  bool any = false;
  bool flat = false;  // all bare columns are equal
  picture::Vector cells;
  std::int32_t row = 0;                 // heights from z to z + 1
  const std::int32_t* drawn = nullptr;  // from column (0, 0); these are the heights that rays meet
  const std::int32_t* bare = nullptr;   // for normals
  std::int32_t highest = 0;
  picture::Vector slopes;  // see GroundMap::slopes
  std::int32_t color[3] = {0, 0, 0};
  // One word holds red and green, and the next one blue and the bumps. It is null without texture.
  const std::uint32_t* texels = nullptr;
  int fineness = 0;
  const std::int32_t* bands = nullptr;
  std::int32_t band_count = 0;
  std::array<const std::int32_t*, 4> bends{};  // for low_x, high_x, low_z, high_z
  const GroundMap* map = nullptr;              // source of all of this
};

}  // namespace voxmelt::render
