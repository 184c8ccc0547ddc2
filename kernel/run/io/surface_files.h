// The surface of a state in the formats of meshes. Coordinates are those of scenes: cells, y up.
#pragma once

#include <filesystem>

#include "kernel/run/io/export.h"

namespace voxmelt::io {

// Each writes surface.NAME. All throw OutputError. Only PLY and GLB say what a vertex is made of.
void export_ply(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);
void export_stl(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);
void export_obj(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);
void export_glb(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);

}  // namespace voxmelt::io
