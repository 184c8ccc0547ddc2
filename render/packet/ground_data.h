// The ground as packets of rays read it, as plain data (docs/picture/ground.md).
#pragma once

#include <array>
#include <cstdint>

#include "render/rule/fixed_point.h"

namespace voxmelt::render {

// Heights of columns with kGroundBefore of them repeated before the first along x and z, and kGroundBehind
// behind the last: as far as a place of the grid, or one half a cell away, is interpolated.
inline constexpr std::int64_t kGroundBefore = 1, kGroundBehind = 2;

class GroundMap;

struct GroundData {
  bool any = false;
  bool flat = false;  // all bare columns are equal
  picture::Vector cells;
  std::int32_t row = 0;                 // heights from z to z + 1
  const std::int32_t* drawn = nullptr;  // of column (0, 0); these are what rays meet
  const std::int32_t* bare = nullptr;   // for normals
  std::int32_t highest = 0;
  picture::Vector slopes;  // see GroundMap::slopes
  std::int32_t color[3] = {0, 0, 0};
  // Red and green in one word; blue and the bumps in the next. Null without texture.
  const std::uint32_t* texels = nullptr;
  int fineness = 0;
  const std::int32_t* bands = nullptr;
  std::int32_t band_count = 0;
  std::array<const std::int32_t*, 4> bends{};  // of low_x, high_x, low_z, high_z
  const GroundMap* map = nullptr;              // from which all of this comes
};

}  // namespace voxmelt::render
