#include "kernel/run/io/surface_files.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "kernel/run/io/file_writer.h"
#include "kernel/run/io/surface.h"

namespace voxmelt::io {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Collects bytes, little endian as all machines that run voxmelt, and hands them on in large pieces.
class Bytes {
 public:
  Bytes(const std::filesystem::path& place, const Poll& poll) : file_(place), poll_(poll) {}

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void add(Number number) {
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    add(std::string_view(bytes, sizeof number));
  }
  void add(const std::array<float, 3>& place) {
    for (const float number : place) add(number);
  }
  void add(std::string_view text) {
    bytes_ += text;
    if (bytes_.size() >= kPiece) flush();
  }
  void commit() {
    flush();
    file_.commit();
  }

 private:
  void flush() {
    file_.write(bytes_);
    bytes_.clear();
    if (poll_) poll_();
  }

  static constexpr std::size_t kPiece = std::size_t{1} << 20;
  FileWriter file_;
  const Poll& poll_;
  std::string bytes_;
};

// Adds a blank, and the least number of decimal digits that give the number back.
template <class Number>
void add_word(Bytes& file, Number number) {
  std::array<char, 32> word{' '};
  const char* const end = std::to_chars(word.data() + 1, word.data() + word.size(), number).ptr;
  file.add(std::string_view(word.data(), static_cast<std::size_t>(end - word.data())));
}

std::array<float, 3> normal_of(const Surface& surface, const Triangle& triangle) {
  const auto &a = surface.vertices[triangle[0]].at, &b = surface.vertices[triangle[1]].at,
             &c = surface.vertices[triangle[2]].at;
  std::array<double, 3> normal{};
  double square = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    normal[i] = (double{b[j]} - a[j]) * (double{c[k]} - a[k]) - (double{b[k]} - a[k]) * (double{c[j]} - a[j]);
    square += normal[i] * normal[i];
  }
  const double length = square > 0 ? std::sqrt(square) : 1;
  return {static_cast<float>(normal[0] / length), static_cast<float>(normal[1] / length),
          static_cast<float>(normal[2] / length)};
}

}  // namespace

void export_ply(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  const Surface surface = surface_of(moment, poll);
  Bytes file(folder / "surface.ply", poll);
  file.add("ply\nformat binary_little_endian 1.0\nelement vertex");
  add_word(file, surface.vertices.size());
  file.add(
      "\nproperty float x\nproperty float y\nproperty float z\nproperty ushort heat\n"
      "property uchar material\nproperty uchar liquid\nelement face");
  add_word(file, surface.triangles.size());
  file.add("\nproperty list uchar uint vertex_indices\nend_header\n");
  for (const SurfaceVertex& vertex : surface.vertices) {
    file.add(vertex.at);
    file.add(vertex.heat);
    file.add(vertex.material);
    file.add(vertex.liquid);
  }
  for (const Triangle& triangle : surface.triangles) {
    file.add(std::uint8_t{3});
    for (const std::uint32_t vertex : triangle) file.add(vertex);
  }
  file.commit();
}

void export_stl(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  const Surface surface = surface_of(moment, poll);
  Bytes file(folder / "surface.stl", poll);
  std::string head = "binary STL of voxmelt";  // a head that begins with "solid" would mean text
  head.resize(80, ' ');
  file.add(head);
  file.add(static_cast<std::uint32_t>(surface.triangles.size()));
  for (const Triangle& triangle : surface.triangles) {
    file.add(normal_of(surface, triangle));
    for (const std::uint32_t vertex : triangle) file.add(surface.vertices[vertex].at);
    file.add(std::uint16_t{0});
  }
  file.commit();
}

void export_obj(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  const Surface surface = surface_of(moment, poll);
  Bytes file(folder / "surface.obj", poll);
  for (const SurfaceVertex& vertex : surface.vertices) {
    file.add("v");
    for (const float number : vertex.at) add_word(file, number);
    file.add("\n");
  }
  for (const Triangle& triangle : surface.triangles) {
    file.add("f");
    for (const std::uint32_t vertex : triangle) add_word(file, std::uint64_t{vertex} + 1);
    file.add("\n");
  }
  file.commit();
}

}  // namespace voxmelt::io
