// The functions here say how far a shape is from a round one, or a front from a straight one, below the size
// of a cell. None of their answers depends on how the shape lies to the grid.
#pragma once

#include <functional>

#include "accuracy/measure.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy {

// Holds the radius over the angle about the middle of the grid as a Fourier series. c4 and c8 are the
// amplitudes of cos 4 phi and cos 8 phi over the mean radius, and `rest` is the rms of what neither explains,
// in cells. For a circle all three are 0.
struct Outline {
  double mean = 0, c4 = 0, c8 = 0, rest = 0;
};

// Finds the outermost place on each ray where the depth, linear between the columns' middles, falls below
// `depth`.
Outline outline_of(const Columns& columns, double depth);

// Holds how far matter reaches along the grid's axes, the diagonals of its faces and those of its space, over
// the radius of a ball of the same volume. Each is the mean over a cone of 15 degrees, from the volume in it.
struct Extents {
  double radius = 0, axes = 0, faces = 0, spaces = 0;
};

// `part` says how much of a cell is matter, 0 to 1. The cell counts as evenly full.
Extents extents_of(state::Grid grid, const std::function<double(int x, int y, int z)>& part);

// Holds a front that moves along a direction: its mean place from the middle of the grid, and the rms
// deviation from the straight line across the direction, both in cells.
struct Front {
  double place = 0, roughness = 0;
};

// Looks at rays along (cos angle, sin angle) in x and z, up to `half_width` from the middle, for the
// outermost place as outline_of does.
Front front_of(const Columns& columns, double angle, double half_width, double depth);

}  // namespace voxmelt::accuracy
