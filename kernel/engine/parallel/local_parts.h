// A cell that goes can part a piece only if what is left around it does not hold together.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/grid.h"

namespace voxmelt::parallel {

// Cells of the 3 x 3 x 3 around one have a bit each: x + 3 y + 9 z, each 0..2.
using Around = std::uint32_t;
inline constexpr Around kCentre = Around{1} << 13;
inline constexpr Around kFacesAround = 1u << 12 | 1u << 14 | 1u << 10 | 1u << 16 | 1u << 4 | 1u << 22;

// Adds the cells of the 3 x 3 x 3 that touch one of these through a face.
constexpr Around grown(Around set) {
  constexpr Around kAll = (1u << 27) - 1, kLow = 0x1249249, kHigh = kLow << 2;  // x = 0, x = 2
  Around low_y = 0;
  for (int z = 0; z < 3; ++z) low_y |= Around{7} << (9 * z);
  const Around high_y = low_y << 6;
  Around all = set | (set & ~kHigh) << 1 | (set & ~kLow) >> 1;
  all |= (set & ~high_y) << 3 | (set & ~low_y) >> 3;
  all |= set << 9 | set >> 9;
  return all & kAll;
}

// Tells if all that touched the centre still holds together, within these 26 cells. `held` are those of them
// that nothing can part: they count as connected with each other.
constexpr bool holds_together(Around solid, Around held) {
  const Around all = (solid | held) & ~kCentre, touching = all & kFacesAround;
  if (touching == 0) return true;
  Around reached = touching & -touching;
  for (;;) {
    Around more = grown(reached) & all;
    if ((more & held) != 0) more |= held & ~kCentre;
    if (more == reached) break;
    reached = more;
  }
  return (touching & ~reached) == 0;
}

// Tells the same of a cell of a grid that is no longer solid. Inert cells and what is below the grid are
// held.
inline bool is_locally_one(const state::BitPlane& solid, const state::BitPlane& inert, state::Grid grid,
                           int x, int y, int z) {
  Around solids = 0, held = 0, bit = 1;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx, bit <<= 1) {
        if (y + dy < 0) {
          held |= bit;
          continue;
        }
        if (!grid.contains(x + dx, y + dy, z + dz)) continue;
        if (solid.test(x + dx, y + dy, z + dz)) solids |= bit;
        if (inert.test(x + dx, y + dy, z + dz)) held |= bit;
      }
  return holds_together(solids, held);
}

}  // namespace voxmelt::parallel
