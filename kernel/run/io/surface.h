// The surface of the matter of a state as triangles, for formats of meshes.
//
// It separates the middles of cells within it from the others: those that hold half a full cell or more,
// solid or liquid, or as a lattice of numbers says (export.h). In between it lies where the number, linear
// along a line of the cells' middles, passes `inside`. Where matter meets what is inert, and at the border of
// the grid, it lies half way. It is closed, and every edge belongs to exactly two triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/run/io/export.h"

namespace voxmelt::io {

// Has the place of a point of the surface, in cells, and what the cell inside of it holds, or else the
// nearest one beside that which holds matter.
struct SurfaceVertex {
  std::array<float, 3> at{};
  std::uint16_t heat = 0;     // heat content
  std::uint8_t material = 0;  // number of a solid's material
  std::uint8_t liquid = 0;    // 1 or 0
  friend bool operator==(const SurfaceVertex&, const SurfaceVertex&) = default;
};

struct Surface {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise, seen from outside
};

// Throws std::length_error where 32 bits do not count its vertices.
Surface surface_of(const Moment& moment, const Poll& poll);

}  // namespace voxmelt::io
