// The grid is filled at the start by [[solid]], [[liquid]] and [[inert]], in the order of the file.
#pragma once

#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/grid.h"
#include "kernel/scene/shape/voxelise.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

// Reads them. It throws InputError. `warnings` grows by things that are odd but usable.
Contents read_contents(Reader& root, state::Grid grid, const rule::Material& material,
                       std::vector<std::string>& warnings);

}  // namespace voxmelt::scene
