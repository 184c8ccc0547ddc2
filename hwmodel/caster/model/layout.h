// Words lie in memory (docs/hardware/pipeline.md) in lines, which the memory gives as a whole. A line has the
// words in a box of places. Sparse volumes consist of bricks of 8 x 8 x 8 places, and only some bricks are
// stored.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace voxmelt::hwmodel::raycast {

inline constexpr int kBrickBits = 3;
inline constexpr int kApronSide = 11;  // places of a brick that holds its apron
inline constexpr std::int64_t kNoLine = -1;
inline constexpr int kBurst = 64;  // bytes

struct Layout {
  std::int64_t base = 0;  // address of line 0
  int word_bytes = 0, line_bytes = 0;
  std::array<int, 3> bits{};   // log2 of the places of a line along x, y, z
  std::array<int, 3> count{};  // lines along each axis; bricks of a sparse volume
  bool sparse = false, apron = false;
  std::vector<std::int32_t> slots;  // number of each stored brick of a sparse volume; 0 if none

  std::int64_t brick_at(int bx, int by, int bz) const {
    if (bx < 0 || by < 0 || bz < 0 || bx >= count[0] || by >= count[1] || bz >= count[2]) return 0;
    return slots[(bz * count[1] + by) * count[0] + bx];
  }
  // Returns a line by its coordinates, which are places >> bits.
  std::int64_t line_at(int lx, int ly, int lz) const {
    if (!sparse) return (std::int64_t{lz} * count[1] + ly) * count[0] + lx;
    const int more = kBrickBits - bits[0];  // lines along a side of a brick
    const std::int64_t slot = brick_at(lx >> more, ly >> more, lz >> more);
    if (slot == 0) return kNoLine;
    const int mask = (1 << more) - 1;
    return (slot << (3 * more)) | (((lz & mask) << (2 * more)) | ((ly & mask) << more) | (lx & mask));
  }
  std::int64_t address(std::int64_t line) const { return base + line * line_bytes; }
  int offset(int x, int y, int z) const {
    const int ix = x & ((1 << bits[0]) - 1), iy = y & ((1 << bits[1]) - 1), iz = z & ((1 << bits[2]) - 1);
    return ((((iz << bits[1]) | iy) << bits[0]) | ix) * word_bytes;
  }
  // Returns the offset of a place in brick (bx, by, bz), which holds its apron: its places begin at -1.
  int apron_offset(int x, int y, int z, int bx, int by, int bz) const {
    return (((z - 8 * bz + 1) * kApronSide + (y - 8 * by + 1)) * kApronSide + (x - 8 * bx + 1)) * word_bytes;
  }
};

// Holds what the host has written to memory, and where it lies.
struct Memory {
  std::vector<std::uint8_t> bytes;
  Layout levels, matter;   // by lattice place
  Layout light;            // by cell of light; 16 bytes: lamp, six of openness, nothing, six of glow
  Layout heights;          // by column: drawn and bare height, 32 bits each
  Layout texels;           // docs/picture/ground.md, section 7
  std::int64_t frame = 0;  // the picture, tile by tile, 3 bytes a pixel
};

}  // namespace voxmelt::hwmodel::raycast
