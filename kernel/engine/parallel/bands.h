// A band is a group of tile rows that the kernels get as one. If most tiles are awake, a taller row of work
// costs less: fewer calls, and fewer batches that are not full.
#pragma once

#include <algorithm>
#include <cstddef>

#include "kernel/engine/parallel/tiles.h"

namespace voxmelt::parallel {

struct Band {
  const simd::View& view;  // the band is one tile row of this view
  int row;                 // number of that tile row
  int begin, end;          // range of tile rows of the sets
  // Gives all of these rows the same tiles. The loop is never empty, and most often has one round.
  void set(TileRow* rows, TileRow tiles) const {
    int r = begin;
    do rows[r] = tiles;
    while (++r < end);
  }
};

class Bands {
 public:
  // A tall band of a slice has 32 rows or more, up to this many cells. Three slices of it and their gifts
  // then fit into the second cache level.
  static constexpr std::size_t kCells = 16384;

  explicit Bands(const simd::View& view) : shift_(view.tile_shift), rows_(view.tile_rows()) {
    while (shift_ < 5 || (shift_ < 12 && view.row << (shift_ + 1) <= kCells)) ++shift_;
    more_ = shift_ - view.tile_shift;
  }

  int shift() const { return shift_; }  // log2 of the rows of a tall band
  int end(int first) const { return std::min(first + (1 << more_), rows_); }  // end of the band at `first`
  Band tall(const simd::View& view, int first) const { return {view, first >> more_, first, end(first)}; }
  static Band single(const simd::View& view, int row) { return {view, row, row, row + 1}; }

 private:
  int shift_, more_ = 0, rows_;
};

// Tells if three quarters of these tile rows are complete. In a thin scene a quarter is soon found to be
// missing.
inline bool mostly(const Tiles& tiles, int z_begin, int z_end, int begin, int end, TileRow all) {
  int may_lack = (z_end - z_begin) * (end - begin) / 4;
  for (int z = z_begin; z < z_end; ++z)
    for (int r = begin; r < end; ++r)
      if (tiles.slice(z)[r] != all && --may_lack < 0) return false;
  return true;
}

}  // namespace voxmelt::parallel
