// A part of a volume: cut out, or cleared.
#pragma once

#include <array>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

// Cells `from` <= cell < `from` + `size`, within the grid.
struct Box {
  std::array<int, 3> from{}, size{};
};

// These cells alone, as a volume of their size.
Volume part_of(const Volume& volume, const Box& box);

// Every field of these cells becomes 0.
void clear(Volume& volume, const Box& box);

// Is any mask set there?
bool holds_something(const Volume& volume, const Box& box);

}  // namespace voxmelt::state
