#include "accuracy/silhouette.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "accuracy/cells.h"

namespace voxmelt::accuracy {
namespace {

using Vector = std::array<double, 3>;

constexpr double kPixel = 1.0 / 8;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector plus(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& a) { return plus({}, 1 / std::sqrt(dot(a, a)), a); }

// Tells if the line from `eye` along `way` meets the cube of side 1 with its lowest corner at `low`.
bool meets(const Vector& eye, const Vector& way, const Vector& low) {
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < 3; ++a) {
    if (way[a] == 0) {
      if (eye[a] < low[a] || eye[a] > low[a] + 1) return false;
      continue;
    }
    const double one = (low[a] - eye[a]) / way[a], other = (low[a] + 1 - eye[a]) / way[a];
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  return enter < leave;
}

}  // namespace

double solid_angle(const state::Volume& volume, const std::array<double, 3>& eye) {
  const state::Grid g = volume.grid;
  const Vector middle{g.x / 2.0, g.y / 2.0, g.z / 2.0}, back = plus(eye, -1, middle);
  const double distance = std::sqrt(dot(back, back));
  const Vector towards = unit(back);
  const Vector right = unit(cross(towards, std::abs(towards[1]) < 0.9 ? Vector{0, 1, 0} : Vector{1, 0, 0}));
  const Vector up = cross(right, towards);
  // Parts nearer to the eye look larger, so the pixels reach further than the grid.
  const double reach = std::sqrt(dot(middle, middle));
  const int half = static_cast<int>(std::ceil(reach * distance / (distance - reach) / kPixel)) + 1;
  const std::size_t side = 2 * half;
  const auto place = [&](int pixel) { return (pixel - half + 0.5) * kPixel; };
  const auto pixel = [&](double at) {
    return std::clamp(static_cast<int>(at / kPixel + half), 0, 2 * half - 1);
  };

  std::vector<char> covered(side * side);
  double sum = 0;
  for_each_cell(g, [&](int x, int y, int z) {
    if (!volume.solid.test(x, y, z)) return;
    const Vector low{1. * x, 1. * y, 1. * z};
    double left = reach * 4, end = -left, bottom = left, top = -left;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector at =
          plus({low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2)}, -1, eye);
      const double scale = distance / -dot(at, towards);
      left = std::min(left, scale * dot(at, right));
      end = std::max(end, scale * dot(at, right));
      bottom = std::min(bottom, scale * dot(at, up));
      top = std::max(top, scale * dot(at, up));
    }
    for (int row = pixel(bottom); row <= pixel(top); ++row)
      for (int column = pixel(left); column <= pixel(end); ++column) {
        char& is = covered[row * side + column];
        const double a = place(column), b = place(row);
        if (is != 0 || !meets(eye, plus(plus(plus({}, -1, back), a, right), b, up), low)) continue;
        is = 1;
        sum += distance / std::pow(distance * distance + a * a + b * b, 1.5);
      }
  });
  return sum * kPixel * kPixel;
}

}  // namespace voxmelt::accuracy
