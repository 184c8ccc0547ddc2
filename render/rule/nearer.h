// A ray meets either matter or the ground first (docs/picture/definition.md, section 9).
#pragma once

#include <cstdint>

#include "render/rule/crossing.h"
#include "render/rule/ground.h"

namespace voxmelt::picture {

// Matter that is cut at a side of the grid lies in one plane with the slab's side. There the slab wins, by
// half a step, or by the same length if steps are halved.
inline constexpr std::int64_t kSideFirst = kPlaces / 2;

VOXMELT_RULE bool ground_first(const GroundCrossing& ground, const Crossing& matter, int halvings) {
  if (!ground.found || !matter.found) return ground.found;
  const std::int64_t matter_place = (matter.sample - 1) * kPlaces + matter.part;
  const std::int64_t first = ground.face == Face::top ? 0 : kSideFirst << halvings;
  return ground.part * (kPlaces / kParts) <= matter_place + first;
}

}  // namespace voxmelt::picture
