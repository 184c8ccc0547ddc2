// With [start], a volume is read from the folder of an export instead of built from shapes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Reads every field (kernel/automaton/state/fields.h) from FOLDER/<field>.npy: masks as u8, 0 or 1, numbers
// as u8 or u16. An optional field may be missing. It checks the invariants of a volume
// (kernel/automaton/state/volume.h). It throws InputError with `place`, the file and the first bad cell.
state::Volume read_fields(const std::filesystem::path& folder, state::Grid grid, const Place& place);

// Names the first cell that breaks an invariant of a volume, and the invariant. It is empty if none does.
// `materials` is how many the scene has, if that is known.
std::string first_broken(const state::Volume& volume, std::size_t materials = rule::kMostMaterials);

// Tells if any inert cell is an isothermal wall.
bool has_walls(const state::Volume& volume);

// Gives the volume the optional fields of the scene. Fields that the scene does not have become 0: energy
// under the viscous law, heat without [heat]. It returns one line for each such field that was not 0.
std::vector<std::string> fit_fields(state::Volume& volume, const rule::Parameters& parameters);

}  // namespace voxmelt::scene
