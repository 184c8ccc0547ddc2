// [start]: a volume read from the folder of an export instead of built from shapes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Reads every field (kernel/automaton/state/fields.h) from FOLDER/<field>.npy: masks as u8, 0 or 1, numbers
// as u8 or u16. An optional field may be missing. Checks the invariants of a volume
// (kernel/automaton/state/volume.h). Throws InputError naming `place`, the file and the first bad cell.
state::Volume read_fields(const std::filesystem::path& folder, state::Grid grid, const Place& place);

// The first cell that breaks an invariant of a volume, and which; empty where none does.
std::string first_broken(const state::Volume& volume);

// Is any inert cell an isothermal wall?
bool has_walls(const state::Volume& volume);

// The volume gets the optional fields of the scene, and what the scene does not have becomes 0: energy under
// the viscous law, heat without [heat]. Returns one line for each field that held something.
std::vector<std::string> fit_fields(state::Volume& volume, const rule::Parameters& parameters);

}  // namespace voxmelt::scene
