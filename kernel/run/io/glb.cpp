// glTF 2.0 as one binary file: a head, a chunk of JSON, and a chunk of numbers.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "kernel/run/io/file_writer.h"
#include "kernel/run/io/surface.h"
#include "kernel/run/io/surface_files.h"

namespace voxmelt::io {
namespace {

using json = nlohmann::ordered_json;

enum Kind { kUnsigned = 5125, kFloat = 5126 };          // numbers of glTF for types
enum Target { kVertices = 34962, kTriangles = 34963 };  // and for what a buffer serves

template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

// Describes arrays of 32 bits a number that follow each other.
struct Layout {
  json accessors = json::array(), views = json::array();
  std::uint64_t bytes = 0;

  void add(const char* type, Kind kind, std::size_t count, int numbers, Target target) {
    const std::uint64_t size = std::uint64_t{count} * numbers * 4;
    views.push_back({{"buffer", 0}, {"byteOffset", bytes}, {"byteLength", size}, {"target", target}});
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", kind}, {"count", count}, {"type", type}});
    bytes += size;
  }
};

json head_of(const Surface& surface, Layout& layout) {
  const std::size_t vertices = surface.vertices.size();
  json head{{"asset", {{"version", "2.0"}, {"generator", "voxmelt"}}}, {"scene", 0}};
  head["scenes"] = json::array({{{"nodes", json::array()}}});
  if (vertices == 0) return head;  // glTF has no empty mesh
  layout.add("VEC3", kFloat, vertices, 3, kVertices);
  for (int attribute = 0; attribute < 3; ++attribute) layout.add("SCALAR", kFloat, vertices, 1, kVertices);
  layout.add("SCALAR", kUnsigned, surface.triangles.size() * 3, 1, kTriangles);
  std::array<float, 3> low = surface.vertices[0].at, high = low;
  for (const SurfaceVertex& vertex : surface.vertices)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], vertex.at[i]);
      high[i] = std::max(high[i], vertex.at[i]);
    }
  layout.accessors[0]["min"] = low;
  layout.accessors[0]["max"] = high;
  head["scenes"][0]["nodes"].push_back(0);
  head["nodes"] = json::array({{{"mesh", 0}, {"name", "matter"}}});
  const json attributes{{"POSITION", 0}, {"_HEAT", 1}, {"_MATERIAL", 2}, {"_LIQUID", 3}};
  head["meshes"] =
      json::array({{{"primitives", json::array({{{"attributes", attributes}, {"indices", 4}}})}}});
  head["accessors"] = layout.accessors;
  head["bufferViews"] = layout.views;
  head["buffers"] = json::array({{{"byteLength", layout.bytes}}});
  return head;
}

std::string numbers_of(const Surface& surface) {
  std::string bytes;
  for (const SurfaceVertex& vertex : surface.vertices)
    for (const float number : vertex.at) append(bytes, number);
  for (const SurfaceVertex& vertex : surface.vertices) append(bytes, static_cast<float>(vertex.heat));
  for (const SurfaceVertex& vertex : surface.vertices) append(bytes, static_cast<float>(vertex.material));
  for (const SurfaceVertex& vertex : surface.vertices) append(bytes, static_cast<float>(vertex.liquid));
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t vertex : triangle) append(bytes, vertex);
  return bytes;
}

std::string chunk_head(std::size_t size, const char* type) {
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(size));
  return bytes.append(type, 4);
}

}  // namespace

void export_glb(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  const Surface surface = surface_of(moment.volume, poll);
  Layout layout;
  std::string head = head_of(surface, layout).dump();
  head.resize((head.size() + 3) / 4 * 4, ' ');
  const std::filesystem::path place = folder / "surface.glb";
  const std::uint64_t size = 12 + 8 + head.size() + (layout.bytes > 0 ? 8 + layout.bytes : 0);
  if (size > std::numeric_limits<std::uint32_t>::max())
    fail_output(place, "glb holds 4 GiB, and this surface takes more; ply takes any", EFBIG);
  FileWriter file(place);
  std::string begin = "glTF";
  append(begin, std::uint32_t{2});
  append(begin, static_cast<std::uint32_t>(size));
  file.write(begin.append(chunk_head(head.size(), "JSON")).append(head));
  if (layout.bytes > 0) file.write(chunk_head(layout.bytes, "BIN\0").append(numbers_of(surface)));
  file.commit();
}

}  // namespace voxmelt::io
