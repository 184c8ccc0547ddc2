#include "kernel/scene/shape/polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace voxmelt::scene {
namespace {

bool same(Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }

}  // namespace

Polygon::Polygon(const std::vector<Point2>& points) : low_(points.front()), high_(points.front()) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 from = points[i], to = points[(i + 1) % points.size()];
    low_ = {std::min(low_.x, from.x), std::min(low_.y, from.y)};
    high_ = {std::max(high_.x, from.x), std::max(high_.y, from.y)};
    if (same(from, to)) continue;
    const Point2 along{to.x - from.x, to.y - from.y};
    edges_.push_back({from, along, to.y, 1 / (along.x * along.x + along.y * along.y)});
  }

  constexpr std::size_t kRunLength = 12;
  for (std::size_t first = 0; first < edges_.size(); first += kRunLength) {
    Run run{edges_[first].from, edges_[first].from, first, std::min(first + kRunLength, edges_.size())};
    for (std::size_t i = first; i < run.end; ++i) {
      const Point2 from = edges_[i].from, to{from.x + edges_[i].along.x, edges_[i].to_y};
      run.low = {std::min({run.low.x, from.x, to.x}), std::min({run.low.y, from.y, to.y})};
      run.high = {std::max({run.high.x, from.x, to.x}), std::max({run.high.y, from.y, to.y})};
    }
    runs_.push_back(run);
  }
}

// Returns the distance. The nearest box comes first, so that most of the others are too far to be looked at.
double Polygon::distance(Point2 p) const {
  const auto to_box = [&](const Run& run) {
    const double bx = std::max({run.low.x - p.x, p.x - run.high.x, 0.0}),
                 by = std::max({run.low.y - p.y, p.y - run.high.y, 0.0});
    return bx * bx + by * by;
  };
  const Run* first = runs_.data();
  double nearest_squared = 1e300;
  for (const Run& run : runs_)
    if (const double squared = to_box(run); squared < nearest_squared) {
      nearest_squared = squared;
      first = &run;
    }
  nearest_squared = squared_distance(*first, p);
  bool inside = false;
  for (const Run& run : runs_) {
    if (&run != first && to_box(run) < nearest_squared)
      nearest_squared = std::min(nearest_squared, squared_distance(run, p));
    if (p.y < run.low.y || p.y > run.high.y || p.x > run.high.x) continue;
    // By the even-odd rule, an edge counts if a ray towards +x crosses it.
    for (std::size_t i = run.first; i < run.end; ++i) {
      const Edge& edge = edges_[i];
      const bool from_above = p.y < edge.from.y, to_above = p.y < edge.to_y;
      if (from_above != to_above &&
          ((p.x - edge.from.x) * edge.along.y < (p.y - edge.from.y) * edge.along.x) == (edge.along.y > 0))
        inside = !inside;
    }
  }
  const double distance = std::sqrt(nearest_squared);
  return inside ? -distance : distance;
}

double Polygon::squared_distance(const Run& run, Point2 p) const {
  double nearest = 1e300;
  for (std::size_t i = run.first; i < run.end; ++i) {
    const Edge& edge = edges_[i];
    const double wx = p.x - edge.from.x, wy = p.y - edge.from.y;
    const double t = std::clamp((wx * edge.along.x + wy * edge.along.y) * edge.inverse_square, 0.0, 1.0);
    const double dx = wx - t * edge.along.x, dy = wy - t * edge.along.y;
    nearest = std::min(nearest, dx * dx + dy * dy);
  }
  return nearest;
}

std::vector<Point2> smooth_outline(const std::vector<Point2>& points) {
  constexpr int kPieces = 8;
  constexpr double kPart = 1.0 / kPieces;
  std::vector<Point2> result;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 a = points[(i + n - 1) % n], b = points[i], c = points[(i + 1) % n], d = points[(i + 2) % n];
    if (same(b, c)) continue;
    for (int k = 0; k < kPieces; ++k) {
      const double t = k * kPart;
      const auto curve = [t](double p, double q, double r, double s) {
        return q + 0.5 * t * (r - p + t * (2 * p - 5 * q + 4 * r - s + t * (3 * (q - r) + s - p)));
      };
      result.push_back({curve(a.x, b.x, c.x, d.x), curve(a.y, b.y, c.y, d.y)});
    }
  }
  return result;
}

ShapePtr make_revolve(Polygon profile) {
  const double reach = profile.high().x;
  const Box bounds{{-reach, profile.low().y, -reach}, {reach, profile.high().y, reach}};
  return make_shape(bounds, [profile = std::move(profile)](Point p) {
    return profile.distance({std::hypot(p.x, p.z), p.y});
  });
}

ShapePtr make_extrude(Polygon outline, const Extrusion& extrusion) {
  const double half = extrusion.depth / 2;
  const Box bounds{{outline.low().x, outline.low().y, -half - extrusion.bulge},
                   {outline.high().x, outline.high().y, half + extrusion.bulge}};
  // The smoothstep of the bulge has slope at most 1.5 bulge / width.
  const double slope = 1.5 * extrusion.bulge / extrusion.bulge_width;
  const double steepest = std::sqrt(1 + slope * slope);
  return make_shape(bounds, [=, outline = std::move(outline)](Point p) {
    const double r = extrusion.rounding;
    const double across = outline.distance({p.x, p.y});
    const double t = std::clamp(-across / extrusion.bulge_width, 0.0, 1.0);
    const double face = half + extrusion.bulge * t * t * (3 - 2 * t);
    const double u = across + r, v = std::abs(p.z) - face + r;
    return (std::hypot(std::max(u, 0.0), std::max(v, 0.0)) + std::min(std::max(u, v), 0.0) - r) / steepest;
  });
}

}  // namespace voxmelt::scene
