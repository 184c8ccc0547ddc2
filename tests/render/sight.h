// Tells what single rays meet in a field, by render/rule, for tests that ask for a place in cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "kernel/scene/look.h"
#include "render/density/density_field.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/levels.h"
#include "render/reference/matter_cells.h"
#include "render/rule/crossing.h"
#include "render/rule/matter.h"
#include "render/rule/normal.h"
#include "render/rule/ray.h"

namespace voxmelt::test {

struct Point {
  double x = 0, y = 0, z = 0;

  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator*(Point a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend double length(Point a) { return std::sqrt(dot(a, a)); }
};

inline picture::Vector scaled(Point p, int bits) {
  const auto fixed = [&](double a) { return static_cast<std::int64_t>(std::llround(std::ldexp(a, bits))); };
  return {fixed(p.x), fixed(p.y), fixed(p.z)};
}
inline Point point_of(picture::Vector v, int bits) {
  const auto real = [&](std::int64_t a) { return std::ldexp(static_cast<double>(a), -bits); };
  return {real(v.x), real(v.y), real(v.z)};
}

struct Hit {
  Point point, normal;  // normal of length 1, out of the matter
};

class Sight {
 public:
  explicit Sight(const render::DensityField& field, const scene::Look& look = {})
      : look_(render::look_in_integers(look)), levels_(field), matter_(field, levels_, look_) {}

  explicit Sight(render::DensityField&&, const scene::Look& = {}) = delete;  // the field must live as long

  // Finds the first surface along `direction`, by samples a quarter of a cell apart.
  std::optional<Hit> find(Point from, Point direction) const {
    const picture::Ray ray{scaled(from, picture::kPositionBits),
                           picture::step_along(scaled(direction, 30), 2)};
    const picture::Crossing met = picture::first_crossing(levels_, levels_.cells(), ray);
    if (!met.found) return {};
    return Hit{point_of(met.position, picture::kPositionBits),
               point_of(picture::normal_at(levels_, met.position), picture::kNormalBits)};
  }
  // Returns the height of the surface seen from above, or -1 if there is none.
  double height(double x, double z) const {
    const std::optional<Hit> hit = find({x, 100, z}, {0, -1, 0});
    return hit ? hit->point.y : -1;
  }
  picture::Matter matter(Point at) const {
    return picture::matter_at(matter_, levels_.cells(), scaled(at, picture::kPositionBits));
  }
  // Returns how much of an obstacle shows at a surface, 0 .. 1. It looks half a cell before the surface. An
  // obstacle counts from a share of 148 to one of 204 (docs/picture/light.md, section 6).
  double obstacle(const Hit& hit) const {
    return std::clamp((matter(hit.point + hit.normal * 0.5).obstacle - 148) / 56.0, 0.0, 1.0);
  }
  const render::Levels& levels() const { return levels_; }

 private:
  picture::Look look_;
  render::Levels levels_;
  render::MatterCells matter_;
};

}  // namespace voxmelt::test
