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

// Holds the parts of a union, halved again and again across the longest side of their box. The nearest boxes
// come first, and most are never looked at.
class PartTree {
 public:
  explicit PartTree(std::vector<Part> parts) : parts_(std::move(parts)) { build(0, parts_.size()); }

  double distance(Point p) const {
    double nearest = 1e300;
    search(0, nodes_[0].bounds.distance(p), p, nearest);
    return nearest;
  }

 private:
  static constexpr std::size_t kLeaf = 4;  // parts

  struct Node {
    Box bounds;
    std::size_t first, end, right = 0;  // range of parts; the left child follows, and 0 marks a leaf
  };

  std::size_t build(std::size_t first, std::size_t end) {
    const std::size_t node = nodes_.size();
    Box bounds = parts_[first].bounds;
    for (std::size_t i = first; i < end; ++i) bounds = united(bounds, parts_[i].bounds);
    nodes_.push_back({bounds, first, end});
    if (end - first <= kLeaf) return node;
    const Point size = bounds.high - bounds.low;
    const auto middle_of = [&](const Part& part) {
      const Point sum = part.bounds.low + part.bounds.high;
      return size.x >= size.y && size.x >= size.z ? sum.x : size.y >= size.z ? sum.y : sum.z;
    };
    const std::size_t half = (first + end) / 2;
    const auto at = [&](std::size_t i) { return parts_.begin() + i; };
    std::nth_element(at(first), at(half), at(end),
                     [&](const Part& a, const Part& b) { return middle_of(a) < middle_of(b); });
    build(first, half);
    nodes_[node].right = build(half, end);
    return node;
  }

  // Searches a node. A part whose box is farther than the best so far cannot be nearer.
  void search(std::size_t index, double box_distance, Point p, double& nearest) const {
    if (box_distance >= nearest) return;
    const Node& node = nodes_[index];
    if (node.right == 0) {
      for (std::size_t i = node.first; i < node.end; ++i)
        if (parts_[i].bounds.distance(p) < nearest) nearest = std::min(nearest, parts_[i].shape->distance(p));
      return;
    }
    std::pair<double, std::size_t> near{nodes_[index + 1].bounds.distance(p), index + 1},
        far{nodes_[node.right].bounds.distance(p), node.right};
    if (far.first < near.first) std::swap(near, far);
    search(near.second, near.first, p, nearest);
    search(far.second, far.first, p, nearest);
  }

  std::vector<Part> parts_;
  std::vector<Node> nodes_;
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

  if (operation == Operation::union_of)
    return make_shape(bounds, [tree = PartTree(std::move(parts))](Point p) { return tree.distance(p); });
  const double sign = operation == Operation::difference ? -1 : 1;
  return make_shape(bounds, [parts = std::move(parts), sign](Point p) {
    double farthest = parts.front().shape->distance(p);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      // Far from a shape that is taken away, its box is a sufficient bound.
      if (sign < 0 && -parts[i].bounds.distance(p) < farthest) continue;
      farthest = std::max(farthest, sign * parts[i].shape->distance(p));
    }
    return farthest;
  });
}

}  // namespace voxmelt::scene
