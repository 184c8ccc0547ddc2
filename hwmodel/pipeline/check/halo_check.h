// The halo of a tile must hold every cell on which a cell that the tile owns depends. A narrower one may
// give the right bits for a long time, so nobody compares bits here. How far a step depends on other cells is
// written from docs/automaton.md, and not from what the stages say that they reach.
#pragma once

#include <memory>

#include "hwmodel/pipeline/check/mismatch.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

// Counts the cells along x on which a cell behind one step depends, on either side of it.
int dependence_of_step(const Design& design);

// Returns the first cell that a tile owns and whose halo does not suffice for so many steps, or null.
std::unique_ptr<Mismatch> narrow_halo(const Design& design, int steps);

}  // namespace voxmelt::hwmodel
