// A volume of a scene file is read, and fills cells.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/shape/voxelise.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

// Reads the keys of a volume (docs/scenes.md) and its file. It throws InputError.
void read_volume_entry(Reader& reader, state::Grid grid, Entry& entry, std::vector<std::string>& warnings);

// Returns the size of what a volume fills by default, in the unit of its file. It throws InputError.
Point size_of_volume(const std::filesystem::path& file, const Place& place);

}  // namespace voxmelt::scene
