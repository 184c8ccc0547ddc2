#include "kernel/scene/mesh_file/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/scene/mesh_file/formats.h"
#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/suggestion.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

struct MeshFormat {
  std::string_view ending;
  Mesh (*read)(std::string_view bytes, const std::string& file, const Place& place);
};

constexpr std::array kMeshFormats{MeshFormat{".obj", read_obj}, MeshFormat{".stl", read_stl},
                                  MeshFormat{".ply", read_ply}, MeshFormat{".glb", read_gltf},
                                  MeshFormat{".gltf", read_gltf}};

// Returns the format, or null.
const MeshFormat* format_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), lower_case);
  for (const MeshFormat& format : kMeshFormats)
    if (format.ending == ending) return &format;
  return ending.empty() ? kMeshFormats.data() : nullptr;
}

// Says which names there are. A long list is cut.
std::string names_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    text += (i == 0 ? "" : ", ") + in_quotes(names[i]);
  return names.size() > most ? fmt::format("{}, and {} more", text, names.size() - most) : text;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) {
  return file.has_extension() && format_of(file) != nullptr;
}

std::string mesh_endings() {
  std::string endings;
  for (const MeshFormat& format : kMeshFormats)
    endings += fmt::format("{}{}", endings.empty() ? "" : ", ", format.ending);
  return endings;
}

Mesh read_mesh(const std::filesystem::path& file, const Place& place) {
  const std::string name = file.string();
  const MeshFormat* format = format_of(file);
  const std::string bytes = read_text_file(file, kLargestMeshFile, place.text());
  if (format == nullptr)
    fail_at(place, fmt::format("{}: meshes are read from {}, not from {}", name, mesh_endings(),
                               file.extension().string()));
  return format->read(bytes, name, place);
}

Mesh part_of(const Mesh& mesh, const std::string& name, const std::filesystem::path& file,
             const Place& place) {
  Mesh result;
  std::vector<std::uint32_t> number(mesh.vertices.size(), UINT32_MAX);
  std::vector<std::string> names;
  bool is_there = false;
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const std::size_t first = mesh.parts[p].first_face;
    const std::size_t last = p + 1 < mesh.parts.size() ? mesh.parts[p + 1].first_face : mesh.faces();
    if (first == last) continue;
    if (std::find(names.begin(), names.end(), mesh.parts[p].name) == names.end())
      names.push_back(mesh.parts[p].name);
    if (mesh.parts[p].name != name) continue;
    is_there = true;
    for (std::size_t f = first; f < last; ++f) {
      for (const std::uint32_t corner : mesh.face(f)) {
        if (number[corner] == UINT32_MAX) {
          number[corner] = static_cast<std::uint32_t>(result.vertices.size());
          result.vertices.push_back(mesh.vertices[corner]);
        }
        result.corners.push_back(number[corner]);
      }
      result.ends.push_back(static_cast<std::uint32_t>(result.corners.size()));
    }
  }
  if (is_there) return result;
  const std::string near = nearest_name(name, names);
  fail_at(place, fmt::format("{}: it has no part {}; {}", file.string(), in_quotes(name),
                             names.empty()   ? "no part of it has a name"
                             : !near.empty() ? "did you mean " + in_quotes(near) + "?"
                                             : "its parts are " + names_of(names)));
}

}  // namespace voxmelt::scene
