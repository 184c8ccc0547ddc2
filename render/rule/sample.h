// The field is interpolated between the cells (docs/picture/definition.md, section 6).
//
// A level is a filtered intensity less half of a full one. Matter has a level of 0 or more. The field is the
// trilinear interpolation of the levels. It never leaves the range of the eight levels around it.
#pragma once

#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

inline constexpr std::int32_t kHalfIntensity = 32640;  // half of 65280 = 255 x 256, a full cell
inline constexpr std::int32_t kAir =
    -kHalfIntensity;  // level of an empty cell, and of everything outside the grid

// Applies the pre-filter along one axis. It is the cubic B-spline 1 4 1 at a cell, in 256ths.
VOXMELT_RULE std::int32_t prefiltered(std::int32_t before, std::int32_t here, std::int32_t after) {
  return (43 * before + 170 * here + 43 * after + 128) >> 8;
}

inline constexpr int kWeightBits = 8;
inline constexpr std::int32_t kWeights = 1 << kWeightBits;

// Returns the fraction of a position, in 256ths.
VOXMELT_RULE std::int32_t weight_at(std::int64_t position) {
  return static_cast<std::int32_t>((position >> (kPositionBits - kWeightBits)) & (kWeights - 1));
}

// Holds the cell below a position, along an axis, and the weight of the cell above it, to the nearest 256th.
struct Place {
  std::int64_t cell = 0;
  std::int32_t weight = 0;
};

inline constexpr std::int64_t kToPlace = kCell / (2 * kWeights) - kCell / 2;

VOXMELT_RULE Place place_of(std::int64_t position) {
  const std::int64_t shifted = position + kToPlace;
  return {shifted >> kPositionBits, weight_at(shifted)};
}

// Tells where something between eight cells is looked up.
template <class Watch>
VOXMELT_RULE void tell_place(Watch watch, Stage stage, Vector position, Place x, Place y, Place z) {
  watch(stage, "position", position);
  watch(stage, "cell", Vector{x.cell, y.cell, z.cell});
  watch(stage, "weight", Vector{x.weight, y.weight, z.weight});
}

VOXMELT_RULE std::int32_t blended(std::int32_t below, std::int32_t above, std::int32_t weight) {
  return (below * (kWeights - weight) + above * weight + kWeights / 2) >> kWeightBits;
}

// Returns the level of the field at a position. levels(x, y, z) gives the level of any cell, and kAir outside
// the grid.
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

// These bound the box low <= position < high. Outside of it every sample is kAir.
VOXMELT_RULE Vector field_low() {
  const std::int64_t low = -kCell - kToPlace;
  return {low, low, low};
}
VOXMELT_RULE Vector field_high(Vector cells) {
  return {cells.x * kCell - kToPlace, cells.y * kCell - kToPlace, cells.z * kCell - kToPlace};
}

}  // namespace voxmelt::picture
