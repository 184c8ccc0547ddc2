#include "render/density/low_pass.h"

#include <algorithm>
#include <cstddef>

namespace voxmelt::render {

namespace {

constexpr std::size_t kMostSide = kBrickSide + 2 * kMaxPasses;
constexpr std::size_t kMostRow = (kMostBricks * kBrickSide + 2 * kMaxPasses + kLanes - 1) / kLanes * kLanes;

std::size_t whole_groups(int cells) {
  return static_cast<std::size_t>((cells + kLanes - 1) / kLanes) * kLanes;
}

}  // namespace

LowPass::LowPass(const state::Grid& grid)
    : grid_(grid),
      block_(std::make_unique_for_overwrite<std::uint16_t[]>(kMostRow * kMostSide * kMostSide + 4 * kLanes)),
      room_(std::make_unique_for_overwrite<std::uint16_t[]>(2 * (kMostRow + 3 * kLanes) * kMostSide)) {}

void LowPass::load(const Values<std::uint16_t>& from, const CellBox& box, int passes) {
  origin_ = {box.low.x - passes, box.low.y - passes, box.low.z - passes};
  x_ = box.high.x - box.low.x + 2 * passes;
  y_ = box.high.y - box.low.y + 2 * passes;
  z_ = box.high.z - box.low.z + 2 * passes;
  done_ = 0;
  if (grid_.contains(origin_.x, origin_.y, origin_.z) &&
      grid_.contains(origin_.x + x_ - 1, origin_.y + y_ - 1, origin_.z + z_ - 1)) {
    here_ = {from.data() + grid_.index(origin_.x, origin_.y, origin_.z), grid_.index(0, 1, 0),
             grid_.index(0, 0, 1)};
  } else {
    here_ = {block_.get(), whole_groups(x_), whole_groups(x_) * y_};
    copy(from);
  }
}

// Copies the cells of the box, and fills in those outside the grid.
void LowPass::copy(const Values<std::uint16_t>& from) {
  const int inside = std::clamp(origin_.x, 0, grid_.x - 1), end = std::min(origin_.x + x_, grid_.x);
  const int before = inside - origin_.x, after = origin_.x + x_ - end;
  for (int z = 0; z < z_; ++z)
    for (int y = 0; y < y_; ++y) {
      const std::uint16_t* row = from.data() + grid_.index(0, std::clamp(origin_.y + y, 0, grid_.y - 1),
                                                           std::clamp(origin_.z + z, 0, grid_.z - 1));
      std::uint16_t* to = block_.get() + z * here_.slice + y * here_.row;
      std::fill_n(to, before, row[inside]);
      std::copy(row + inside, row + end, to + before);
      std::fill_n(to + (x_ - after), after, row[end - 1]);
    }
}

// Passes after the first work in place, because reading runs ahead of writing. Cell i of a result is centred
// on cell i + 1 of its source.
void LowPass::advance(int passes, const Loops& with) {
  for (; done_ < passes; ++done_) {
    x_ -= 2;
    y_ -= 2;
    z_ -= 2;
    origin_ = {origin_.x + 1, origin_.y + 1, origin_.z + 1};
    const bool copied = here_.cells == block_.get();
    const std::size_t row = whole_groups(x_);
    const Block<std::uint16_t> to{block_.get(), copied ? here_.row : row, copied ? here_.slice : row * y_};
    with.low_pass(here_, to, x_, y_, z_, room_.get());
    here_ = {to.cells, to.row, to.slice};
  }
}

const std::uint16_t* LowPass::at(int x, int y, int z) const {
  return here_.cells + (z - origin_.z) * here_.slice + (y - origin_.y) * here_.row +
         static_cast<std::size_t>(x - origin_.x);
}

Values<std::uint16_t> low_pass(const state::Grid& grid, int passes, const Values<std::uint16_t>& from) {
  Values<std::uint16_t> to(from.size());
  LowPass filter(grid);
  const state::Grid bricks = brick_grid(grid);
  for (int z = 0; z < bricks.z; ++z)
    for (int y = 0; y < bricks.y; ++y)
      for (int x = 0; x < bricks.x; x += kMostBricks) {
        const int count = std::min(kMostBricks, bricks.x - x);
        filter.load(from, cells_of(grid, {x, y, z}, count), passes);
        filter.advance(passes);
        for_rows(grid, cells_of(grid, {x, y, z}, count),
                 [&](std::size_t i, const state::Grid& cell, int cells) {
                   std::copy_n(filter.at(cell.x, cell.y, cell.z), cells, to.data() + i);
                 });
      }
  return to;
}

}  // namespace voxmelt::render
