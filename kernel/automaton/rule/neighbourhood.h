// The horizontal directions stand here in the order of the bits of a pattern byte, with the axes of heat
// conduction.
#pragma once

#include <array>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::rule {

struct Direction {
  int dx, dz;
};

// Bits 0..3 are the paper's nearest neighbours, 4..7 its second nearest ones (the diagonals).
inline constexpr std::array<Direction, 8> kDirections{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
inline constexpr std::array<int, 8> kOpposite{1, 0, 3, 2, 7, 6, 5, 4};

VOXMELT_RULE bool is_diagonal(int direction) { return direction >= 4; }

struct Offset {
  int dx, dy, dz;
};

// There is one axis per pair of opposite neighbours. It points from the first cell of a pair to the second.
inline constexpr std::array<Offset, 3> kFaceAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline constexpr std::array<Offset, 6> kEdgeAxes{
    {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}}};
inline constexpr std::array<Offset, 4> kCornerAxes{{{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}}};

}  // namespace voxmelt::rule
