// Pieces of solid that nothing holds fall (docs/automaton.md, section 15).
#pragma once

#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

inline constexpr std::int32_t kWet = kOne / 2;  // a cell with this amount carries, and counts as liquid

// Counts cells of a loose piece.
struct PieceCounts {
  std::int64_t cells = 0;
  std::int64_t feet = 0, wet = 0;  // cells that stand on no cell of the piece; those of them on liquid
  std::int64_t sunk = 0;           // cells of the layers under the surface
};

// A layer has faces to its sides that look at open cells, and some of them at liquid.
VOXMELT_RULE bool is_under_surface(std::int64_t open, std::int64_t full) {
  return open > 0 && 2 * full >= open;
}

// Tells if a loose piece moves down by a cell in this step.
VOXMELT_RULE bool piece_moves(const PieceCounts& piece, const Pieces& pieces, std::uint32_t step) {
  if (2 * piece.wet < piece.feet) return true;
  const bool floats =
      pieces.density < kDensityOne && kDensityOne * piece.sunk >= pieces.density * piece.cells;
  return step % static_cast<std::uint32_t>(pieces.in_liquid) == 0 && !floats;
}

}  // namespace voxmelt::rule
