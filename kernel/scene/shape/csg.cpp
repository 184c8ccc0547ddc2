#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "kernel/scene/shape/shape.h"

namespace voxmelt::scene {
namespace {

std::array<Point, 8> corners_of(const Box& box) {
  std::array<Point, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                  i & 4 ? box.high.z : box.low.z};
  return corners;
}

Box united(Box a, const Box& b) {
  a.include(b.low);
  a.include(b.high);
  return a;
}

Box intersected(const Box& a, const Box& b) {
  Box box{{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
  box.high = {std::max(box.low.x, box.high.x), std::max(box.low.y, box.high.y),
              std::max(box.low.z, box.high.z)};
  return box;
}

struct Part {
  ShapePtr shape;
  Box bounds;
};

}  // namespace

ShapePtr make_placed(ShapePtr shape, const Placement& placement) {
  const Box local = shape->bounds();
  const Point first = placement.world_from_local(local.low);
  Box bounds{first, first};
  for (const Point corner : corners_of(local)) bounds.include(placement.world_from_local(corner));
  const double least_scale = std::min({placement.scale.x, placement.scale.y, placement.scale.z});
  return make_shape(bounds, [shape = std::move(shape), placement, least_scale](Point p) {
    return shape->distance(placement.local_from_world(p)) * least_scale;
  });
}

ShapePtr make_mirrored(ShapePtr shape, int axis) {
  const auto reflect = [axis](Point p) {
    (axis == 0 ? p.x : axis == 1 ? p.y : p.z) *= -1;
    return p;
  };
  Box bounds = shape->bounds();
  for (const Point corner : corners_of(shape->bounds())) bounds.include(reflect(corner));
  return make_shape(bounds, [shape = std::move(shape), reflect](Point p) {
    return std::min(shape->distance(p), shape->distance(reflect(p)));
  });
}

ShapePtr make_csg(Operation operation, std::vector<ShapePtr> shapes) {
  std::vector<Part> parts;
  Box bounds = shapes.front()->bounds();
  for (ShapePtr& shape : shapes) {
    const Box own = shape->bounds();
    if (operation == Operation::union_of) bounds = united(bounds, own);
    if (operation == Operation::intersection) bounds = intersected(bounds, own);
    parts.push_back({std::move(shape), own});
  }

  if (operation == Operation::union_of) {
    return make_shape(bounds, [parts = std::move(parts)](Point p) {
      // A part whose box is farther than the best so far cannot be nearer: so the nearest box comes first.
      const Part* first = parts.data();
      double nearest = 1e300;
      for (const Part& part : parts) {
        const double distance = part.bounds.distance(p);
        if (distance >= nearest) continue;
        nearest = distance;
        first = &part;
        if (distance == 0) break;
      }
      nearest = first->shape->distance(p);
      for (const Part& part : parts)
        if (&part != first && part.bounds.distance(p) < nearest)
          nearest = std::min(nearest, part.shape->distance(p));
      return nearest;
    });
  }
  const double sign = operation == Operation::difference ? -1 : 1;
  return make_shape(bounds, [parts = std::move(parts), sign](Point p) {
    double farthest = parts.front().shape->distance(p);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      // Far from what is taken away, its box is a sufficient bound.
      if (sign < 0 && -parts[i].bounds.distance(p) < farthest) continue;
      farthest = std::max(farthest, sign * parts[i].shape->distance(p));
    }
    return farthest;
  });
}

}  // namespace voxmelt::scene
