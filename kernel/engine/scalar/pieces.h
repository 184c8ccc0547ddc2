// Pieces fall in plain loops (docs/automaton.md, section 15).
#pragma once

#include <cstdint>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::scalar {

// Lets the loose pieces fall by a cell, as the first thing in a step. It tells if any has moved.
bool let_pieces_fall(const rule::Pieces& pieces, std::uint32_t step, state::Volume& volume);

}  // namespace voxmelt::scalar
