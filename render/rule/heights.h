// The ground's heights are given by columns and interpolated to any place (docs/picture/ground.md, sections 1
// and 2).
//
// A height is in 1 / kHeight of a cell, at the middle of its column. Outside the grid the nearest column
// repeats itself.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/sample.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

inline constexpr int kHeightBits = 12;
inline constexpr std::int32_t kHeight = 1 << kHeightBits;

// Filters along one axis, in a pass of the low-pass filter.
VOXMELT_RULE std::int32_t softened(std::int32_t before, std::int32_t here, std::int32_t after) {
  return (before + 2 * here + after + 2) >> 2;
}

// Returns the lowered height of a column. Under matter it is lower by half a cell, or its ground would stick
// out of a thin film. `wetness` is 0 .. kHeight.
VOXMELT_RULE std::int32_t lowered(std::int32_t height, std::int32_t wetness) {
  return height - ((wetness + 1) >> 1);
}

// Returns the bilinear interpolation of a table of columns x rows at two places. at(x, z) gives an entry.
template <class At>
VOXMELT_RULE std::int32_t bilinear(const At& at, std::int64_t columns, std::int64_t rows, Place x, Place z) {
  const auto within = [](std::int64_t i, std::int64_t count) {
    return std::clamp<std::int64_t>(i, 0, count - 1);
  };
  const std::int64_t left = within(x.cell, columns), right = within(x.cell + 1, columns);
  const std::int64_t back = within(z.cell, rows), front = within(z.cell + 1, rows);
  const std::int32_t left_back = at(left, back), right_back = at(right, back);
  const std::int32_t left_front = at(left, front), right_front = at(right, front);
  return blended(blended(left_back, right_back, x.weight), blended(left_front, right_front, x.weight),
                 z.weight);
}

// Returns the height of the ground at a place. heights(x, z) gives the height of a column of the grid.
template <class Heights, class Watch = Silent>
VOXMELT_RULE std::int32_t height_at(const Heights& heights, Vector cells, std::int64_t x, std::int64_t z,
                                    Watch watch = {}, Stage stage = Stage::ground) {
  const Place along_x = place_of(x), along_z = place_of(z);
  watch(stage, "cell", std::array{along_x.cell, along_z.cell});
  watch(stage, "weight", std::array{along_x.weight, along_z.weight});
  const std::int32_t height = bilinear(heights, cells.x, cells.z, along_x, along_z);
  watch(stage, "height", height);
  return height;
}

}  // namespace voxmelt::picture
