// The reader of STL, as text and as bytes. A file names each corner by its place. Corners at the same place
// become one vertex at once, so that ten million triangles take a third of their file.
#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/scene/mesh_file/formats.h"
#include "kernel/scene/mesh_file/words.h"
#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/bytes.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

// Holds the vertices of a mesh, found by their places.
class Places {
 public:
  explicit Places(std::vector<Point>& vertices) : vertices_(vertices), table_(std::size_t{1} << 10, kFree) {}

  std::uint32_t number_of(Point p) {
    p = {p.x + 0.0, p.y + 0.0, p.z + 0.0};  // -0 is 0
    std::uint32_t& entry = find(p);
    if (entry != kFree) return entry;
    entry = static_cast<std::uint32_t>(vertices_.size());
    const std::uint32_t number = entry;
    vertices_.push_back(p);
    if (2 * vertices_.size() > table_.size()) grow();
    return number;
  }

 private:
  static constexpr std::uint32_t kFree = UINT32_MAX;

  static std::uint64_t hash(const Point& p) {
    std::uint64_t hash = 0;
    for (const double v : {p.x, p.y, p.z}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
  // Returns the entry of a place, or the free one that it may take.
  std::uint32_t& find(const Point& p) {
    const std::size_t mask = table_.size() - 1;
    for (std::size_t i = hash(p) & mask;; i = (i + 1) & mask) {
      if (table_[i] == kFree) return table_[i];
      const Point& other = vertices_[table_[i]];
      if (other.x == p.x && other.y == p.y && other.z == p.z) return table_[i];
    }
  }
  void grow() {
    const std::size_t size = 2 * table_.size();
    table_.assign(size, kFree);
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) find(vertices_[i]) = i;
  }

  std::vector<Point>& vertices_;
  std::vector<std::uint32_t> table_;  // numbers of vertices; its size is a power of two
};

constexpr std::size_t kHeader = 80, kCount = 4, kTriangle = 50;  // bytes

std::size_t triangles_of(std::string_view bytes) {
  return bytes.size() < kHeader + kCount ? 0 : number_at<std::uint32_t>(bytes.substr(kHeader));
}

bool is_binary(std::string_view bytes) {
  return bytes.size() >= kHeader + kCount &&
         bytes.size() == kHeader + kCount + kTriangle * triangles_of(bytes);
}

Mesh read_binary(std::string_view bytes, const std::string& file, const Place& place) {
  const std::size_t triangles = triangles_of(bytes);
  if (triangles == 0) fail_at(place, file + ": the mesh has no faces");
  Mesh mesh;
  Places places(mesh.vertices);
  mesh.corners.reserve(3 * triangles);
  mesh.ends.reserve(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::string_view triangle = bytes.substr(kHeader + kCount + kTriangle * t, kTriangle);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto at = [&](std::size_t axis) {
        const double value = number_at<float>(triangle.substr(12 + 12 * corner + 4 * axis));  // behind normal
        if (!is_coordinate(value))
          fail_at(place, fmt::format("{}: triangle {} of {}: {} is not a coordinate", file, t + 1, triangles,
                                     value));
        return value;
      };
      mesh.corners.push_back(places.number_of({at(0), at(1), at(2)}));
    }
    mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& file, const Place& place)
      : lines_(text), file_(file), place_(place) {}

  Mesh read() {
    while (const std::optional<std::string_view> line = lines_.next()) take(*line);
    if (solid_ || facet_) fail(fmt::format("the file ends within a {}", facet_ ? "facet" : "solid"));
    if (mesh_.faces() == 0) fail_at(place_, file_ + ": the mesh has no faces");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    fail_at(place_, fmt::format("{}:{}: {}", file_, lines_.number(), message));
  }

  void take(std::string_view line) {
    const std::string_view first = take_word(line);
    std::string word(first.substr(0, 16));
    for (char& c : word) c = lower_case(c);
    if (word == "vertex") {
      vertex(line);
    } else if (word == "facet") {
      if (!solid_ || facet_) fail(facet_ ? "a facet within a facet" : "a facet outside of a solid");
      facet_ = true;
    } else if (word == "endfacet") {
      face();
    } else if (word == "solid") {
      if (solid_) fail("a solid within a solid");
      solid_ = true;
      mesh_.parts.push_back({std::string(rest_of(line)), mesh_.faces()});
    } else if (word == "endsolid") {
      if (!solid_ || facet_) fail("an endsolid where no solid can end");
      solid_ = false;
    } else if (word != "outer" && word != "endloop") {
      fail(in_quotes(first) + " begins no line of an STL file");
    }
  }

  void vertex(std::string_view line) {
    if (!facet_) fail("a vertex outside of a facet");
    const auto coordinate = [&] {
      const std::string_view word = take_word(line);
      if (word.empty()) fail("a vertex needs 3 coordinates: is the file truncated?");
      const std::optional<double> value = coordinate_in(word);
      if (!value) fail(fmt::format("{} is not a coordinate", in_quotes(word)));
      return *value;
    };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    mesh_.corners.push_back(places_.number_of({x, y, z}));
  }

  void face() {
    const std::size_t first = mesh_.ends.empty() ? 0 : mesh_.ends.back();
    const std::size_t corners = mesh_.corners.size() - first;
    if (!facet_) fail("an endfacet without a facet");
    if (corners < 3) fail(fmt::format("a facet needs 3 vertices, not {}", corners));
    facet_ = false;
    mesh_.ends.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
  }

  Lines lines_;
  const std::string& file_;
  const Place& place_;
  bool solid_ = false, facet_ = false;  // a line of it has come, and not its end
  Mesh mesh_;
  Places places_{mesh_.vertices};
};

}  // namespace

Mesh read_stl(std::string_view bytes, const std::string& file, const Place& place) {
  if (is_binary(bytes)) return read_binary(bytes, file, place);  // its header may begin with `solid`, too
  const std::string_view text = without_mark(bytes, place, file);
  const bool is_text = text.substr(0, 512).find('\0') == std::string_view::npos;
  if (is_text) return TextReader(text, file, place).read();
  if (bytes.size() < kHeader + kCount)
    fail_at(place, fmt::format("{}: {} bytes are no STL file: is it truncated?", file, bytes.size()));
  const std::size_t triangles = triangles_of(bytes), size = kHeader + kCount + kTriangle * triangles;
  fail_at(place, fmt::format("{}: {} triangles are {} bytes, and the file has {}{}", file, triangles, size,
                             bytes.size(), bytes.size() < size ? ": is it truncated?" : ""));
}

}  // namespace voxmelt::scene
