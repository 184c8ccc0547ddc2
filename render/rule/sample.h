// The field between the cells (docs/picture/definition.md, section 6).
//
// A level is a filtered intensity less half of a full one: 0 or more is matter. The field is the trilinear
// interpolation of the levels. It never leaves the range of the eight levels around it.
#pragma once

#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

inline constexpr std::int32_t kHalfIntensity = 32640;  // of 65280 = 255 x 256, a full cell
inline constexpr std::int32_t kAir =
    -kHalfIntensity;  // the level of an empty cell, and of all outside the grid

// One axis of the pre-filter: the cubic B-spline at a cell, 1 4 1, in 256ths.
VOXMELT_RULE std::int32_t prefiltered(std::int32_t before, std::int32_t here, std::int32_t after) {
  return (43 * before + 170 * here + 43 * after + 128) >> 8;
}

inline constexpr int kWeightBits = 8;
inline constexpr std::int32_t kWeights = 1 << kWeightBits;

// Along an axis: the cell below a position, and the weight of the cell above it, to the nearest 256th.
struct Place {
  std::int64_t cell = 0;
  std::int32_t weight = 0;
};

inline constexpr std::int64_t kToPlace = kCell / (2 * kWeights) - kCell / 2;

VOXMELT_RULE Place place_of(std::int64_t position) {
  const std::int64_t shifted = position + kToPlace;
  return {shifted >> kPositionBits,
          static_cast<std::int32_t>((shifted >> (kPositionBits - kWeightBits)) & (kWeights - 1))};
}

// Says where something between eight cells is looked up.
template <class Watch>
VOXMELT_RULE void tell_place(Watch watch, Stage stage, Vector position, Place x, Place y, Place z) {
  watch(stage, "position", position);
  watch(stage, "cell", Vector{x.cell, y.cell, z.cell});
  watch(stage, "weight", Vector{x.weight, y.weight, z.weight});
}

VOXMELT_RULE std::int32_t blended(std::int32_t below, std::int32_t above, std::int32_t weight) {
  return (below * (kWeights - weight) + above * weight + kWeights / 2) >> kWeightBits;
}

// levels(x, y, z) gives the level of any cell, kAir outside the grid.
template <class Levels, class Watch = Silent>
VOXMELT_RULE std::int32_t sample(const Levels& levels, Vector position, Watch watch = {}) {
  const Place x = place_of(position.x), y = place_of(position.y), z = place_of(position.z);
  tell_place(watch, Stage::sample, position, x, y, z);
  const auto along_x = [&](std::int64_t cy, std::int64_t cz) {
    const std::int32_t below = levels(x.cell, cy, cz), above = levels(x.cell + 1, cy, cz);
    const std::int32_t level = blended(below, above, x.weight);
    watch(Stage::sample, "along x", level);
    return level;
  };
  const auto along_y = [&](std::int64_t cz) {
    const std::int32_t below = along_x(y.cell, cz), above = along_x(y.cell + 1, cz);
    const std::int32_t level = blended(below, above, y.weight);
    watch(Stage::sample, "along y", level);
    return level;
  };
  const std::int32_t below = along_y(z.cell), above = along_y(z.cell + 1);
  const std::int32_t level = blended(below, above, z.weight);
  watch(Stage::sample, "level", level);
  return level;
}

// The box outside of which every sample is kAir: low <= position < high.
VOXMELT_RULE Vector field_low() {
  const std::int64_t low = -kCell - kToPlace;
  return {low, low, low};
}
VOXMELT_RULE Vector field_high(Vector cells) {
  return {cells.x * kCell - kToPlace, cells.y * kCell - kToPlace, cells.z * kCell - kToPlace};
}

}  // namespace voxmelt::picture
