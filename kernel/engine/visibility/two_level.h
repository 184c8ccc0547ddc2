// A two-level walk passes gaps of empty bricks at once, and goes from cell to cell elsewhere.
#pragma once

#include <algorithm>
#include <cstddef>

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

}  // namespace voxmelt::visibility
