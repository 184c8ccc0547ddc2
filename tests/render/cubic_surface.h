// The surface in double is a cubic B-spline through the filtered intensities, met by a dense march.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "render/density/density_field.h"
#include "tests/render/sight.h"

namespace voxmelt::test {

class CubicSurface {
 public:
  explicit CubicSurface(const render::DensityField& field) : field_(field) {}

  // Searches along a unit vector, from `from` to `to` cells.
  std::optional<Hit> find(Point start, Point direction, double from, double to) const {
    constexpr double kStep = 0.25;
    for (double t = from; t < to; t += kStep) {
      if (value(start + direction * t) < 0) continue;
      double outside = t - kStep, inside = t;
      for (int i = 0; i < 20; ++i) {
        const double middle = (outside + inside) / 2;
        (value(start + direction * middle) < 0 ? outside : inside) = middle;
      }
      const Point at = start + direction * inside;
      return Hit{at, normal(at)};
    }
    return {};
  }

 private:
  // Returns the weights of the four neighbours of a place t behind the second.
  static std::array<double, 4> weights(double t) {
    const double s = 1 - t;
    return {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6,
            t * t * t / 6};
  }
  // Returns the intensity less half of a full one. Outside of the grid there is air.
  double value(Point p) const {
    const state::Grid& grid = field_.grid();
    if (p.x < -2 || p.y < -2 || p.z < -2 || p.x > grid.x + 2 || p.y > grid.y + 2 || p.z > grid.z + 2)
      return -1;
    const int x = below(p.x), y = below(p.y), z = below(p.z);
    const auto wx = weights(p.x - 0.5 - x), wy = weights(p.y - 0.5 - y), wz = weights(p.z - 0.5 - z);
    double sum = 0;
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          if (!grid.contains(x + i - 1, y + j - 1, z + k - 1)) continue;
          sum += wx[at(i)] * wy[at(j)] * wz[at(k)] *
                 field_.intensity()[grid.index(x + i - 1, y + j - 1, z + k - 1)];
        }
    return sum - render::kFull / 2.0;
  }
  Point normal(Point p) const {
    constexpr double kWay = 1e-3;
    const Point slope{value(p + Point{kWay, 0, 0}) - value(p - Point{kWay, 0, 0}),
                      value(p + Point{0, kWay, 0}) - value(p - Point{0, kWay, 0}),
                      value(p + Point{0, 0, kWay}) - value(p - Point{0, 0, kWay})};
    return slope * (-1 / std::max(length(slope), 1e-12));
  }
  static int below(double a) { return static_cast<int>(std::floor(a - 0.5)); }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  const render::DensityField& field_;
};

}  // namespace voxmelt::test
