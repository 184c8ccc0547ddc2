// Meshes come from files of several formats. The ending of a file's name says which it is.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/scene/shape/mesh.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Tells if a file's name ends as those of meshes do.
bool is_mesh_file(const std::filesystem::path& file);
std::string mesh_endings();  // ".obj, .stl, ..."

// Reads a mesh. A name without an ending is that of an OBJ file. It throws InputError with `place` and the
// file, and with the line, the face or the key that is wrong. A file may be missing, truncated or without
// faces. Indices may be out of range, and coordinates may be no finite numbers.
Mesh read_mesh(const std::filesystem::path& file, const Place& place);

// Returns the faces of one part, and the vertices that they use. It throws InputError with `place` and the
// file, if no part has the name.
Mesh part_of(const Mesh& mesh, const std::string& name, const std::filesystem::path& file,
             const Place& place);

}  // namespace voxmelt::scene
