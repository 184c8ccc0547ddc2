// Triangle meshes from Wavefront OBJ files, and which cells they fill.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "kernel/scene/shape/coverage.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

struct Mesh {
  std::vector<Point> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of vertices, all in range

  Box bounds() const;  // of the vertices that triangles use
};

// Throws InputError naming `place` and the file (with its line): missing, truncated, without faces, indices
// out of range, coordinates that are not finite numbers.
Mesh read_mesh(const std::filesystem::path& file, const Place& place);

// Vertices must stay within this many cells of the origin.
inline constexpr double kLargestMeshCoordinate = 16384;

struct MeshCoverage {
  Coverage coverage;
  // Columns along y of the window: their number, and the number of those where the mesh leaks. It leaks where
  // rays along x, y and z disagree, or where one crosses the mesh an odd number of times.
  std::int64_t columns = 0, disagreeing = 0;
};

// A sample is inside if the parity of crossings along at least two of three axes says so. With a closed mesh
// the axes never disagree. The reason is that vertices are snapped to 1/1024 cell, and crossings are decided
// in integers with one owner for each shared edge.
MeshCoverage cover(const Mesh& mesh, state::Grid grid);

}  // namespace voxmelt::scene
