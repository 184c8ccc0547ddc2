// The ground is computed in double, with a dense march along a ray through it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "render/rule/fixed_point.h"
#include "render/rule/ground.h"
#include "render/rule/heights.h"
#include "render/rule/ray.h"

namespace voxmelt::test {

inline double in_cells(std::int64_t position) { return std::ldexp(static_cast<double>(position), -20); }

// Returns how far a place is outside of the ground. Below 0 it lies that deep. Weights are exact.
template <class Heights>
class DenseGround {
 public:
  DenseGround(const Heights& heights, picture::Vector cells) : heights_(heights), cells_(cells) {}

  double outside(double x, double y, double z) const {
    const double beside =
        std::max({-x, x - static_cast<double>(cells_.x), -y, -z, z - static_cast<double>(cells_.z)});
    return beside > 0 ? beside : std::max(beside, y - height(x, z));
  }
  // Takes sample k of a ray, or a place between two.
  double outside(const picture::Ray& ray, double k) const {
    return outside(in_cells(ray.start.x) + k * in_cells(ray.step.x),
                   in_cells(ray.start.y) + k * in_cells(ray.step.y),
                   in_cells(ray.start.z) + k * in_cells(ray.step.z));
  }

  // Returns the longest run of a ray before `until` that is deeper than `depth`, in its steps. It looks 16
  // times a step.
  double longest_run(const picture::Ray& ray, double until, double depth) const {
    double from = 0, to = until;
    for (const auto& [start, step, side] :
         {std::array{ray.start.x, ray.step.x, cells_.x}, std::array{ray.start.y, ray.step.y, cells_.y},
          std::array{ray.start.z, ray.step.z, cells_.z}}) {
      if (step == 0) continue;
      const double a = -static_cast<double>(start) / static_cast<double>(step),
                   b = static_cast<double>(side * picture::kCell - start) / static_cast<double>(step);
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    double run = 0, longest = 0;
    for (double k = from; k < to; k += 1.0 / 16) {
      run = outside(ray, k) < -depth ? run + 1.0 / 16 : 0;
      longest = std::max(longest, run);
    }
    return longest;
  }

 private:
  double height(double x, double z) const {
    const double cx = std::floor(x - 0.5), cz = std::floor(z - 0.5), wx = x - 0.5 - cx, wz = z - 0.5 - cz;
    return (at(cx, cz) * (1 - wx) + at(cx + 1, cz) * wx) * (1 - wz) +
           (at(cx, cz + 1) * (1 - wx) + at(cx + 1, cz + 1) * wx) * wz;
  }
  double at(double x, double z) const {
    return heights_(std::clamp<std::int64_t>(static_cast<std::int64_t>(x), 0, cells_.x - 1),
                    std::clamp<std::int64_t>(static_cast<std::int64_t>(z), 0, cells_.z - 1)) /
           static_cast<double>(picture::kHeight);
  }

  const Heights& heights_;
  picture::Vector cells_;
};

// Returns the fault of the crossing that a ray was given, or nothing. Ground less deep than `depth` does not
// count, and a ray may miss ground that it passes within one step.
template <class Heights>
const char* fault_of(const DenseGround<Heights>& ground, const picture::Ray& ray,
                     const picture::GroundCrossing& got, double depth) {
  const double found = static_cast<double>(got.part) / 256;
  if (ground.longest_run(ray, got.found ? found : std::numeric_limits<double>::max(), depth) > 1.0 + 1.0 / 16)
    return "passed through ground";
  if (!got.found) return nullptr;
  if (ground.outside(ray, found) > depth) return "found above the ground";
  if (got.part > 0 && ground.outside(ray, found - 1.0 / 256) < -depth) return "found inside the ground";
  return nullptr;
}

}  // namespace voxmelt::test
