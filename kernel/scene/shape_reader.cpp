#include "kernel/scene/shape_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "kernel/scene/look.h"
#include "kernel/scene/shape/polygon.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kMostPoints = 1024;
constexpr int kDeepestParts = 8;  // each mirror doubles the work below it

Range length() { return above(0).at_most(kLargestCoordinate); }
Range length_or_zero() { return at_most(kLargestCoordinate); }

Point read_point(Reader& reader, std::string_view key, std::optional<Vec3> fallback = {}) {
  return to_point(reader.vector<3>(key, coordinate(), fallback));
}

// Reads a closed polygon of at least three different points, smoothed if the scene asks for it.
std::vector<Point2> read_outline(Reader& reader, std::string_view key, bool radii) {
  const std::vector<double> flat = reader.rows(key, 2, 3, kMostPoints, coordinate());
  std::vector<Point2> points;
  std::set<std::pair<double, double>> different;
  for (std::size_t i = 0; i < flat.size(); i += 2) {
    if (radii && flat[i] < 0)
      reader.fail(key, fmt::format(".{}.0 = {} is below 0: it is a radius", i / 2, flat[i]));
    points.push_back({flat[i], flat[i + 1]});
    different.emplace(flat[i], flat[i + 1]);
  }
  if (different.size() < 3) reader.fail(key, " must have at least 3 different points");
  if (reader.flag("smooth", false)) points = smooth_outline(points);
  if (radii)
    for (Point2& point : points) point.x = std::max(point.x, 0.0);  // the curve may swing past the axis
  return points;
}

ShapePtr read_box(Reader& reader) {
  const Point size = to_point(reader.vector<3>("size", length()));
  const double limit = std::min({size.x, size.y, size.z}) / 2;
  return make_box(size, reader.number("round", at_most(limit).because("half the least side"), 0.0));
}

ShapePtr read_extrude(Reader& reader) {
  const std::vector<Point2> outline = read_outline(reader, "outline", false);
  Extrusion extrusion;
  extrusion.depth = reader.number("depth", length());
  extrusion.rounding = reader.number("round", at_most(extrusion.depth / 2).because("half the depth"), 0.0);
  extrusion.bulge = reader.number("bulge", length_or_zero(), 0.0);
  extrusion.bulge_width = reader.number("bulge_width", length(), std::max(1.0, 3 * extrusion.bulge));
  return make_extrude(Polygon(outline), extrusion);
}

ShapePtr read_capsule(Reader& reader) {
  TubePoint from{read_point(reader, "from", Vec3{}), reader.number("radius", length())};
  return make_tube(
      {from, {read_point(reader, "to"), reader.number("radius_end", length_or_zero(), from.radius)}});
}

ShapePtr read_tube(Reader& reader) {
  const std::vector<double> flat = reader.rows("path", 4, 1, kMostPoints, coordinate());
  std::vector<TubePoint> points;
  for (std::size_t i = 0; i < flat.size(); i += 4) {
    if (!(flat[i + 3] > 0))
      reader.fail("path", fmt::format(".{}.3 = {} must be more than 0: it is a radius", i / 4, flat[i + 3]));
    points.push_back({{flat[i], flat[i + 1], flat[i + 2]}, flat[i + 3]});
  }
  return make_tube(std::move(points));
}

ShapePtr read_shape(Reader& reader, const std::string& name, int depth);

ShapePtr read_csg(Reader& reader, int depth) {
  if (depth == kDeepestParts)
    reader.fail("shape", fmt::format(" = \"csg\" is nested more than {} deep", kDeepestParts));
  const auto operation = static_cast<Operation>(reader.choice("op", {"union", "intersection", "difference"}));
  std::vector<Reader> parts = reader.tables("parts");
  if (parts.empty()) reader.fail("parts", reader.has("parts") ? " is empty" : " is missing");
  std::vector<ShapePtr> shapes;
  for (Reader& part : parts) {
    const std::string name = shape_names()[part.choice("shape", shape_names())];
    shapes.push_back(read_shape(part, name, depth + 1));
    part.finish();
  }
  return make_csg(operation, std::move(shapes));
}

ShapePtr read_bare_shape(Reader& reader, const std::string& name, int depth) {
  if (name == "sphere") return make_sphere(reader.number("radius", length()));
  if (name == "box") return read_box(reader);
  if (name == "cylinder")
    return make_cylinder(reader.number("radius", length()), reader.number("height", length()));
  if (name == "cone")
    return make_cone(reader.number("radius", length()), reader.number("radius_top", length_or_zero(), 0.0),
                     reader.number("height", length()));
  if (name == "ellipsoid") return make_ellipsoid(to_point(reader.vector<3>("radii", length())));
  if (name == "torus") return make_torus(reader.number("radius", length()), reader.number("tube", length()));
  if (name == "capsule") return read_capsule(reader);
  if (name == "tube") return read_tube(reader);
  if (name == "revolve") return make_revolve(Polygon(read_outline(reader, "profile", true)));
  if (name == "extrude") return read_extrude(reader);
  return read_csg(reader, depth);
}

Point read_scale(Reader& reader) {
  const Range range = at_least(0.001).at_most(1000);
  const Value::Kind array = Value::Kind::array;
  if (reader.has("scale") && reader.kind("scale") != array) {
    const double all = reader.number("scale", range);
    return {all, all, all};
  }
  return to_point(reader.vector<3>("scale", range, Vec3{1, 1, 1}));
}

ShapePtr read_shape(Reader& reader, const std::string& name, int depth) {
  ShapePtr shape = read_bare_shape(reader, name, depth);
  if (reader.has("mirror"))
    shape = make_mirrored(std::move(shape), static_cast<int>(reader.choice("mirror", {"x", "y", "z"})));
  const Placement placement{read_point(reader, "at", Vec3{}),
                            Rotation(reader.vector<3>("rotate", within(kFullTurn), Vec3{})),
                            read_scale(reader)};
  return make_placed(std::move(shape), placement);
}

}  // namespace

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names{"sphere",  "box",  "cylinder", "cone",    "ellipsoid", "torus",
                                              "capsule", "tube", "revolve",  "extrude", "csg"};
  return names;
}

ShapePtr read_shape(Reader& reader, const std::string& name) { return read_shape(reader, name, 0); }

}  // namespace voxmelt::scene
