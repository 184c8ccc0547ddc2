// [start]: a volume read from the folder of an export instead of built from shapes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Reads solid, liquid, inert (u8, 0 or 1), amount, energy, heat (u16) from FOLDER/<field>.npy and checks the
// invariants of a volume (kernel/automaton/state/volume.h). Throws InputError naming `place`, the file and
// the first bad cell.
state::Volume read_fields(const std::filesystem::path& folder, state::Grid grid, const Place& place);

// The first cell that breaks an invariant of a volume, and which; empty where none does.
std::string first_broken(const state::Volume& volume);

// Is any inert cell an isothermal wall?
bool has_walls(const state::Volume& volume);

// Clears the fields that the scene does not model: energy under the viscous law, heat without [heat]. Returns
// one line for each field that held something.
std::vector<std::string> drop_unused(state::Volume& volume, const rule::Parameters& parameters);

}  // namespace voxmelt::scene
