// The shells of a mesh are turned outward, each as a whole, so that rays through it count.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/scene/shape/mesh.h"

namespace voxmelt::scene {

// Mesh coordinates are integers: 1/32768 cell, vertices on multiples of 32.
inline constexpr std::int64_t kMeshUnit = 32768;
inline constexpr std::int64_t kMeshSnap = 32;

using FixedPoint = std::array<std::int64_t, 3>;
using Triangle = std::array<FixedPoint, 3>;

struct Surface {
  std::vector<FixedPoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Is true if every edge is run through as often in one direction as in the other. Then a ray enters as
  // often as it leaves, and any ray tells the winding number.
  bool closed = true;

  Triangle triangle(std::size_t i) const {
    return {points[triangles[i][0]], points[triangles[i][1]], points[triangles[i][2]]};
  }
};

// Makes the surface of a mesh. It appends a line to `findings` for each kind of oddity. The rules are in
// docs/scenes.md ("Meshes").
Surface surface_of(const Mesh& mesh, std::vector<std::string>& findings);

}  // namespace voxmelt::scene
