#include "kernel/scene/mesh_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "kernel/scene/look.h"
#include "kernel/scene/mesh_file/mesh_file.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

constexpr double kLargestScale = 1e9;

// Says where a mesh comes to stand, and how large. The middle of its underside comes to `at`.
struct Stand {
  Point at;
  double scale = 1;
};

// Returns the length of the file's unit in metres, or 1 if none is named.
double read_unit(Reader& reader) {
  if (!reader.has("unit")) return 1;
  constexpr std::array metres{1.0, 0.01, 0.001, 0.0254, 0.3048};
  const double metre = metres[reader.choice("unit", {"m", "cm", "mm", "in", "ft"})];
  if (!reader.has("scale")) reader.fail("unit", " needs scale, which counts cells per metre then");
  return metre;
}

// Makes the mesh as large as the grid has room for, and sets it down in the middle.
Stand read_fit(Reader& reader, Reader& fit, const std::filesystem::path& file, const Box& box,
               state::Grid grid) {
  for (const char* key : {"height", "scale", "at"})
    if (reader.has(key)) reader.fail(key, " and fit exclude each other");
  const double margin = fit.number("margin", at_most(kLargestMeshCoordinate), 2.0);
  const double floor = fit.number("floor", at_most(grid.y).because("the height of the grid"), 0.0);
  fit.finish();
  const std::array room{grid.x - 2 * margin, grid.y - floor - margin, grid.z - 2 * margin};
  if (std::min({room[0], room[1], room[2]}) <= 0)
    reader.fail("fit", fmt::format(": a margin of {} and a floor of {} leave no room", margin, floor));
  const Point size = box.high - box.low;
  double scale = std::numeric_limits<double>::infinity();
  for (const auto& [side, space] : {std::pair{size.x, room[0]}, {size.y, room[1]}, {size.z, room[2]}})
    if (side > 0) scale = std::min(scale, space / side);
  if (!std::isfinite(scale)) reader.fail("fit", ": " + file.string() + " has no size to fit");
  return {{grid.x / 2.0, floor, grid.z / 2.0}, scale};
}

Stand read_stand(Reader& reader, const std::filesystem::path& file, const Box& box, state::Grid grid) {
  const double metre = read_unit(reader);
  if (std::optional<Reader> fit = reader.table("fit")) return read_fit(reader, *fit, file, box, grid);
  const bool by_height = reader.has("height"), by_scale = reader.has("scale");
  if (by_height && by_scale) reader.fail("scale", " and height exclude each other");
  const double wanted = reader.number(by_scale ? "scale" : "height", above(0).at_most(kLargestScale));
  const Point at = to_point(reader.vector<3>("at", coordinate(), Vec3{}));
  const double tall = box.high.y - box.low.y;
  if (by_height && !(tall > 0)) reader.fail("height", ": " + file.string() + " has no height to scale");
  return {at, by_scale ? wanted * metre : wanted / tall};
}

}  // namespace

void read_mesh_entry(Reader& reader, state::Grid grid, Entry& entry) {
  const std::filesystem::path file = reader.file("file");
  entry.mesh_file = file.filename().string();
  entry.inside = static_cast<Inside>(reader.choice("inside", {"winding", "parity"}, 0));
  const bool z_is_up = reader.choice("up", {"y", "z"}, 0) == 1;
  const Rotation rotation(reader.vector<3>("rotate", within(kFullTurn), Vec3{}));
  Mesh mesh = read_mesh(file, reader.place("file"));
  if (reader.has("part")) mesh = part_of(mesh, reader.text("part"), file, reader.place("part"));

  // It is turned, scaled, then set down.
  for (Point& v : mesh.vertices) v = rotation.apply(z_is_up ? Point{v.x, v.z, -v.y} : v);
  const Box box = mesh.bounds();
  const Stand stand = read_stand(reader, file, box, grid);
  const Point foot{(box.low.x + box.high.x) / 2, box.low.y, (box.low.z + box.high.z) / 2};
  for (Point& vertex : mesh.vertices) vertex = (vertex - foot) * stand.scale + stand.at;
  for (const std::uint32_t corner : mesh.corners) {
    const Point& p = mesh.vertices[corner];
    if (!(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kLargestMeshCoordinate))
      reader.fail("file",
                  fmt::format(": {} reaches farther than {} cells", file.string(), kLargestMeshCoordinate));
  }
  entry.mesh = std::move(mesh);
}

}  // namespace voxmelt::scene
