// Shapes as a scene file writes them (docs: README, "Scene"). Lengths in cells, y up, angles in degrees.
#pragma once

#include <string>
#include <vector>

#include "kernel/scene/shape/shape.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

// The names that read_shape understands.
const std::vector<std::string>& shape_names();

// Reads the keys of the shape `name` and of its placement (at, rotate, scale, mirror). Leaves finish() to the
// caller. Throws InputError.
ShapePtr read_shape(Reader& reader, const std::string& name);

}  // namespace voxmelt::scene
