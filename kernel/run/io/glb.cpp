// glTF 2.0 as one binary file: a head, a chunk of JSON, and a chunk of numbers.
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
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
    views.append(comma).append(R"({"buffer":0,"byteOffset":)").append(std::to_string(bytes));
    views.append(R"(,"byteLength":)").append(std::to_string(size));
    views.append(R"(,"target":)").append(std::to_string(target)).append("}");
    accessors.append(comma).append(R"({"bufferView":)").append(std::to_string(count));
    accessors.append(R"(,"componentType":)").append(std::to_string(kind));
    accessors.append(R"(,"count":)").append(std::to_string(items));
    accessors.append(R"(,"type":")").append(type).append("\"").append(more).append("}");
    bytes += size;
    ++count;
  }
};

// Returns a corner of the box around the vertices. It is as exact as they are.
template <class Which>  // which(a, b): tells if a is beyond b
std::string corner_of(const Surface& surface, const Which& which) {
  std::string text = "[";
  for (std::size_t i = 0; i < 3; ++i) {
    float most = surface.vertices[0].at[i];
    for (const SurfaceVertex& vertex : surface.vertices)
      if (which(vertex.at[i], most)) most = vertex.at[i];
    std::array<char, 32> digits;
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<double>(most)).ptr;
    text.append(i == 0 ? "" : ",").append(digits.data(), end);
  }
  return text + "]";
}

std::string head_of(const Surface& surface, Layout& layout) {
  std::string head = R"({"asset":{"version":"2.0","generator":"voxmelt"},"scene":0,"scenes":[{"nodes":[)";
  const std::size_t vertices = surface.vertices.size();
  if (vertices == 0) return head + "]}]}";  // glTF has no empty mesh
  const std::string box =
      R"(,"min":)" + corner_of(surface, std::less<>()) + R"(,"max":)" + corner_of(surface, std::greater<>());
  layout.add("VEC3", kFloat, vertices, 3, kVertices, box);
  for (int attribute = 0; attribute < 3; ++attribute) layout.add("SCALAR", kFloat, vertices, 1, kVertices);
  layout.add("SCALAR", kUnsigned, surface.triangles.size() * 3, 1, kTriangles);
  head.append(R"(0]}],"nodes":[{"mesh":0,"name":"matter"}],"meshes":[{"primitives":[{"attributes":)");
  head.append(R"({"POSITION":0,"_HEAT":1,"_MATERIAL":2,"_LIQUID":3},"indices":4}]}],"accessors":[)");
  head.append(layout.accessors).append(R"(],"bufferViews":[)").append(layout.views);
  head.append(R"(],"buffers":[{"byteLength":)").append(std::to_string(layout.bytes)).append("}]}");
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
  const Surface surface = surface_of(moment, poll);
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
