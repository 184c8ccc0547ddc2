#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/scene/shape/mesh.h"
#include "kernel/scene/shape/mesh_rays.h"

namespace voxmelt::scene {
namespace {

std::vector<FixedPoint> snapped(const Mesh& mesh) {
  std::vector<FixedPoint> result;
  result.reserve(mesh.vertices.size());
  const auto snap = [](double v) {
    constexpr std::int64_t snaps_per_cell = kMeshUnit / kMeshSnap;
    return static_cast<std::int64_t>(std::llround(v * static_cast<double>(snaps_per_cell))) * kMeshSnap;
  };
  for (const Point& p : mesh.vertices) result.push_back({snap(p.x), snap(p.y), snap(p.z)});
  return result;
}

// Cells that the surface may pass through: near a triangle's plane and inside its box.
std::vector<bool> touched_cells(const Mesh& mesh, const Window& window) {
  std::vector<bool> touched(window.size.cells());
  for (const auto& triangle : mesh.triangles) {
    const Point a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]],
                c = mesh.vertices[triangle[2]];
    const Point u = b - a, v = c - a;
    const Point normal{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    const double reach = 0.9 * length(normal);  // a little more than half the diagonal of a cell
    const auto range = [](double p, double q, double r, int low, int size) {
      const double from = std::floor(std::min({p, q, r}) - 0.01),
                   to = std::floor(std::max({p, q, r}) + 0.01) + 1;
      return std::array{static_cast<int>(std::clamp<double>(from, low, low + size)),
                        static_cast<int>(std::clamp<double>(to, low, low + size))};
    };
    const auto [x0, x1] = range(a.x, b.x, c.x, window.x, window.size.x);
    const auto [y0, y1] = range(a.y, b.y, c.y, window.y, window.size.y);
    const auto [z0, z1] = range(a.z, b.z, c.z, window.z, window.size.z);
    for (int z = z0; z < z1; ++z)
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
          if (std::abs(dot(Point{x + 0.5, y + 0.5, z + 0.5} - a, normal)) <= reach)
            touched[window.index(x, y, z)] = true;
  }
  return touched;
}

struct Votes {
  unsigned count;  // samples inside by majority
  bool disagree;
};

// The 64 samples of one cell, bit x + 4 y + 16 z, seen along each of the three axes.
Votes vote(const MeshRays& along_x, const MeshRays& along_y, const MeshRays& along_z, int x, int y, int z) {
  std::uint64_t by_x = 0, by_y = 0, by_z = 0;
  unsigned odd = 0;
  for (unsigned i = 0; i < 4; ++i)
    for (unsigned k = 0; k < 4; ++k) {
      const int ii = static_cast<int>(i), kk = static_cast<int>(k);
      const std::uint64_t x_mask = along_x.inside(y + ii, z + kk, x),
                          y_mask = along_y.inside(z + ii, x + kk, y),
                          z_mask = along_z.inside(x + ii, y + kk, z);
      odd |= static_cast<unsigned>((x_mask | y_mask | z_mask) & MeshRays::kOdd);
      by_x |= (x_mask & 15) << (4 * i + 16 * k);
      for (unsigned bit = 0; bit < 4; ++bit) {
        by_y |= (y_mask >> bit & 1) << (k + 4 * bit + 16 * i);
        by_z |= (z_mask >> bit & 1) << (i + 4 * k + 16 * bit);
      }
    }
  const std::uint64_t majority = (by_x & by_y) | (by_x & by_z) | (by_y & by_z);
  return {static_cast<unsigned>(std::popcount(majority)), odd != 0 || by_x != by_y || by_x != by_z};
}

}  // namespace

MeshCoverage cover(const Mesh& mesh, state::Grid grid) {
  MeshCoverage result;
  const Window window = window_of(mesh.bounds(), grid);
  result.coverage.window = window;
  result.coverage.samples.resize(window.size.cells());
  if (window.size.cells() == 0) return result;

  const std::vector<FixedPoint> vertices = snapped(mesh);
  const MeshRays along_x(vertices, mesh, window, 0), along_y(vertices, mesh, window, 1),
      along_z(vertices, mesh, window, 2);
  const std::vector<bool> touched = touched_cells(mesh, window);

  // A cell that the surface does not touch is wholly inside or outside, so one sample tells.
  for (int z = 0; z < window.size.z; ++z)
    for (int x = 0; x < window.size.x; ++x) {
      bool disagree = false;
      for (int y = 0; y < window.size.y; ++y) {
        const std::size_t cell = window.size.index(x, y, z);
        const int sx = 4 * x, sy = 4 * y, sz = 4 * z;
        if (touched[cell]) {
          const Votes votes = vote(along_x, along_y, along_z, sx, sy, sz);
          result.coverage.samples[cell] = static_cast<std::uint8_t>(votes.count);
          disagree = disagree || votes.disagree;
        } else {
          const unsigned mx = along_x.inside(sy, sz, sx), my = along_y.inside(sz, sx, sy),
                         mz = along_z.inside(sx, sy, sz);
          const unsigned sum = (mx & 1) + (my & 1) + (mz & 1);
          result.coverage.samples[cell] = sum >= 2 ? kSamplesPerCell : 0;
          disagree = disagree || (sum != 0 && sum != 3) || ((mx | my | mz) & MeshRays::kOdd) != 0;
        }
      }
      ++result.columns;
      result.disagreeing += disagree ? 1 : 0;
    }
  return result;
}

}  // namespace voxmelt::scene
