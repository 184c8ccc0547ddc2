// The books of a run, for the page: mass and heat by phase, and what the ledgers say.
#pragma once

#include <cstddef>
#include <string>

#include "voxmelt/voxmelt.h"

namespace voxmelt::view {

// Returns a line of JSON with the type "books". It takes a pass over the state. `kept` are the bytes of
// earlier states that are kept. Mass is in full cells, heat in full cells at the temperature 1.
std::string books_of(const Simulation& simulation, std::size_t kept);

}  // namespace voxmelt::view
