// The matter of a cell is described by bytes (docs/picture/light.md, section 3).
#pragma once

#include <algorithm>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/look.h"
#include "render/rule/sample.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

struct Matter {
  std::int32_t liquid = 0;    // share of the liquid in the matter, 0 .. 255
  std::int32_t heat = 0;      // heat of glowing liquid, or tone of solids of several colours, 0 .. 255
  std::int32_t obstacle = 0;  // share of obstacles in all, 0 .. 255
};

// Computes the shares from the filtered intensities of a cell. An empty cell has no shares.
VOXMELT_RULE Matter matter_of(std::int32_t solid, std::int32_t liquid, std::int32_t heat,
                              std::int32_t obstacle, const Look& look) {
  Matter result;
  const std::int32_t matter = solid + liquid, all = matter + obstacle;
  if (matter > 0) result.liquid = liquid * 255 / matter;
  if (all > 0) result.obstacle = obstacle * 255 / all;
  if (look.glow && liquid > 0) {
    const std::int32_t temperature = std::min(heat * 256 / liquid, 256) * 256;
    const std::int32_t range = std::max(look.glow_hot - look.glow_cold, 1);
    result.heat = static_cast<std::int32_t>(
        std::clamp<std::int64_t>(std::int64_t{temperature - look.glow_cold} * 255 / range, 0, 255));
  }
  if (look.tinted() && solid > 0) result.heat = std::min(heat * 256 / solid, 255);
  return result;
}

// Returns the light that a cell sends out, 0 .. 253, by its filtered liquid and its heat.
VOXMELT_RULE std::int32_t emission_of(std::int32_t liquid, std::int32_t heat) {
  return (liquid * ((heat * heat) >> 8)) >> 16;
}

// Returns the position at which bytes are read, along an axis. Outside the outermost centres of cells there
// is nothing to blend with. So a face cut by a side of the grid has the colour of the cells behind it.
VOXMELT_RULE std::int64_t among_centers(std::int64_t position, std::int64_t cells) {
  return std::clamp(position, kCell / 2, cells * kCell - kCell / 2);
}

// Interpolates the bytes between eight cells, like levels. `cells` is the size of the grid, and matter(x, y,
// z) gives the matter of a cell.
template <class Cells, class Watch = Silent>
VOXMELT_RULE Matter matter_at(const Cells& matter, Vector cells, Vector position, Watch watch = {}) {
  const Vector inside{among_centers(position.x, cells.x), among_centers(position.y, cells.y),
                      among_centers(position.z, cells.z)};
  const Place x = place_of(inside.x), y = place_of(inside.y), z = place_of(inside.z);
  tell_place(watch, Stage::matter, inside, x, y, z);
  const auto both = [](Matter a, Matter b, std::int32_t w) {
    return Matter{blended(a.liquid, b.liquid, w), blended(a.heat, b.heat, w),
                  blended(a.obstacle, b.obstacle, w)};
  };
  const auto along_x = [&](std::int64_t cy, std::int64_t cz) {
    const Matter below = matter(x.cell, cy, cz), above = matter(x.cell + 1, cy, cz);
    return both(below, above, x.weight);
  };
  const auto along_y = [&](std::int64_t cz) {
    const Matter below = along_x(y.cell, cz), above = along_x(y.cell + 1, cz);
    return both(below, above, y.weight);
  };
  const Matter below = along_y(z.cell), above = along_y(z.cell + 1);
  const Matter result = both(below, above, z.weight);
  watch(Stage::matter, "liquid", result.liquid);
  watch(Stage::matter, "heat", result.heat);
  watch(Stage::matter, "obstacle", result.obstacle);
  return result;
}

}  // namespace voxmelt::picture
