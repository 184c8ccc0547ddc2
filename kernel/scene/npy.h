// Reading NumPy arrays of format 1.0: three dimensions, C order, one unsigned type.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// The elements in the order z, y, x; `bytes` (1 or 2) each, little endian in the file.
// Throws InputError naming `place` and the file where type, shape (grid.z, grid.y, grid.x) or length differ.
std::vector<std::uint16_t> read_npy(const std::filesystem::path& file, int bytes, state::Grid grid,
                                    const Place& place);

}  // namespace voxmelt::scene
