// The cells of a region are visited one after another.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/source.h"
#include "kernel/automaton/state/grid.h"

namespace voxmelt::scalar {

// Calls visit(x, y, z) for the cells of the grid whose centre is in the region, x fastest.
template <class Visit>
void for_cells(const rule::Region& region, const state::Grid& g, Visit&& visit) {
  const auto first = [&](std::int64_t at) {
    return static_cast<int>(std::max<std::int64_t>(0, (at - region.radius) / rule::kPositionUnit - 1));
  };
  const auto last = [&](std::int64_t at, int size) {
    return static_cast<int>(std::min<std::int64_t>(size - 1, (at + region.radius) / rule::kPositionUnit + 1));
  };
  for (int z = first(region.at.z); z <= last(region.at.z, g.z); ++z)
    for (int y = first(region.at.y); y <= last(region.at.y, g.y); ++y)
      for (int x = first(region.at.x); x <= last(region.at.x, g.x); ++x)
        if (rule::contains(region, x, y, z)) visit(x, y, z);
}

}  // namespace voxmelt::scalar
