// NumPy arrays are read here: whole numbers and masks in three dimensions, as people write them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Returns the elements in the order z, y, x. They may have any width, sign and byte order, in C or Fortran
// order. It throws InputError with `place` and the file if one is outside 0..`largest`, or if type, shape
// (grid.z, grid.y, grid.x) or length are others.
std::vector<std::uint16_t> read_npy(const std::filesystem::path& file, std::uint32_t largest,
                                    state::Grid grid, const Place& place);

}  // namespace voxmelt::scene
