#include "kernel/scene/shape/mesh_thin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxmelt::scene {
namespace {

constexpr int kMostParts = 1 << 16;  // of an edge

bool is_within(const Window& window, Point p) {
  return p.x >= window.x && p.y >= window.y && p.z >= window.z && p.x <= window.x + window.size.x &&
         p.y <= window.y + window.size.y && p.z <= window.z + window.size.z;
}

// Returns the most samples of the eight cells around a place.
int most_samples(const Coverage& coverage, Point p) {
  const Window& window = coverage.window;
  const int x = static_cast<int>(std::floor(p.x - 0.5)), y = static_cast<int>(std::floor(p.y - 0.5)),
            z = static_cast<int>(std::floor(p.z - 0.5));
  int most = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int cx = x + (corner & 1), cy = y + (corner >> 1 & 1), cz = z + (corner >> 2);
    const bool there = cx >= window.x && cy >= window.y && cz >= window.z && cx < window.x + window.size.x &&
                       cy < window.y + window.size.y && cz < window.z + window.size.z;
    if (there) most = std::max<int>(most, coverage.samples[window.index(cx, cy, cz)]);
  }
  return most;
}

// Cuts an edge into equal parts, and looks at the middle of each.
void add_edge(EdgeLength& sum, const Coverage& coverage, Point a, Point b) {
  const double all = length(b - a);
  const int n = static_cast<int>(std::clamp(std::ceil(2 * all), 1.0, double{kMostParts}));
  for (int i = 0; i < n; ++i) {
    const Point p = a + (b - a) * ((i + 0.5) / n);
    if (!is_within(coverage.window, p)) continue;
    const int most = most_samples(coverage, p);
    sum.all += all / n;
    if (most < kLeastSolid) sum.without_solid += all / n;
    if (most < kLeastInert) sum.without_inert += all / n;
  }
}

}  // namespace

EdgeLength length_of_edges(const Mesh& mesh, const Coverage& coverage) {
  EdgeLength sum;
  for (std::size_t i = 0; i < mesh.faces(); ++i) {
    const auto face = mesh.face(i);
    for (std::size_t k = 0; k < face.size(); ++k)
      add_edge(sum, coverage, mesh.vertices[face[k]], mesh.vertices[face[(k + 1) % face.size()]]);
  }
  return sum;
}

}  // namespace voxmelt::scene
