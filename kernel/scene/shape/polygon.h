// Closed outlines in the plane sweep solids.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/scene/shape/shape.h"

namespace voxmelt::scene {

struct Point2 {
  double x = 0, y = 0;
};

class Polygon {
 public:
  explicit Polygon(const std::vector<Point2>& points);  // at least 3 different points

  double distance(Point2 p) const;  // exact; negative inside (even-odd)
  Point2 low() const { return low_; }
  Point2 high() const { return high_; }

 private:
  struct Edge {
    Point2 from, along;
    double to_y, inverse_square;
  };
  struct Run {  // neighbouring edges, skipped together if their box is far
    Point2 low, high;
    std::size_t first, end;
  };
  double squared_distance(const Run& run, Point2 p) const;

  std::vector<Edge> edges_;
  std::vector<Run> runs_;
  Point2 low_, high_;
};

// Returns a closed Catmull-Rom curve through the points, 8 pieces to a side. A point given twice in a row is
// a corner.
std::vector<Point2> smooth_outline(const std::vector<Point2>& points);

// Turns a polygon about the y axis. Its x is the radius (>= 0), its y the height.
ShapePtr make_revolve(Polygon profile);

// Extends an outline from z = -depth/2 to depth/2. Edges are rounded by `rounding` (at most depth/2). Both
// faces rise smoothly by `bulge` at the distance `bulge_width` from the outline.
struct Extrusion {
  double depth = 1, rounding = 0, bulge = 0, bulge_width = 1;
};
ShapePtr make_extrude(Polygon outline, const Extrusion& extrusion);

}  // namespace voxmelt::scene
