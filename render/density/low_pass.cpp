#include "render/density/low_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "render/density/brick.h"

namespace voxmelt::render {
namespace {

constexpr int kMaxSide = kBrickSide + 2 * kMaxPasses;
using Block = std::array<std::uint32_t, static_cast<std::size_t>(kMaxSide) * kMaxSide * kMaxSide>;

std::size_t at(int x, int y, int z) {
  return (static_cast<std::size_t>(z) * kMaxSide + static_cast<std::size_t>(y)) * kMaxSide +
         static_cast<std::size_t>(x);
}

// One 1-2-1 sweep along the axis whose cells are `stride` apart, in place: reading runs ahead of writing.
// Cell i of the result is centred on cell i + 1 of the input along this axis.
void sweep(Block& block, std::size_t stride, int nx, int ny, int nz) {
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y) {
      std::uint32_t* row = block.data() + at(0, y, z);
      for (int x = 0; x < nx; ++x) row[x] = row[x] + 2 * row[x + stride] + row[x + 2 * stride];
    }
}

// Loads the brick and a halo of `passes` cells; tells whether all of it has one value.
bool load(Block& block, const state::Grid& grid, int x0, int y0, int z0, int side,
          const std::vector<std::uint16_t>& from) {
  const std::uint32_t first = from[grid.index(std::clamp(x0, 0, grid.x - 1), std::clamp(y0, 0, grid.y - 1),
                                              std::clamp(z0, 0, grid.z - 1))];
  std::uint32_t differences = 0;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y) {
      const std::size_t row =
          grid.index(0, std::clamp(y0 + y, 0, grid.y - 1), std::clamp(z0 + z, 0, grid.z - 1));
      std::uint32_t* target = block.data() + at(0, y, z);
      for (int x = 0; x < side; ++x) {
        target[x] = from[row + static_cast<std::size_t>(std::clamp(x0 + x, 0, grid.x - 1))];
        differences |= target[x] ^ first;
      }
    }
  return differences == 0;
}

}  // namespace

void low_pass_brick(const state::Grid& grid, int bx, int by, int bz, int passes,
                    const std::vector<std::uint16_t>& from, std::vector<std::uint16_t>& to) {
  Block block;
  const int x0 = bx * kBrickSide, y0 = by * kBrickSide, z0 = bz * kBrickSide;
  int side = kBrickSide + 2 * passes;

  // A constant block stays as it is; it is stored at the place where the passes would leave it.
  const bool constant = load(block, grid, x0 - passes, y0 - passes, z0 - passes, side, from);
  for (int pass = 0; pass < passes && !constant; ++pass) {
    sweep(block, 1, side - 2, side, side);
    sweep(block, kMaxSide, side - 2, side - 2, side);
    sweep(block, static_cast<std::size_t>(kMaxSide) * kMaxSide, side - 2, side - 2, side - 2);
    side -= 2;
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y) {
        std::uint32_t* row = block.data() + at(0, y, z);
        for (int x = 0; x < side; ++x) row[x] = (row[x] + 32) >> 6;
      }
  }

  const int x_count = std::min(kBrickSide, grid.x - x0);
  for (int z = 0; z < std::min(kBrickSide, grid.z - z0); ++z)
    for (int y = 0; y < std::min(kBrickSide, grid.y - y0); ++y) {
      const std::uint32_t* row = block.data() + at(0, y, z);
      std::uint16_t* target = to.data() + grid.index(x0, y0 + y, z0 + z);
      for (int x = 0; x < x_count; ++x) target[x] = static_cast<std::uint16_t>(row[x]);
    }
}

std::vector<std::uint16_t> low_pass(const state::Grid& grid, int passes,
                                    const std::vector<std::uint16_t>& from) {
  std::vector<std::uint16_t> to(from.size());
  const state::Grid bricks = brick_grid(grid);
  for (int z = 0; z < bricks.z; ++z)
    for (int y = 0; y < bricks.y; ++y)
      for (int x = 0; x < bricks.x; ++x) low_pass_brick(grid, x, y, z, passes, from, to);
  return to;
}

}  // namespace voxmelt::render
