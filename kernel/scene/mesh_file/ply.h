// The header of a PLY file tells its elements, their properties, and how numbers are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::size_t bytes_of(PlyType type) {
  constexpr std::size_t bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<std::size_t>(type)];
}
constexpr bool is_whole(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  // of a number, or of each number of a list
  bool is_list = false;
  PlyType count = PlyType::uint8;  // of the length of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  std::size_t find(std::string_view property) const;  // number of the property, or of all if there is none
};

enum class PlyCoding { text, little_endian, big_endian };

struct PlyHeader {
  PlyCoding coding = PlyCoding::text;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;   // the numbers come behind them
  std::int64_t lines = 0;  // of these bytes
};

// Reads it. It throws InputError with `place`, the file and the line.
PlyHeader read_ply_header(std::string_view bytes, const std::string& file, const Place& place);

}  // namespace voxmelt::scene
