// NumPy arrays of format 1.0 are read here: three dimensions, C order, one unsigned type.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Returns the elements in the order z, y, x, with `bytes` (1 or 2) each, little endian in the file. It throws
// InputError with `place` and the file if type, shape (grid.z, grid.y, grid.x) or length differ.
std::vector<std::uint16_t> read_npy(const std::filesystem::path& file, int bytes, state::Grid grid,
                                    const Place& place);

}  // namespace voxmelt::scene
