// The map of depth tells where the liquid lies. The curves over time do not.
#pragma once

#include <map>
#include <utility>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy::front {

inline constexpr int kSquareSide = 4;  // in cells of the scene's file

// Holds the liquid in the columns above each square of the ground, in cells of the scene's file. The key is
// the square's place along x and z.
using DepthMap = std::map<std::pair<int, int>, double>;

// `grid` is the number of cells per cell of the scene's file. Squares share a cell that lies on their border.
DepthMap map_of(const state::Volume& volume, double grid);

// Returns the part of the liquid that lies elsewhere: the sum of |found - reference|, over twice the
// reference's sum.
double part_elsewhere(const DepthMap& found, const DepthMap& reference);

}  // namespace voxmelt::accuracy::front
