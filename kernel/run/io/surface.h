// The surface of the matter of a state as triangles, for formats of meshes.
//
// It separates the middles of cells that hold half a full cell or more, solid or liquid, from those that hold
// less. In between it lies where the amount, linear along a line of the lattice, passes a half. It is closed,
// also at the border of the grid, and every edge belongs to exactly two triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/run/io/export.h"

namespace voxmelt::io {

// Has the place of a point of the surface, in cells, and what the cell inside of it holds.
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
Surface surface_of(const state::Volume& volume, const Poll& poll);

}  // namespace voxmelt::io
