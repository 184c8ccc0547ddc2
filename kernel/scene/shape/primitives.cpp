#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "kernel/scene/shape/polygon.h"
#include "kernel/scene/shape/shape.h"

namespace voxmelt::scene {
namespace {

double piece_distance(const TubePoint& a, const TubePoint& b, Point p) {
  const Point along = b.at - a.at;
  const double squared = dot(along, along);
  if (squared == 0) return length(p - a.at) - std::max(a.radius, b.radius);
  const double t = std::clamp(dot(p - a.at, along) / squared, 0.0, 1.0);
  const double taper = (b.radius - a.radius) / std::sqrt(squared);
  // A taper steepens the field. Dividing restores slope 1.
  return (length(p - a.at - along * t) - a.radius - t * (b.radius - a.radius)) / std::sqrt(1 + taper * taper);
}

}  // namespace

ShapePtr make_sphere(double radius) {
  return make_shape(box_around(radius, radius, radius), [=](Point p) { return length(p) - radius; });
}

ShapePtr make_box(Point size, double rounding) {
  const Point half = size * 0.5;
  return make_shape(box_around(half.x, half.y, half.z), [=](Point p) {
    const Point q{std::abs(p.x) - half.x + rounding, std::abs(p.y) - half.y + rounding,
                  std::abs(p.z) - half.z + rounding};
    const Point outside{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return length(outside) + std::min(std::max({q.x, q.y, q.z}), 0.0) - rounding;
  });
}

ShapePtr make_ellipsoid(Point radii) {
  // |p / r| rises by at most 1 / min(r) per cell.
  const double least = std::min({radii.x, radii.y, radii.z});
  return make_shape(box_around(radii.x, radii.y, radii.z), [=](Point p) {
    return (length({p.x / radii.x, p.y / radii.y, p.z / radii.z}) - 1) * least;
  });
}

ShapePtr make_cylinder(double radius, double height) {
  return make_shape({{-radius, 0, -radius}, {radius, height, radius}}, [=](Point p) {
    const double across = std::hypot(p.x, p.z) - radius;
    const double along = std::abs(p.y - height / 2) - height / 2;
    return std::hypot(std::max(across, 0.0), std::max(along, 0.0)) + std::min(std::max(across, along), 0.0);
  });
}

ShapePtr make_cone(double radius, double radius_top, double height) {
  return make_revolve(Polygon({{0, 0}, {radius, 0}, {radius_top, height}, {0, height}}));
}

ShapePtr make_torus(double radius, double tube) {
  return make_shape(box_around(radius + tube, tube, radius + tube),
                    [=](Point p) { return std::hypot(std::hypot(p.x, p.z) - radius, p.y) - tube; });
}

ShapePtr make_tube(std::vector<TubePoint> points) {
  if (points.size() == 1) points.push_back(points.front());
  const auto include = [](Box& box, const TubePoint& point) {
    const Point reach{point.radius, point.radius, point.radius};
    box.include(point.at - reach);
    box.include(point.at + reach);
  };

  // Neighbouring pieces are skipped together if their box is far.
  struct Run {
    Box box;
    std::size_t first, end;
  };
  constexpr std::size_t kRunLength = 8;
  std::vector<Run> runs;
  Box bounds{points[0].at, points[0].at};
  for (std::size_t first = 0; first + 1 < points.size(); first += kRunLength) {
    Run run{{points[first].at, points[first].at}, first, std::min(first + kRunLength, points.size() - 1)};
    for (std::size_t i = first; i <= run.end; ++i) include(run.box, points[i]);
    bounds.include(run.box.low);
    bounds.include(run.box.high);
    runs.push_back(run);
  }
  return make_shape(bounds, [points = std::move(points), runs = std::move(runs)](Point p) {
    double nearest = 1e300;
    for (const Run& run : runs) {
      if (run.box.distance(p) >= nearest) continue;
      for (std::size_t i = run.first; i < run.end; ++i)
        nearest = std::min(nearest, piece_distance(points[i], points[i + 1], p));
    }
    return nearest;
  });
}

}  // namespace voxmelt::scene
