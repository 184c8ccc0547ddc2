#include "accuracy/roundness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "accuracy/cells.h"

namespace voxmelt::accuracy {
namespace {

constexpr double kStride = 0.25;  // along a ray, in cells

// Returns the depth at a place from the middle of the grid. Beyond it there is none.
double depth_at(const Columns& columns, double x, double z) {
  const double gx = x + (columns.nx - 1) / 2.0, gz = z + (columns.nz - 1) / 2.0;
  const int ix = static_cast<int>(std::floor(gx)), iz = static_cast<int>(std::floor(gz));
  const auto column = [&](int i, int k) {
    return i >= 0 && k >= 0 && i < columns.nx && k < columns.nz ? columns.at(i, k) : 0.0;
  };
  const double u = gx - ix, w = gz - iz;
  return (1 - w) * ((1 - u) * column(ix, iz) + u * column(ix + 1, iz)) +
         w * ((1 - u) * column(ix, iz + 1) + u * column(ix + 1, iz + 1));
}

struct Place {
  double x, z;
};

// Walks inwards from `far` to `near` until the depth is reached. Returns the place there, or `near`.
double outermost(const Columns& columns, Place start, Place along, double far, double near, double depth) {
  double before = 0;
  for (double t = far; t > near; t -= kStride) {
    const double now = depth_at(columns, start.x + t * along.x, start.z + t * along.z);
    if (now >= depth) return t + kStride * (now - depth) / std::max(now - before, 1e-9);
    before = now;
  }
  return near;
}

}  // namespace

Outline outline_of(const Columns& columns, double depth) {
  constexpr int kRays = 720;
  const double far = std::hypot(columns.nx, columns.nz) / 2;
  std::vector<double> radii(kRays);
  const auto angle = [](std::size_t ray) {
    return 2 * std::numbers::pi * (static_cast<double>(ray) + 0.5) / kRays;
  };
  Outline outline;
  for (std::size_t i = 0; i < kRays; ++i) {
    const double a = angle(i), r = outermost(columns, {0, 0}, {std::cos(a), std::sin(a)}, far, 0, depth);
    radii[i] = r;
    outline.mean += r / kRays;
    outline.c4 += 2 * r * std::cos(4 * a) / kRays;
    outline.c8 += 2 * r * std::cos(8 * a) / kRays;
  }
  double squares = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    const double a = angle(i);
    const double rest = radii[i] - outline.mean - outline.c4 * std::cos(4 * a) - outline.c8 * std::cos(8 * a);
    squares += rest * rest / kRays;
  }
  outline.rest = std::sqrt(squares);
  outline.c4 /= std::max(outline.mean, 1e-9);
  outline.c8 /= std::max(outline.mean, 1e-9);
  return outline;
}

Extents extents_of(state::Grid grid, const std::function<double(int x, int y, int z)>& part) {
  constexpr int kSplit = 4;  // a cell is kSplit^3 points
  const double cosine = std::cos(std::numbers::pi / 12), solid_angle = 2 * std::numbers::pi * (1 - cosine);
  double all = 0, axes = 0, faces = 0, spaces = 0;
  const auto from_middle = [](int cell, int sub, int cells) {
    return std::abs(cell + (sub + 0.5) / kSplit - cells / 2.0);
  };
  for_each_cell(grid, [&](int x, int y, int z) {
    const double weight = part(x, y, z) / (kSplit * kSplit * kSplit);
    if (weight == 0) return;
    for (int k = 0; k < kSplit; ++k)
      for (int j = 0; j < kSplit; ++j)
        for (int i = 0; i < kSplit; ++i) {
          // By symmetry each of the 48 parts of space has one direction of each kind.
          std::array<double, 3> p{from_middle(x, i, grid.x), from_middle(y, j, grid.y),
                                  from_middle(z, k, grid.z)};
          std::sort(p.begin(), p.end());
          const double reach = cosine * std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
          all += weight;
          if (p[2] >= reach) axes += weight;
          if ((p[1] + p[2]) / std::numbers::sqrt2 >= reach) faces += weight;
          if ((p[0] + p[1] + p[2]) / std::numbers::sqrt3 >= reach) spaces += weight;
        }
  });
  const double radius = std::cbrt(0.75 * all / std::numbers::pi);
  const auto extent = [&](double volume, int directions) {
    return std::cbrt(3 * volume / (directions * solid_angle)) / radius;
  };
  return {radius, extent(axes, 6), extent(faces, 12), extent(spaces, 8)};
}

Front front_of(const Columns& columns, double angle, double half_width, double depth) {
  const Place along{std::cos(angle), std::sin(angle)};
  const double far = std::hypot(columns.nx, columns.nz) / 2;
  std::vector<double> places;
  for (double aside = -half_width; aside <= half_width; aside += kStride)
    places.push_back(outermost(columns, {-aside * along.z, aside * along.x}, along, far, -far, depth));
  Front front;
  const auto count = static_cast<double>(places.size());
  for (const double place : places) front.place += place / count;
  double squares = 0;
  for (const double place : places) squares += (place - front.place) * (place - front.place) / count;
  front.roughness = std::sqrt(squares);
  return front;
}

}  // namespace voxmelt::accuracy
