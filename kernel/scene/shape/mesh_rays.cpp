#include "kernel/scene/shape/mesh_rays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "kernel/scene/text/error.h"

namespace voxmelt::scene {
namespace {

constexpr std::uint64_t kMostCrossings = std::uint64_t{1} << 30;

std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return a >= 0 ? (a + b - 1) / b : -(-a / b); }

struct Point2i {
  std::int64_t u, v;
};

// Twice the signed area of (a, b, p); at most 2^61.
std::int64_t edge(Point2i a, Point2i b, Point2i p) {
  return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
}

// A point exactly on an edge belongs to one of the two triangles that share it, because they run through the
// edge in opposite directions.
bool owns(Point2i a, Point2i b) { return b.v > a.v || (b.v == a.v && b.u < a.u); }

}  // namespace

MeshRays::MeshRays(const std::vector<FixedPoint>& vertices, const Mesh& mesh, const Window& window, int axis)
    : axis_(axis), u_axis_((axis + 1) % 3), v_axis_((axis + 2) % 3) {
  const std::array<int, 3> low{window.x, window.y, window.z},
      size{window.size.x, window.size.y, window.size.z};
  for (std::size_t i = 0; i < 3; ++i) {
    low_[i] = low[i] * kMeshUnit + kSampleOffset[i];
    count_[i] = size[i] * kSamplesPerAxis;
  }
  // Crossings are counted first and placed then, so that all rays share one compact list.
  start_.resize(static_cast<std::size_t>(count_[u_axis_]) * static_cast<std::size_t>(count_[v_axis_]) + 1);
  rasterise(vertices, mesh, [&](std::size_t ray, std::int32_t) { ++start_[ray + 1]; });
  std::uint64_t total = 0;
  for (std::uint32_t& start : start_) {
    total += start;
    if (total > kMostCrossings)
      throw ResourceError("mesh: more than 2^30 crossings with sample rays, too many for memory");
    start = static_cast<std::uint32_t>(total);
  }
  crossings_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  rasterise(vertices, mesh, [&](std::size_t ray, std::int32_t sample) { crossings_[next[ray]++] = sample; });
}

template <class Visit>
void MeshRays::rasterise(const std::vector<FixedPoint>& vertices, const Mesh& mesh, Visit visit) const {
  for (const auto& triangle : mesh.triangles) {
    FixedPoint a = vertices[triangle[0]], b = vertices[triangle[1]], c = vertices[triangle[2]];
    const auto flat = [&](const FixedPoint& p) { return Point2i{p[u_axis_], p[v_axis_]}; };
    if (edge(flat(a), flat(b), flat(c)) < 0) std::swap(b, c);
    const Point2i fa = flat(a), fb = flat(b), fc = flat(c);
    const std::int64_t area = edge(fa, fb, fc);
    if (area == 0) continue;

    const auto span = [&](std::int64_t p, std::int64_t q, std::int64_t r, int along) {
      const std::int64_t from = ceil_div(std::min({p, q, r}) - low_[along], kSampleSpacing);
      const std::int64_t to = ceil_div(std::max({p, q, r}) - low_[along] + 1, kSampleSpacing);
      return std::array{std::max<std::int64_t>(from, 0), std::min<std::int64_t>(to, count_[along])};
    };
    const auto [u_from, u_to] = span(fa.u, fb.u, fc.u, u_axis_);
    const auto [v_from, v_to] = span(fa.v, fb.v, fc.v, v_axis_);
    for (std::int64_t v = v_from; v < v_to; ++v)
      for (std::int64_t u = u_from; u < u_to; ++u) {
        const Point2i p{low_[u_axis_] + u * kSampleSpacing, low_[v_axis_] + v * kSampleSpacing};
        const std::int64_t wa = edge(fb, fc, p), wb = edge(fc, fa, p), wc = edge(fa, fb, p);
        if (wa < 0 || wb < 0 || wc < 0) continue;
        if ((wa == 0 && !owns(fb, fc)) || (wb == 0 && !owns(fc, fa)) || (wc == 0 && !owns(fa, fb))) continue;
        const double depth = (static_cast<double>(wa) * static_cast<double>(a[axis_]) +
                              static_cast<double>(wb) * static_cast<double>(b[axis_]) +
                              static_cast<double>(wc) * static_cast<double>(c[axis_])) /
                             static_cast<double>(area);
        const double sample =
            std::ceil((depth - static_cast<double>(low_[axis_])) / static_cast<double>(kSampleSpacing));
        visit(static_cast<std::size_t>(v) * static_cast<std::size_t>(count_[u_axis_]) +
                  static_cast<std::size_t>(u),
              static_cast<std::int32_t>(std::clamp(sample, 0.0, static_cast<double>(count_[axis_]))));
      }
  }
}

unsigned MeshRays::inside(int u, int v, int first) const {
  const std::size_t ray =
      static_cast<std::size_t>(v) * static_cast<std::size_t>(count_[u_axis_]) + static_cast<std::size_t>(u);
  unsigned mask = 0;
  for (std::uint32_t i = start_[ray]; i < start_[ray + 1]; ++i) {
    const int skipped = std::clamp(crossings_[i] - first, 0, 4);
    mask ^= 0xFu & (0xFu << skipped);  // all samples from the crossing on change sides
  }
  return mask | ((start_[ray + 1] - start_[ray]) % 2 != 0 ? kOdd : 0);
}

}  // namespace voxmelt::scene
