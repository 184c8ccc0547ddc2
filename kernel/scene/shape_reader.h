// Shapes of scene files are read here (docs/scenes.md). Lengths are in cells, y is up, and angles are in
// degrees.
#pragma once

#include <string>
#include <vector>

#include "kernel/scene/shape/shape.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

// Lists the names that read_shape understands.
const std::vector<std::string>& shape_names();

// Reads the keys of the shape `name` and of its placement (at, rotate, scale, mirror). The caller must call
// finish(). It throws InputError.
ShapePtr read_shape(Reader& reader, const std::string& name);

}  // namespace voxmelt::scene
