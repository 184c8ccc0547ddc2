// Points, boxes and placements are in cell units. Cell c of an axis covers c..c+1.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace voxmelt::scene {

struct Point {
  double x = 0, y = 0, z = 0;
};

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(Point a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Point a) { return std::sqrt(dot(a, a)); }
inline Point to_point(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

inline int floor_of(double coordinate) { return static_cast<int>(std::floor(coordinate)); }

struct Box {
  Point low, high;

  void include(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  // Returns 0 inside, and never more than the distance to anything that the box holds.
  double distance(Point p) const {
    const double dx = std::max({low.x - p.x, p.x - high.x, 0.0});
    const double dy = std::max({low.y - p.y, p.y - high.y, 0.0});
    const double dz = std::max({low.z - p.z, p.z - high.z, 0.0});
    return std::sqrt(dx * dx + dy * dy + dz * dz);
  }
};

inline Box box_around(double x, double y, double z) { return {{-x, -y, -z}, {x, y, z}}; }

// Rotates by degrees about x, then y, then z. Multiples of 90 are exact.
class Rotation {
 public:
  Rotation() = default;
  explicit Rotation(const std::array<double, 3>& degrees);

  Point apply(Point p) const { return {dot(rows_[0], p), dot(rows_[1], p), dot(rows_[2], p)}; }
  Point invert(Point p) const { return rows_[0] * p.x + rows_[1] * p.y + rows_[2] * p.z; }

 private:
  std::array<Point, 3> rows_{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
};

// Maps by world = at + rotation (scale * local).
struct Placement {
  Point at;
  Rotation rotation;
  Point scale{1, 1, 1};  // each > 0

  Point world_from_local(Point p) const {
    return at + rotation.apply({p.x * scale.x, p.y * scale.y, p.z * scale.z});
  }
  Point local_from_world(Point p) const {
    const Point q = rotation.invert(p - at);
    return {q.x / scale.x, q.y / scale.y, q.z / scale.z};
  }
};

}  // namespace voxmelt::scene
