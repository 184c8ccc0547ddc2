// A shape is a field of signed distances. Voxelisation uses it to skip whole blocks, so it must never be too
// large: |distance(p)| is at most the distance from p to the surface (a field of slope at most 1).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "kernel/scene/shape/geometry.h"

namespace voxmelt::scene {

class Shape {
 public:
  virtual ~Shape() = default;
  virtual double distance(Point p) const = 0;  // cells; negative inside
  virtual Box bounds() const = 0;
};

using ShapePtr = std::unique_ptr<const Shape>;

template <class Field>
class FieldShape final : public Shape {
 public:
  FieldShape(Box bounds, Field field) : bounds_(bounds), field_(std::move(field)) {}
  double distance(Point p) const override { return field_(p); }
  Box bounds() const override { return bounds_; }

 private:
  Box bounds_;
  Field field_;
};

template <class Field>
ShapePtr make_shape(Box bounds, Field field) {
  return std::make_unique<FieldShape<Field>>(bounds, std::move(field));
}

// Primitives stand about the origin. Lengths are in cells, all > 0. Cylinder and cone stand on y = 0.
ShapePtr make_sphere(double radius);
ShapePtr make_box(Point size, double rounding);  // edges rounded by 0 <= rounding <= half the least side
ShapePtr make_ellipsoid(Point radii);
ShapePtr make_cylinder(double radius, double height);
ShapePtr make_cone(double radius, double radius_top, double height);
ShapePtr make_torus(double radius, double tube);  // ring in the plane y = 0

// Is a point of a tube. A tube is a chain of capsules through at least one point, with a radius at each.
struct TubePoint {
  Point at;
  double radius = 1;
};
ShapePtr make_tube(std::vector<TubePoint> points);

ShapePtr make_placed(ShapePtr shape, const Placement& placement);
ShapePtr make_mirrored(ShapePtr shape, int axis);  // united with its reflection in the plane axis = 0

enum class Operation { union_of, intersection, difference };  // difference: the first less all others
ShapePtr make_csg(Operation operation, std::vector<ShapePtr> parts);

}  // namespace voxmelt::scene
