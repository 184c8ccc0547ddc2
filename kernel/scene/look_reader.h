// [camera], [light] and [look] are read here. All functions throw InputError.
#pragma once

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/look.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

Camera read_camera(Reader& root, state::Grid grid);  // distance 0 lets the renderer fit the grid
Light read_light(Reader& root);
Look read_look(Reader& root);
// Reads [r, g, b] in linear light, or "#rrggbb" as painting programs write it.
Vec3 read_color(Reader& reader, const char* key, const Vec3& fallback);

}  // namespace voxmelt::scene
