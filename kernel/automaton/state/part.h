// A part of a volume can be cut out, or cleared.
#pragma once

#include <array>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

// Names the cells with `from` <= cell < `from` + `size`, within the grid.
struct Box {
  std::array<int, 3> from{}, size{};
};

// Returns these cells alone, as a volume of their size.
Volume part_of(const Volume& volume, const Box& box);

// Sets every field of these cells to 0.
void clear(Volume& volume, const Box& box);

// Tells if any mask is set there.
bool holds_something(const Volume& volume, const Box& box);

}  // namespace voxmelt::state
