// Each format of meshes has a reader, which is given the whole file. `file` names it in messages.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "kernel/scene/shape/mesh.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

inline constexpr std::size_t kLargestMeshFile = std::size_t{1} << 30;  // bytes
inline constexpr double kLargestMeshNumber = 1e30;

// Tells if a number of a file can be a coordinate.
inline bool is_coordinate(double value) {
  return std::isfinite(value) && std::abs(value) <= kLargestMeshNumber;
}

// They throw InputError with `place`.
Mesh read_obj(std::string_view bytes, const std::string& file, const Place& place);
Mesh read_stl(std::string_view bytes, const std::string& file, const Place& place);
Mesh read_ply(std::string_view bytes, const std::string& file, const Place& place);
// Reads .gltf, which names further files beside it, and .glb.
Mesh read_gltf(std::string_view bytes, const std::string& file, const Place& place);

}  // namespace voxmelt::scene
