// Polygon meshes from Wavefront OBJ files, and which cells they fill.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "kernel/scene/shape/coverage.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

struct Mesh {
  std::vector<Point> vertices;
  std::vector<std::uint32_t> corners;  // of all faces, one after the other: indices of vertices, all in range
  std::vector<std::uint32_t> ends;     // of each face: the corner behind its last; a face has at least 3

  std::size_t faces() const { return ends.size(); }
  std::span<const std::uint32_t> face(std::size_t i) const {
    const std::uint32_t first = i == 0 ? 0 : ends[i - 1];
    return {corners.data() + first, ends[i] - first};
  }
  Box bounds() const;  // of the vertices that faces use
};

// Throws InputError naming `place` and the file (with its line): missing, truncated, without faces, indices
// out of range, coordinates that are not finite numbers.
Mesh read_mesh(const std::filesystem::path& file, const Place& place);

// Vertices must stay within this many cells of the origin.
inline constexpr double kLargestMeshCoordinate = 16384;

// What is inside: where the surface winds around at all, so that shells unite; or where a ray from outside
// crosses it an odd number of times, so that a shell within a shell is a hole.
enum class Inside { winding, parity };

struct MeshCoverage {
  Coverage coverage;
  std::vector<std::string> findings;  // what is odd about the mesh, a line for each kind
};

// Samples are decided in integers, as docs/scenes.md says ("Meshes").
MeshCoverage cover(const Mesh& mesh, Inside inside, state::Grid grid);

}  // namespace voxmelt::scene
