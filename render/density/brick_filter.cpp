#include "render/density/brick_filter.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace voxmelt::render {
namespace {

constexpr std::uint16_t kWhole = 256;  // full weight

// Tells whether a brick and all of its neighbours have the same value everywhere. Then filtering does not
// change it.
bool has_one_value(const CellFields& cells, int channel, const state::Grid& brick) {
  const state::Grid& bricks = cells.bricks;
  const std::int32_t value = cells.uniform(channel, bricks.index(brick.x, brick.y, brick.z));
  if (value == CellFields::kMixed) return false;
  for (int z = std::max(brick.z - 1, 0); z <= std::min(brick.z + 1, bricks.z - 1); ++z)
    for (int y = std::max(brick.y - 1, 0); y <= std::min(brick.y + 1, bricks.y - 1); ++y)
      for (int x = std::max(brick.x - 1, 0); x <= std::min(brick.x + 1, bricks.x - 1); ++x)
        if (cells.uniform(channel, bricks.index(x, y, z)) != value) return false;
  return true;
}

// Returns the part of a box of bricks in a row that holds something dirty, by planes across y and z.
CellBox trimmed(const CellBox& box, const BrickPart& part) {
  CellBox to = box;
  to.low.y += std::countr_zero(part.y);
  to.low.z += std::countr_zero(part.z);
  to.high.y = std::min(box.high.y, box.low.y + std::bit_width(part.y));
  to.high.z = std::min(box.high.z, box.low.z + std::bit_width(part.z));
  return to;
}

void fill(const BrickFilter::Task& task, int channel, const state::Grid& brick) {
  const CellFields& cells = task.cells;
  const auto value =
      static_cast<std::uint16_t>(cells.uniform(channel, cells.bricks.index(brick.x, brick.y, brick.z)));
  Values<std::uint16_t>& to = *task.to.all()[channel];
  for_rows(cells.grid, cells_of(cells.grid, brick), [&](std::size_t i, const state::Grid&, int count) {
    std::uint16_t* row = to.data() + i;
    for (int x = 0; x < count; ++x)
      if (row[x] != value) row[x] = value;  // memory that was never written takes no pages
  });
}

}  // namespace

void BrickFilter::filter_row(const Task& task, int by, int bz) {
  const CellFields& cells = task.cells;
  for (const int channel : {kSolid, kLiquid, kHeat, kObstacle, kIntensity}) {  // the shares first
    if (cells.all()[channel]->empty()) continue;
    const auto asked = [&](int bx) {
      return (task.flags[cells.bricks.index(bx, by, bz)] & flag_of(channel)) != 0;
    };
    int run = 0;  // bricks to the left of bx that must be filtered
    BrickPart part;
    for (int bx = 0; bx <= cells.bricks.x; ++bx) {
      const state::Grid brick{bx, by, bz};
      const bool more = bx < cells.bricks.x && asked(bx);
      const bool same = more && has_one_value(cells, channel, brick);
      if (run == kMostBricks || (run > 0 && (!more || same))) {
        const CellBox box = trimmed(cells_of(cells.grid, {bx - run, by, bz}, run), part);
        channel == kIntensity ? mix_intensity(task, box) : filter(task, channel, box);
        run = 0;
        part = {};
      }
      if (more && !same) {
        ++run;
        const DirtyPart& dirty = task.parts[cells.bricks.index(bx, by, bz)];
        part.add(channel == kHeat ? dirty.heat : dirty.matter);
      }
      if (same) fill(task, channel, brick);
    }
  }
}

void BrickFilter::filter(const Task& task, int channel, const CellBox& box) {
  const std::size_t c = channel;
  const int wide = channel_passes(task.liquid_passes, task.solid_passes);
  low_pass_.load(*task.cells.all()[c], box, wide);
  low_pass_.advance(wide, task.with);
  std::uint16_t* const to = task.to.all()[c]->data();
  for_rows(task.cells.grid, box, [&](std::size_t i, const state::Grid& cell, int cells) {
    std::copy_n(low_pass_.at(cell.x, cell.y, cell.z), cells, to + i);
  });
}

void BrickFilter::mix_intensity(const Task& task, const CellBox& box) {
  const auto place = [&](const state::Grid& cell) {  // index in weights_ and other_
    return static_cast<std::size_t>((cell.z - box.low.z) * kBrickSide + (cell.y - box.low.y)) * kMostBricks *
           kBrickSide;
  };
  std::uint16_t least = kWhole, most = 0;
  for_rows(task.cells.grid, box, [&](std::size_t i, const state::Grid& cell, int cells) {
    std::uint16_t* weights = weights_.get() + place(cell);
    task.with.weights(task.to.liquid.data() + i, task.to.solid.data() + i,
                      task.to.obstacle.empty() ? nullptr : task.to.obstacle.data() + i, cells, weights);
    for (int x = 0; x < cells; ++x) {
      least = std::min(least, weights[x]);
      most = std::max(most, weights[x]);
    }
  });

  // Many bricks need only one of the two filters. If both are needed, the weaker one is an intermediate
  // result of the stronger.
  const bool both = least < kWhole && most > 0 && task.liquid_passes != task.solid_passes;
  const int alone = most > 0 ? task.liquid_passes : task.solid_passes;
  const int passes = both ? std::max(task.liquid_passes, task.solid_passes) : alone;
  low_pass_.load(task.cells.intensity, box, passes);
  if (both) {
    low_pass_.advance(std::min(task.liquid_passes, task.solid_passes), task.with);
    for_rows(task.cells.grid, box, [&](std::size_t, const state::Grid& cell, int cells) {
      std::copy_n(low_pass_.at(cell.x, cell.y, cell.z), cells, other_.get() + place(cell));
    });
  }
  low_pass_.advance(passes, task.with);
  std::uint16_t* const to = task.to.intensity.data();
  for_rows(task.cells.grid, box, [&](std::size_t i, const state::Grid& cell, int cells) {
    const std::uint16_t *last = low_pass_.at(cell.x, cell.y, cell.z), *other = other_.get() + place(cell);
    if (!both)
      std::copy_n(last, cells, to + i);
    else if (task.liquid_passes > task.solid_passes)
      task.with.mix(other, last, weights_.get() + place(cell), cells, to + i);
    else
      task.with.mix(last, other, weights_.get() + place(cell), cells, to + i);
  });
}

}  // namespace voxmelt::render
