#include "kernel/scene/mesh_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "kernel/scene/look.h"
#include "kernel/scene/mesh_file/mesh_file.h"
#include "kernel/scene/stand.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

Stand read_stand(Reader& reader, const std::filesystem::path& file, const Box& box, state::Grid grid) {
  const double metre = read_unit(reader);
  if (const std::optional<Stand> fit = read_fit(reader, file, box, grid)) return *fit;
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
