// glTF 2.0 as one binary file: a head, a chunk of JSON, and a chunk of numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "kernel/run/io/file_writer.h"
#include "kernel/run/io/surface.h"
#include "kernel/run/io/surface_files.h"

namespace voxmelt::io {
namespace {

enum Kind { kUnsigned = 5125, kFloat = 5126 };          // numbers of glTF for types
enum Target { kVertices = 34962, kTriangles = 34963 };  // and for what a buffer serves

template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

// Describes arrays of 32 bits a number that follow each other, in the words of glTF.
struct Layout {
  std::string accessors, views;  // each with commas between
  std::uint64_t bytes = 0;
  int count = 0;

  // `more` are further members of the accessor.
  void add(const char* type, Kind kind, std::size_t items, int numbers, Target target,
           const std::string& more = {}) {
    const std::uint64_t size = std::uint64_t{items} * numbers * 4;
    const char* comma = count == 0 ? "" : ",";
    views += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})", comma, bytes,
                         size, static_cast<int>(target));
    accessors += fmt::format(R"({}{{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})", comma,
                             count, static_cast<int>(kind), items, type, more);
    bytes += size;
    ++count;
  }
};

// Returns the box around the vertices, as glTF wants it of positions.
std::string box_of(const Surface& surface) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};  // as exact as the vertices
  for (const SurfaceVertex& vertex : surface.vertices)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min<double>(low[i], vertex.at[i]);
      high[i] = std::max<double>(high[i], vertex.at[i]);
    }
  return fmt::format(R"(,"min":[{},{},{}],"max":[{},{},{}])", low[0], low[1], low[2], high[0], high[1],
                     high[2]);
}

std::string head_of(const Surface& surface, Layout& layout) {
  const char* const begin =
      R"({"asset":{"version":"2.0","generator":"voxmelt"},"scene":0,"scenes":[{"nodes":)";
  const std::size_t vertices = surface.vertices.size();
  if (vertices == 0) return std::string(begin) + "[]}]}";  // glTF has no empty mesh
  layout.add("VEC3", kFloat, vertices, 3, kVertices, box_of(surface));
  for (int attribute = 0; attribute < 3; ++attribute) layout.add("SCALAR", kFloat, vertices, 1, kVertices);
  layout.add("SCALAR", kUnsigned, surface.triangles.size() * 3, 1, kTriangles);
  return fmt::format(
      R"({}[0]}}],"nodes":[{{"mesh":0,"name":"matter"}}],"meshes":[{{"primitives":[{{"attributes":)"
      R"({{"POSITION":0,"_HEAT":1,"_MATERIAL":2,"_LIQUID":3}},"indices":4}}]}}],"accessors":[{}],)"
      R"("bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
      begin, layout.accessors, layout.views, layout.bytes);
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
  std::string head = head_of(surface, layout);
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
