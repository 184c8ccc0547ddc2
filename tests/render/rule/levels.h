// Makes small fields of levels for the tests of the picture's rules.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/rule/fixed_point.h"
#include "render/rule/sample.h"

namespace voxmelt::test {

// Holds a cube of side^3 cells, with air outside.
class CubeOfLevels {
 public:
  // Calls level(x, y, z) for each cell. The coordinates are those of the cell, not of its centre.
  template <class Level>
  CubeOfLevels(int side, const Level& level) : side_(side) {
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) levels_.push_back(static_cast<std::int32_t>(level(x, y, z)));
  }

  std::int32_t operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
    if (x < 0 || y < 0 || z < 0 || x >= side_ || y >= side_ || z >= side_) return picture::kAir;
    return levels_[static_cast<std::size_t>((z * side_ + y) * side_ + x)];
  }
  picture::Vector cells() const { return {side_, side_, side_}; }

 private:
  std::int64_t side_;
  std::vector<std::int32_t> levels_;
};

// Makes a ball whose level falls evenly through a shell of four cells.
inline CubeOfLevels ball_of_levels(int side, double radius) {
  return {side, [=](int x, int y, int z) {
            const double half = side / 2.0;
            const double outward = std::hypot(x + 0.5 - half, y + 0.5 - half, z + 0.5 - half) - radius;
            return std::lround(std::clamp(-outward / 2, -1.0, 1.0) * picture::kHalfIntensity);
          }};
}

// Returns the trilinear interpolation in double, at a position in cells, with exact weights.
inline double plain_sample(const CubeOfLevels& levels, double x, double y, double z) {
  const double cx = std::floor(x - 0.5), cy = std::floor(y - 0.5), cz = std::floor(z - 0.5);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
    const double wx = 1 - std::abs(cx + dx + 0.5 - x), wy = 1 - std::abs(cy + dy + 0.5 - y),
                 wz = 1 - std::abs(cz + dz + 0.5 - z);
    sum += wx * wy * wz *
           levels(static_cast<std::int64_t>(cx) + dx, static_cast<std::int64_t>(cy) + dy,
                  static_cast<std::int64_t>(cz) + dz);
  }
  return sum;
}

}  // namespace voxmelt::test
