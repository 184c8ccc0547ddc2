// Light is kept in small volumes. They tell how much of the lamp, of the surroundings and of glowing liquid
// arrives at a place (docs/picture/light.md, sections 4 and 5).
//
// The grid of light is coarser than the grid of cells. Its values are bytes, swept slice by slice.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/normal.h"
#include "render/rule/sample.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

// Returns the shift of the grid of light. A cell of light is 2^shift cells wide.
VOXMELT_RULE int light_shift(Vector cells) {
  int shift = 1;
  while (cells.x * cells.y * cells.z > std::int64_t{1} << (19 + 3 * shift)) ++shift;
  return shift;
}
VOXMELT_RULE Vector light_cells(Vector cells) {
  const int shift = light_shift(cells);
  const auto count = [&](std::int64_t n) { return (n + (std::int64_t{1} << shift) - 1) >> shift; };
  return {count(cells.x), count(cells.y), count(cells.z)};
}

// Returns how much light is lost in a cell of light, 0 .. 256, from its density 0 .. 255. The least densities
// count as nothing, because they are the blurred fringe of the lit surface.
VOXMELT_RULE std::int32_t loss_of(std::int32_t density) { return std::clamp((density - 12) * 3 / 2, 0, 256); }

// Returns the part of the arrived light that leaves a cell.
VOXMELT_RULE std::int32_t passed(std::int32_t arrived, std::int32_t loss) {
  return (arrived * (256 - loss) + 128) >> 8;
}

// Holds the shift of a ray at a slice, in whole cells and a part of one. A sweep along the lamp's direction
// follows a lattice of rays through the slices, one for each cell of the first slice. At slice s a ray lies s
// slopes further along an axis.
struct Shift {
  std::int32_t cells = 0, part = 0;  // 0 <= part < 256
};

// Returns the shift at a slice. `slope` is the direction's component along the axis over that along the
// sweep, at most 1, in 2^14.
VOXMELT_RULE Shift shift_at(std::int64_t slice, std::int32_t slope) {
  const std::int64_t way = (slice * slope) >> (kNormalBits - 8);
  return {static_cast<std::int32_t>(way >> 8), static_cast<std::int32_t>(way & 255)};
}

// Softens rays a little along one axis, from slice to slice. So shadows soften with the distance from their
// cause.
VOXMELT_RULE std::int32_t softer(std::int32_t before, std::int32_t here, std::int32_t behind) {
  return (before + 30 * here + behind + 16) >> 5;
}

// Spreads light along one axis in a sweep along an axis of the grid, as a wide cone.
VOXMELT_RULE std::int32_t spread(const std::array<std::int32_t, 5>& from) {
  return (from[0] + 2 * (from[1] + from[2] + from[3]) + from[4] + 4) >> 3;
}

// Distant matter hides less, and glow from far away lights less.
VOXMELT_RULE std::int32_t opened(std::int32_t open) { return open + ((255 - open + 7) >> 3); }
VOXMELT_RULE std::int32_t faded(std::int32_t glow) { return glow - ((glow + 8) >> 4); }

// Returns the light that leaves a glowing cell of light.
VOXMELT_RULE std::int32_t glowing(std::int32_t arrived, std::int32_t loss, std::int32_t emission) {
  return std::min(passed(arrived, loss) + emission, 255);
}

// Light comes from six directions, which are +x, -x, +y, -y, +z and -z.
inline constexpr int kSides = 6;

struct Light {
  std::int32_t lamp = 255;
  std::array<std::int32_t, kSides> open{255, 255, 255, 255, 255, 255};
  std::array<std::int32_t, kSides> glow{};
};

VOXMELT_RULE Light between(const Light& a, const Light& b, std::int32_t weight) {
  Light light;
  light.lamp = blended(a.lamp, b.lamp, weight);
  for (std::size_t side = 0; side < kSides; ++side) {
    light.open[side] = blended(a.open[side], b.open[side], weight);
    light.glow[side] = blended(a.glow[side], b.glow[side], weight);
  }
  return light;
}

// Returns the light at a position, interpolated between eight cells of light. Those beyond the grid repeat
// the nearest. lights(x, y, z) gives the light of a cell of light.
template <class Lights, class Watch = Silent>
VOXMELT_RULE Light light_at(const Lights& lights, Vector count, int shift, Vector position,
                            Watch watch = {}) {
  const Vector p = position >> shift;
  const Place x = place_of(p.x), y = place_of(p.y), z = place_of(p.z);
  tell_place(watch, Stage::light, position, x, y, z);
  const auto at = [&](std::int64_t cx, std::int64_t cy, std::int64_t cz) -> Light {
    return lights(std::clamp<std::int64_t>(cx, 0, count.x - 1), std::clamp<std::int64_t>(cy, 0, count.y - 1),
                  std::clamp<std::int64_t>(cz, 0, count.z - 1));
  };
  const auto along_x = [&](std::int64_t cy, std::int64_t cz) {
    const Light below = at(x.cell, cy, cz), above = at(x.cell + 1, cy, cz);
    return between(below, above, x.weight);
  };
  const auto along_y = [&](std::int64_t cz) {
    const Light below = along_x(y.cell, cz), above = along_x(y.cell + 1, cz);
    return between(below, above, y.weight);
  };
  const Light below = along_y(z.cell), above = along_y(z.cell + 1);
  const Light light = between(below, above, z.weight);
  watch(Stage::light, "lamp", light.lamp);
  watch(Stage::light, "open", light.open);
  watch(Stage::light, "glow", light.glow);
  return light;
}

// Returns the place at which the light of a surface is read, one cell of light in front of it.
VOXMELT_RULE Vector before_surface(Vector position, Vector normal, int shift) {
  return position + normal * (std::int64_t{1} << (kPositionBits - kNormalBits + shift));
}

// Returns six values as seen along a unit vector. Each axis counts by the square of the component.
VOXMELT_RULE std::int32_t seen_along(const std::array<std::int32_t, kSides>& sides, Vector direction) {
  const auto part = [&](std::int64_t component, std::size_t axis) {
    const std::int64_t weight = (component * component) >> kNormalBits;
    return weight * sides[2 * axis + (component < 0 ? 1 : 0)];
  };
  const std::int64_t sum = part(direction.x, 0) + part(direction.y, 1) + part(direction.z, 2);
  return static_cast<std::int32_t>(std::min<std::int64_t>(sum >> kNormalBits, 255));
}

}  // namespace voxmelt::picture
