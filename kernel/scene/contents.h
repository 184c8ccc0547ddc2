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
// `materials` are the names of those that solids may be of.
Contents read_contents(Reader& root, state::Grid grid, const rule::Parameters& parameters,
                       const std::vector<std::string>& materials, std::vector<std::string>& warnings);

}  // namespace voxmelt::scene
