// Where the rays of one axis through all sample points of a window cross a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/scene/shape/mesh.h"

namespace voxmelt::scene {

// Mesh coordinates in integers: 1/32768 cell, vertices on multiples of 32.
inline constexpr std::int64_t kMeshUnit = 32768;
inline constexpr std::int64_t kMeshSnap = 32;
inline constexpr std::int64_t kSampleSpacing = kMeshUnit / kSamplesPerAxis;

// Samples are offset from the snapped vertices, differently on each axis. So a crossing is never a tie.
inline constexpr std::array<std::int64_t, 3> kSampleOffset{kSampleSpacing / 2 + 1, kSampleSpacing / 2 + 5,
                                                           kSampleSpacing / 2 + 11};

using FixedPoint = std::array<std::int64_t, 3>;

class MeshRays {
 public:
  static constexpr unsigned kOdd = 16;

  // Rays along `axis` (0 x, 1 y, 2 z); the other two axes follow cyclically as u and v.
  MeshRays(const std::vector<FixedPoint>& vertices, const Mesh& mesh, const Window& window, int axis);

  // Four samples along the axis from sample `first` (multiple of 4) on the ray (u, v), all counted from the
  // window's low corner: bit i is set where sample first + i is inside. kOdd is set where the ray crosses the
  // mesh an odd number of times, so that the mesh leaks there.
  unsigned inside(int u, int v, int first) const;

 private:
  template <class Visit>
  void rasterise(const std::vector<FixedPoint>& vertices, const Mesh& mesh, Visit visit) const;

  int axis_, u_axis_, v_axis_;
  std::array<std::int64_t, 3> low_;      // first sample of the window
  std::array<int, 3> count_;             // samples along each axis
  std::vector<std::uint32_t> start_;     // per ray: its first crossing
  std::vector<std::int32_t> crossings_;  // first sample at or after the crossing
};

}  // namespace voxmelt::scene
