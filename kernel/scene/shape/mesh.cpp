#include "kernel/scene/shape/mesh.h"

#include <fmt/format.h>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string>

#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestMeshFile = std::size_t{1} << 30;

// tinyobjloader forgives malformed lines and does not say where they are, so each line is checked first.
class LineCheck {
 public:
  LineCheck(const std::string& file, const Place& place) : file_(file), place_(place) {}

  void check(const std::string& text) {
    std::istringstream lines(text);
    std::string line, first;
    while (std::getline(lines, line)) {
      ++number_;
      std::istringstream words(line);
      if (!(words >> first)) continue;
      if (first == "v") vertex(words);
      if (first == "f") face(words);
    }
    if (vertices_ == 0) fail_at(place_, fmt::format("{}: the mesh has no vertices", file_));
    if (faces_ == 0) fail_at(place_, fmt::format("{}: the mesh has no faces", file_));
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    fail_at(place_, fmt::format("{}:{}: {}", file_, number_, message));
  }

  void vertex(std::istringstream& words) {
    std::string word;
    for (int i = 0; i < 3; ++i) {
      if (!(words >> word)) fail("a vertex needs 3 coordinates: is the file truncated?");
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end != '\0' || !std::isfinite(value) || std::abs(value) > 1e30)
        fail(fmt::format("'{}' is not a coordinate", word.substr(0, 40)));
    }
    ++vertices_;
  }

  void face(std::istringstream& words) {
    std::string word;
    int corners = 0;
    for (; words >> word; ++corners) {
      char* end = nullptr;
      const long long index = std::strtoll(word.c_str(), &end, 10);
      if (end == word.c_str() || (*end != '\0' && *end != '/'))
        fail(fmt::format("'{}' is not a vertex of a face", word.substr(0, 40)));
      const bool known = index > 0 ? index <= vertices_ : index < 0 && index >= -vertices_;
      if (!known)
        fail(fmt::format("a face names vertex {}, but {} vertices are known here", index, vertices_));
    }
    if (corners < 3) fail(fmt::format("a face needs 3 corners, not {}: is the file truncated?", corners));
    ++faces_;
  }

  const std::string& file_;
  const Place& place_;
  long long number_ = 0, vertices_ = 0, faces_ = 0;
};

// Only what shapes need is checked: materials, normals and texture coordinates can be wrong without harm.
std::string only_vertices_and_faces(const std::string& text) {
  std::istringstream lines(text);
  std::string line, word, result;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    if (!(words >> word) || (word != "v" && word != "f")) continue;
    result += word;
    while (words >> word) result += ' ' + word.substr(0, word.find('/'));
    result += '\n';
  }
  return result;
}

}  // namespace

Box Mesh::bounds() const {
  const Point first = vertices[triangles.front()[0]];
  Box box{first, first};
  for (const auto& triangle : triangles)
    for (const std::uint32_t vertex : triangle) box.include(vertices[vertex]);
  return box;
}

Mesh read_mesh(const std::filesystem::path& file, const Place& place) {
  const std::string name = file.string();
  const std::string text = read_text_file(file, kLargestMeshFile, place.text());
  LineCheck(name, place).check(text);

  std::istringstream stream(only_vertices_and_faces(text));
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr, true))
    fail_at(place, fmt::format("{}: {}", name, error));

  Mesh mesh;
  for (std::size_t i = 0; i + 2 < attributes.vertices.size(); i += 3) {
    const auto coordinate = [&](std::size_t k) { return static_cast<double>(attributes.vertices[i + k]); };
    mesh.vertices.push_back({coordinate(0), coordinate(1), coordinate(2)});
  }
  for (const tinyobj::shape_t& shape : shapes) {
    const auto& indices = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
      mesh.triangles.push_back({static_cast<std::uint32_t>(indices[i].vertex_index),
                                static_cast<std::uint32_t>(indices[i + 1].vertex_index),
                                static_cast<std::uint32_t>(indices[i + 2].vertex_index)});
  }
  if (mesh.triangles.empty()) fail_at(place, fmt::format("{}: the mesh has no triangles", name));
  return mesh;
}

}  // namespace voxmelt::scene
