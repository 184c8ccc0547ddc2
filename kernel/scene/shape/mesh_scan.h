// The rays along one axis cross a triangle at places found here, exact in the plane across the rays, row by
// row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernel/scene/shape/mesh_shells.h"

namespace voxmelt::scene {

inline constexpr std::int64_t kSampleSpacing = kMeshUnit / kSamplesPerAxis;

// Samples are offset from the snapped vertices, differently on each axis. So a crossing is never a tie.
inline constexpr std::array<std::int64_t, 3> kSampleOffset{kSampleSpacing / 2 + 1, kSampleSpacing / 2 + 5,
                                                           kSampleSpacing / 2 + 11};

class RayCrossings {
 public:
  // Takes rays along `axis`, in rows across `row_axis` (v). The third axis is u.
  RayCrossings(const Triangle& triangle, int axis, int row_axis);
  RayCrossings(const Triangle& triangle, int axis) : RayCrossings(triangle, axis, (axis + 2) % 3) {}

  // Returns 1 if rays along the axis leave through the triangle, -1 if they enter, and 0 if it is edge-on to
  // them.
  int sign() const { return sign_; }
  std::pair<std::int64_t, std::int64_t> range_v() const;
  // Returns the first and last u that the triangle has in the row. With first > last there are none. Among
  // triangles that share an edge, exactly one has a point on it.
  std::pair<std::int64_t, std::int64_t> range_u(std::int64_t v) const;
  bool hits(std::int64_t u, std::int64_t v) const {
    const auto [first, last] = range_u(v);
    return first <= u && u <= last;
  }
  double depth(std::int64_t u, std::int64_t v) const { return Walk(*this, u, v).depth(); }

  // Walks the depths of samples side by side along u.
  class Walk {
   public:
    Walk(const RayCrossings& crossings, std::int64_t u, std::int64_t v);
    double depth() const {
      return (static_cast<double>(weight_[0]) * depth_[0] + static_cast<double>(weight_[1]) * depth_[1] +
              static_cast<double>(weight_[2]) * depth_[2]) /
             area_;
    }
    void next() {
      for (std::size_t i = 0; i < 3; ++i) weight_[i] += step_[i];
    }

   private:
    std::array<std::int64_t, 3> weight_, step_;
    std::array<double, 3> depth_;
    double area_;
  };

 private:
  struct Corner {
    std::int64_t u, v, depth;
  };
  std::array<Corner, 3> corners_;  // ordered such that the area is positive
  std::int64_t area_ = 0;          // twice the area
  int sign_ = 0;
};

}  // namespace voxmelt::scene
