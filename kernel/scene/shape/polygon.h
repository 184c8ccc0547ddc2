// Closed outlines in the plane, and the solids that they sweep.
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
  struct Run {  // neighbouring edges, skipped together where their box is far
    Point2 low, high;
    std::size_t first, end;
  };
  double squared_distance(const Run& run, Point2 p) const;

  std::vector<Edge> edges_;
  std::vector<Run> runs_;
  Point2 low_, high_;
};

// A closed Catmull-Rom curve through the points, 8 pieces to a side; a point given twice in a row is
// a corner.
std::vector<Point2> smooth_outline(const std::vector<Point2>& points);

// Turned about the y axis: x of the polygon is the radius (>= 0), y the height.
ShapePtr make_revolve(Polygon profile);

// From z = -depth/2 to depth/2. Edges are rounded by `rounding` (at most depth/2); both faces rise by `bulge`
// at the distance `bulge_width` from the outline, smoothly.
struct Extrusion {
  double depth = 1, rounding = 0, bulge = 0, bulge_width = 1;
};
ShapePtr make_extrude(Polygon outline, const Extrusion& extrusion);

}  // namespace voxmelt::scene
