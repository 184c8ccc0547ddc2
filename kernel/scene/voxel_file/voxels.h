// Volumes of numbers come from files of several formats. The ending of a file's name says which it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Says which voxels of a volume are filled.
struct Voxels {
  std::array<int, 3> size{};               // along x, y and z
  std::array<double, 3> spacing{1, 1, 1};  // sides of a voxel, in the unit of the file
  std::vector<std::uint8_t> filled;        // 0 or 1; x runs fastest, then y
  std::string note;                        // what is odd but usable; mostly empty
};

// Says of what number a voxel is filled: from the first one to the second.
struct Filled {
  double low = 0.5, high = 1e15;
  bool is_default = true;  // nobody has asked for these; a level set is filled where it is negative then
  bool operator()(double value) const { return low <= value && value <= high; }
};

// Names the types of numbers, in the order of NumberBlock::Type.
inline constexpr std::array kNumberTypes{"int8",  "uint8",  "int16",   "uint16",  "int32",  "uint32",
                                         "int64", "uint64", "float16", "float32", "float64"};

// Describes numbers that a file holds without a header.
struct RawNumbers {
  std::array<std::uint64_t, 3> size{};
  std::size_t type = 0;  // place in kNumberTypes
  bool is_big_endian = false;
  std::uint64_t skip = 0;  // bytes before the numbers
  std::array<double, 3> spacing{1, 1, 1};
};

// Says what is read, and of what number a voxel is filled.
struct VoxelSource {
  std::filesystem::path file;
  Place place;        // for messages
  std::string array;  // or grid, of a file of several; empty if none is named
  Filled is_filled{};
  std::optional<RawNumbers> raw{};  // the file is these, whatever its name

  [[noreturn]] void fail(const std::string& message) const;
};

// Tells if a file's name ends as those of volumes do.
bool is_voxel_file(const std::filesystem::path& file);

// Reads a volume. It throws InputError with the place, the file, and what is wrong with it.
Voxels read_voxels(const VoxelSource& source);

}  // namespace voxmelt::scene
