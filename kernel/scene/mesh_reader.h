// A mesh of a scene file is read and set down in the grid.
#pragma once

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/shape/voxelise.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

// Reads the keys of a mesh (docs/scenes.md) and its file. It throws InputError.
void read_mesh_entry(Reader& reader, state::Grid grid, Entry& entry);

}  // namespace voxmelt::scene
