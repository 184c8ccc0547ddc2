// [start]: a volume read from the folder of an export instead of built from shapes.
#pragma once

#include <filesystem>

#include "kernel/automaton/state/volume.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Reads solid, liquid, inert (u8, 0 or 1), amount, energy, temperature (u16) from FOLDER/<field>.npy and
// checks what every volume promises (kernel/automaton/state/volume.h). Throws InputError naming `place`, the
// file and the first bad cell.
state::Volume read_fields(const std::filesystem::path& folder, state::Grid grid, const Place& place);

}  // namespace voxmelt::scene
