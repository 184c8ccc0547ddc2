// The reader of glTF 2. A mesh stands where the nodes of the scene put it. Skins, morph targets and all that
// has no place (materials, cameras, animations) are passed over.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/scene/mesh_file/formats.h"
#include "kernel/scene/mesh_file/gltf_data.h"

namespace voxmelt::scene {
namespace {

// A small file may put one mesh in many places.
constexpr std::uint64_t kMostCorners = 100'000'000;

enum Mode : std::uint64_t { kTriangles = 4, kStrip = 5, kFan = 6 };

// Maps points: its first three columns turn and stretch, the last one moves.
struct Affine {
  std::array<Point, 4> columns{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{0, 0, 0}};

  Point turn(Point p) const { return columns[0] * p.x + columns[1] * p.y + columns[2] * p.z; }
  Point apply(Point p) const { return turn(p) + columns[3]; }
  // Tells if it turns bodies inside out, as a mirror does.
  bool mirrors() const {
    const Point &a = columns[0], &b = columns[1], &c = columns[2];
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x) < 0;
  }
};

Affine operator*(const Affine& outer, const Affine& inner) {
  Affine result;
  for (std::size_t i = 0; i < 3; ++i) result.columns[i] = outer.turn(inner.columns[i]);
  result.columns[3] = outer.apply(inner.columns[3]);
  return result;
}

class GltfReader {
 public:
  explicit GltfReader(GltfData& data) : data_(data), nodes_(data.objects(data.root(), "nodes")) {}

  Mesh read() {
    walk();
    check_size();
    for (const auto& [node, placement] : instances_) put(node, placement);
    if (mesh_.vertices.empty()) data_.fail("", "the mesh has no vertices");
    if (mesh_.ends.empty()) data_.fail("", "the mesh has no faces");
    return std::move(mesh_);
  }

 private:
  // Returns the numbers of the nodes that stand in no other one: those of the scene, or of a file without
  // one.
  std::vector<std::uint64_t> roots() {
    const GltfValue root = data_.root();
    if (data_.has(root, "scenes"))
      return data_.wholes(data_.listed("scenes", data_.whole(root, "scene", 0), "scene"), "nodes");
    std::vector<bool> within(nodes_.size());
    for (const GltfValue& node : nodes_)
      for (const std::uint64_t child : data_.wholes(node, "children"))
        if (child < within.size()) within[child] = true;
    std::vector<std::uint64_t> result;
    for (std::uint64_t i = 0; i < within.size(); ++i)
      if (!within[i]) result.push_back(i);
    return result;
  }

  // Visits each node once. A node within itself, or within two others, is refused. No depth is too deep.
  void walk() {
    std::vector<bool> seen(nodes_.size());
    std::vector<std::pair<std::uint64_t, Affine>> left;
    const auto take = [&](const std::vector<std::uint64_t>& numbers, const Affine& outer) {
      for (std::size_t i = numbers.size(); i > 0; --i) left.emplace_back(numbers[i - 1], outer);
    };
    take(roots(), {});
    while (!left.empty()) {
      const auto [number, outer] = left.back();
      left.pop_back();
      const GltfValue node = data_.listed("nodes", number, "nodes");
      if (seen[number]) data_.fail(node.path, "stands within itself, or in two places");
      seen[number] = true;
      const Affine here = outer * placement_of(node);
      if (data_.has(node, "mesh")) instances_.emplace_back(node, here);
      take(data_.wholes(node, "children"), here);
    }
  }

  Affine placement_of(const GltfValue& node) const {
    Affine result;
    if (data_.has(node, "matrix")) {
      const std::vector<double> m = data_.numbers(node, "matrix", 16);
      for (std::size_t i = 0; i < 4; ++i) result.columns[i] = {m[4 * i], m[4 * i + 1], m[4 * i + 2]};
      return result;
    }
    if (data_.has(node, "rotation")) {
      const std::vector<double> q = data_.numbers(node, "rotation", 4);
      const double x = q[0], y = q[1], z = q[2], w = q[3];
      result.columns[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
      result.columns[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
      result.columns[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    }
    if (data_.has(node, "scale")) {
      const std::vector<double> scale = data_.numbers(node, "scale", 3);
      for (std::size_t i = 0; i < 3; ++i) result.columns[i] = result.columns[i] * scale[i];
    }
    if (data_.has(node, "translation")) {
      const std::vector<double> move = data_.numbers(node, "translation", 3);
      result.columns[3] = {move[0], move[1], move[2]};
    }
    return result;
  }

  GltfValue mesh_of(const GltfValue& node) const {
    return data_.listed("meshes", data_.whole(node, "mesh"), node.path + ".mesh");
  }

  // Fails if all instances have too many corners together, before memory is taken for them.
  void check_size() const {
    std::map<std::string, std::uint64_t> known;  // corners of the mesh with this path
    std::uint64_t all = 0;
    for (const auto& [node, placement] : instances_) {
      const GltfValue mesh = mesh_of(node);
      const auto [entry, is_new] = known.try_emplace(mesh.path);
      if (is_new) entry->second = corners_of(mesh);
      all += entry->second;
      if (all > kMostCorners) data_.fail("", fmt::format("more than {} corners", kMostCorners));
    }
  }
  std::uint64_t corners_of(const GltfValue& mesh) const {
    std::uint64_t corners = 0;
    for (const GltfValue& primitive : data_.objects(mesh, "primitives")) {
      const GltfValue attributes = data_.object(primitive, "attributes");
      for (const auto& [holder, key] : {std::pair(attributes, "POSITION"), std::pair(primitive, "indices")}) {
        if (!data_.has(holder, key)) continue;
        const GltfValue accessor =
            data_.listed("accessors", data_.whole(holder, key), holder.path + "." + key);
        corners += std::min(data_.whole(accessor, "count"), kMostCorners + 1);
      }
    }
    return std::min(corners, kMostCorners + 1);
  }

  void put(const GltfValue& node, const Affine& placement) {
    const GltfValue mesh = mesh_of(node);
    const std::string name = data_.text(node, "name");
    mesh_.parts.push_back({name.empty() ? data_.text(mesh, "name") : name, mesh_.faces()});
    std::map<std::uint64_t, std::uint32_t> first_vertices;  // of accessors that primitives share
    for (const GltfValue& primitive : data_.objects(mesh, "primitives")) {
      const std::uint64_t mode = data_.whole(primitive, "mode", kTriangles);
      if (mode < kTriangles) continue;  // points and lines
      if (mode > kFan) data_.fail(primitive.path + ".mode", fmt::format("{} is none of 0 to 6", mode));
      const std::uint64_t accessor = data_.whole(data_.object(primitive, "attributes"), "POSITION");
      const GltfData::Numbers points =
          data_.accessor(accessor, "VEC3", 3, primitive.path + ".attributes.POSITION");
      const auto [first, is_new] =
          first_vertices.try_emplace(accessor, static_cast<std::uint32_t>(mesh_.vertices.size()));
      if (is_new) vertices(points, placement, primitive.path);
      faces(primitive, mode, points.rows, first->second, placement.mirrors());
    }
  }

  void vertices(const GltfData::Numbers& points, const Affine& placement, const std::string& path) {
    for (std::size_t row = 0; row < points.rows; ++row) {
      const Point p = placement.apply({points.at(row, 0), points.at(row, 1), points.at(row, 2)});
      if (!is_coordinate(p.x) || !is_coordinate(p.y) || !is_coordinate(p.z))
        data_.fail(path, fmt::format("vertex {} is at {}, {}, {}, which is no place", row, p.x, p.y, p.z));
      mesh_.vertices.push_back(p);
    }
  }

  void faces(const GltfValue& primitive, std::uint64_t mode, std::uint64_t known, std::uint32_t first,
             bool turned) {
    std::optional<GltfData::Numbers> indices;
    const std::string path = primitive.path + ".indices";
    if (data_.has(primitive, "indices")) {
      indices = data_.accessor(data_.whole(primitive, "indices"), "SCALAR", 1, path);
      if (indices->type == GltfData::kFloat || indices->normalised) data_.fail(path, "must be whole numbers");
    }
    const std::uint64_t rows = indices ? indices->rows : known;
    if (mode == kTriangles && rows % 3 != 0)
      data_.fail(path, fmt::format("{} corners are no triangles: is it truncated?", rows));
    const std::uint64_t triangles = mode == kTriangles ? rows / 3 : rows < 3 ? 0 : rows - 2;
    const auto corner = [&](std::uint64_t row) {
      const double index = indices ? indices->at(row, 0) : static_cast<double>(row);
      if (index < 0 || index >= static_cast<double>(known))
        data_.fail(path,
                   fmt::format("corner {} is vertex {}, and there are {}, from 0 on", row, index, known));
      return first + static_cast<std::uint32_t>(index);
    };
    for (std::uint64_t t = 0; t < triangles; ++t) {
      std::array<std::uint64_t, 3> rows_of{3 * t, 3 * t + 1, 3 * t + 2};
      if (mode == kStrip) rows_of = {t, t + 1 + t % 2, t + 2 - t % 2};
      if (mode == kFan) rows_of = {t + 1, t + 2, 0};
      if (turned) std::swap(rows_of[1], rows_of[2]);
      for (const std::uint64_t row : rows_of) mesh_.corners.push_back(corner(row));
      mesh_.ends.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
    }
  }

  GltfData& data_;
  std::vector<GltfValue> nodes_;
  std::vector<std::pair<GltfValue, Affine>> instances_;  // nodes with meshes, and where they stand
  Mesh mesh_;
};

}  // namespace

Mesh read_gltf(std::string_view bytes, const std::string& file, const Place& place) {
  GltfData data(bytes, file, place);
  return GltfReader(data).read();
}

}  // namespace voxmelt::scene
