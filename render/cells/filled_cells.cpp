#include "render/cells/filled_cells.h"

#include <algorithm>

namespace voxmelt::render {
namespace {

std::size_t bricks_along(int cells) {
  return static_cast<std::size_t>(cells + FilledCells::kBrick - 1) / FilledCells::kBrick;
}

}  // namespace

FilledCells::FilledCells(const state::Volume& volume, cpu::Workers& workers)
    : grid_(volume.grid),
      row_words_(state::words_for(static_cast<std::size_t>(grid_.x))),
      bricks_x_(bricks_along(grid_.x)),
      bricks_y_(bricks_along(grid_.y)),
      words_(row(0, static_cast<std::size_t>(grid_.z))),
      bricks_(brick(0, 0, bricks_along(grid_.z))) {
  workers.run(static_cast<int>(bricks_along(grid_.z)), [&](int layer) { fill_layer(volume, layer); });
}

void FilledCells::fill_layer(const state::Volume& volume, int layer) {
  for (int z = layer * kBrick; z < std::min((layer + 1) * kBrick, grid_.z); ++z)
    for (int y = 0; y < grid_.y; ++y) {
      const auto solid = volume.solid.row(y, z), liquid = volume.liquid.row(y, z),
                 inert = volume.inert.row(y, z);
      const std::size_t first = row(static_cast<std::size_t>(y), static_cast<std::size_t>(z));
      for (std::size_t w = 0; w < row_words_; ++w) {
        const std::uint64_t filled = solid[w] | liquid[w] | inert[w];
        words_[first + w] = filled;
        for (std::size_t b = 0; b < kBrick && filled != 0; ++b)
          if ((filled >> (kBrick * b) & 0xFF) != 0)
            bricks_[brick(kBrick * w + b, static_cast<std::size_t>(y / kBrick),
                          static_cast<std::size_t>(layer))] = 1;
      }
    }
}

}  // namespace voxmelt::render
