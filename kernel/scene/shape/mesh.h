// Polygon meshes fill cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kernel/scene/shape/coverage.h"

namespace voxmelt::scene {

// Names the faces from one on, up to the next part.
struct MeshPart {
  std::string name;
  std::size_t first_face = 0;
};

struct Mesh {
  std::vector<Point> vertices;
  std::vector<std::uint32_t> corners;  // corners of face after face: indices of vertices, all in range
  std::vector<std::uint32_t> ends;     // for each face the corner behind its last; a face has at least 3
  std::size_t short_faces = 0;         // lines of the file that name fewer corners, and are no faces
  std::vector<MeshPart> parts;         // in the order of their faces; those before the first have no name

  std::size_t faces() const { return ends.size(); }
  std::span<const std::uint32_t> face(std::size_t i) const {
    const std::uint32_t first = i == 0 ? 0 : ends[i - 1];
    return {corners.data() + first, ends[i] - first};
  }
  Box bounds() const;  // box of the vertices that faces use
};

// Bounds the distance of vertices from the origin, in cells.
inline constexpr double kLargestMeshCoordinate = 16384;

// Tells which points are inside. With `winding`, the surface must wind around them at all, so that shells
// unite. With `parity`, a ray from outside must cross it an odd number of times, so that a shell within a
// shell is a hole.
enum class Inside { winding, parity };

struct EdgeLength {
  double all = 0;  // cells, within the grid; an edge of two faces counts twice
  // Parts beside which no cell has the samples that make it solid, or inert.
  double without_solid = 0, without_inert = 0;
};

struct MeshCoverage {
  Coverage coverage;
  EdgeLength edges;
  std::vector<std::string> findings;  // oddities of the mesh, a line for each kind
};

// Counts the samples inside, which are decided in integers (docs/scenes.md, "Meshes").
MeshCoverage cover(const Mesh& mesh, Inside inside, state::Grid grid);

}  // namespace voxmelt::scene
