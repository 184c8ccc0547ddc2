#include "kernel/engine/scalar/cells.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <iterator>

namespace voxmelt::scalar {

ActiveRows::ActiveRows(const state::Volume& volume) : rows_(volume.grid.y), slices_(volume.grid.z) {
  const state::Grid g = volume.grid;
  const auto index = [&](int y, int z) { return static_cast<std::size_t>(z) * rows_ + y; };

  // Finds where each row itself holds matter.
  std::vector<Interval> own(index(0, slices_), Interval{g.x, 0});
  for (int z = 0; z < slices_; ++z)
    for (int y = 0; y < rows_; ++y) {
      const auto solid = volume.solid.row(y, z), liquid = volume.liquid.row(y, z);
      Interval& interval = own[index(y, z)];
      for (int w = 0; w < std::ssize(solid); ++w) {
        const std::uint64_t word = solid[w] | liquid[w];
        if (word == 0) continue;
        const int base = 64 * w;
        interval.begin = std::min(interval.begin, base + std::countr_zero(word));
        interval.end = base + 64 - std::countl_zero(word);
      }
    }

  // Widens the intervals by one cell in x, y and z.
  intervals_.assign(own.size(), Interval{g.x, 0});
  for (int z = 0; z < slices_; ++z)
    for (int y = 0; y < rows_; ++y) {
      Interval& wide = intervals_[index(y, z)];
      for (int nz = std::max(0, z - 1); nz <= std::min(slices_ - 1, z + 1); ++nz)
        for (int ny = std::max(0, y - 1); ny <= std::min(rows_ - 1, y + 1); ++ny) {
          const Interval near = own[index(ny, nz)];
          if (near.begin >= near.end) continue;
          wide.begin = std::min(wide.begin, std::max(0, near.begin - 1));
          wide.end = std::max(wide.end, std::min(g.x, near.end + 1));
        }
    }
}

ActiveRows ActiveRows::columns(const state::Volume& volume) {
  ActiveRows rows(volume);
  for (auto slice = rows.intervals_.begin(); slice != rows.intervals_.end(); slice += rows.rows_) {
    Interval all{volume.grid.x, 0};
    for (auto row = slice; row != slice + rows.rows_; ++row) {
      all.begin = std::min(all.begin, row->begin);
      all.end = std::max(all.end, row->end);
    }
    std::fill(slice, slice + rows.rows_, all);
  }
  return rows;
}

void settle_masks(const ActiveRows& rows, state::Volume& volume) {
  rows.for_each([&](int x, int y, int z) {
    if (volume.solid.test(x, y, z) || volume.inert.test(x, y, z)) return;
    const state::Slot i = volume.at(x, y, z);
    const bool wet = volume.amount[i] > 0;
    volume.liquid.set(x, y, z, wet);
    if (!wet) volume.energy[i] = volume.heat[i] = 0;
  });
}

}  // namespace voxmelt::scalar
