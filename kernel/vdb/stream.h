// We speak with the program voxmelt-vdb, which alone knows OpenVDB. It is on the same machine, so numbers
// are as they are in memory.
//
//   voxmelt-vdb write FILE STEP GRIDS   takes records of so many grids from its standard input
//   voxmelt-vdb read FILE GRID LOW HIGH gives a byte for each voxel, x fastest, then y: 1 if it is filled.
//                                       GRID may be empty. LOW and HIGH are numbers, or both empty.
//
// Its first line of output is "error TEXT", "full TEXT" where the disk is full, or for `write` "ok". For
// `read` it is "ok X Y Z SX SY SZ", the numbers of voxels along each axis and their sides; then a line with
// the name of the grid, and one that lists the names of all if no grid was asked for and there are several.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace voxmelt::vdb {

inline constexpr int kSide = 8;  // cells along the side of a brick: a leaf of OpenVDB
inline constexpr std::size_t kCells = std::size_t{kSide} * kSide * kSide;

// The place of a cell in its brick is that of OpenVDB: z is fastest, then y.
constexpr std::size_t place_in_brick(int x, int y, int z) {
  return (static_cast<std::size_t>(x) * kSide + static_cast<std::size_t>(y)) * kSide +
         static_cast<std::size_t>(z);
}

// A record of that kind follows the byte. A grid has all its bricks and tiles first, and then the numbers of
// the bricks, in the order of tree_order(). So the program needs memory for what is active, and for the
// numbers of one brick.
enum class Record : std::uint8_t { grid = 'g', brick = 'b', tile = 't', numbers = 'n', end = 'e' };

// Begins a grid of floats. Cells that no record names are not active, and 0.
struct GridRecord {
  std::array<char, 24> name{};  // ends with NUL
  double unit = 1;              // a value is number / unit
  std::uint32_t is_fog = 0;     // 1: the class of the grid is that of a fog volume
  std::uint32_t reserved = 0;
};

// Some cells of a brick are active.
struct BrickRecord {
  std::array<std::int32_t, 3> at{};  // its lowest cell
  std::uint32_t reserved = 0;
  std::array<std::uint64_t, kCells / 64> active{};
};

// Holds the numbers of a brick. Those of cells that are not active are 0.
struct NumbersRecord {
  std::array<std::int32_t, 3> at{};
  std::uint32_t reserved = 0;
  std::array<std::uint16_t, kCells> numbers{};
};

// All cells of a brick are active, and have this number.
struct TileRecord {
  std::array<std::int32_t, 3> at{};
  std::uint32_t number = 0;
};

// Calls visit(at) with the lowest cell of each brick, in the order of OpenVDB's leaves: by blocks of 16
// bricks along each axis, z fastest.
template <class Visit>
void tree_order(const std::array<int, 3>& size, const Visit& visit) {
  constexpr int kBlock = 16 * kSide;
  const auto in_box = [](const std::array<int, 3>& low, const std::array<int, 3>& high, int step,
                         const auto& each) {
    for (int x = low[0]; x < high[0]; x += step)
      for (int y = low[1]; y < high[1]; y += step)
        for (int z = low[2]; z < high[2]; z += step) each(std::array{x, y, z});
  };
  in_box({0, 0, 0}, size, kBlock, [&](const std::array<int, 3>& block) {
    std::array<int, 3> end{};
    for (std::size_t axis = 0; axis < 3; ++axis) end[axis] = std::min(size[axis], block[axis] + kBlock);
    in_box(block, end, kSide, visit);
  });
}

}  // namespace voxmelt::vdb
