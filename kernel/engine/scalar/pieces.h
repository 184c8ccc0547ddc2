// Pieces fall in plain loops (docs/automaton.md, section 15).
#pragma once

#include <cstdint>
#include <optional>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::scalar {

// Returns the cells that move down in this step, if any does. `volume` is the state at its begin.
std::optional<state::BitPlane> falling_cells(const rule::Pieces& pieces, std::uint32_t step,
                                             const state::Volume& volume);

// Counts the cells of all loose pieces, whether they move or not.
std::int64_t loose_cells(const state::Volume& volume);

// Lets the loose pieces fall by a cell, as the first thing in a step. It tells if any has moved.
bool let_pieces_fall(const rule::Pieces& pieces, std::uint32_t step, state::Volume& volume);

}  // namespace voxmelt::scalar
