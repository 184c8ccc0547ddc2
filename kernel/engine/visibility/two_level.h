// A two-level walk passes gaps of empty bricks at once, and goes from cell to cell elsewhere.
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "kernel/engine/visibility/brick_walk.h"
#include "kernel/engine/visibility/gaps.h"
#include "kernel/engine/visibility/opaque.h"

namespace voxmelt::visibility {

// Follows a walk that begins in the grid through at most `most` bricks and gaps. It returns the opaque cell
// that it meets, or kSees. With kSees, `ends` tells if it has come to its end, or out of the grid.
template <class Walk>
Fate follow(const Opaque& opaque, const Gaps& gaps, Walk& walk, int most, bool& ends) {
  const std::size_t octant = walk.octant();
  for (ends = false; most > 0 && !ends; --most) {
    const std::size_t brick = opaque.brick_at(walk.cell());
    const int gap = gaps.at(octant, brick);
    if (gap == Gaps::kEndless) {
      ends = true;
    } else if (gap > 0 || opaque.clear_ahead(brick, walk.cell(), octant)) {
      ends = !walk.leave(std::max(gap, 1));
    } else if (const Fate fate = meet_in_brick(opaque, brick, walk, ends); fate != kSees) {
      return fate;
    }
    // Any part of a brick beyond the grid is empty. So a ray may leave the grid there.
    const Cell& cell = walk.cell();
    ends |= !opaque.bricks().contains(cell[0] >> 3, cell[1] >> 3, cell[2] >> 3);
  }
  return kSees;
}

// Counts the bricks on the longest path. A straight ray never turns back, so each further brick on its way is
// the next one along an axis at least.
inline int longest_path(const state::Grid& bricks) { return bricks.x + bricks.y + bricks.z - 2; }

// Follows a walk to its end. Throws std::logic_error if it does not come on, and would go on for ever.
template <class Walk>
Fate follow_to_end(const Opaque& opaque, const Gaps& gaps, Walk& walk) {
  bool ends = false;
  const Fate fate = follow(opaque, gaps, walk, longest_path(opaque.bricks()), ends);
  if (fate == kSees && !ends) {
    const Cell& at = walk.cell();
    throw std::logic_error(
        "a ray of visibility does not come on: it met more bricks than lie on a line, at cell (" +
        std::to_string(at[0]) + ", " + std::to_string(at[1]) + ", " + std::to_string(at[2]) + ")");
  }
  return fate;
}

}  // namespace voxmelt::visibility
