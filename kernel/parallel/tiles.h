// Sets of tiles: one bit per mask word of x, [slice][tile row]. What sleeps is told by sets; a step touches
// only the slices in which something is awake.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/simd/kernels.h"

namespace voxmelt::parallel {

using simd::TileRow;

inline TileRow all_words(const simd::View& view) {
  return view.words == 64 ? ~TileRow{0} : (TileRow{1} << view.words) - 1;
}
inline bool any(const std::vector<TileRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](TileRow row) { return row != 0; });
}

class Tiles {
 public:
  Tiles() = default;
  Tiles(int slices, int rows) : slices_(slices), rows_(rows), bits_(index(slices)) {}

  int rows() const { return rows_; }
  TileRow* slice(int z) { return bits_.data() + index(z); }
  const TileRow* slice(int z) const { return bits_.data() + index(z); }

  void fill(TileRow value) { std::fill(bits_.begin(), bits_.end(), value); }
  void clear(int z) { std::fill_n(slice(z), rows_, TileRow{0}); }
  bool any(int z) const {
    return z >= 0 && z < slices_ &&
           std::any_of(slice(z), slice(z) + rows_, [](TileRow row) { return row != 0; });
  }

  void add(int z, const TileRow* rows) {
    for (int r = 0; r < rows_; ++r) slice(z)[r] |= rows[r];
  }
  void add(const Tiles& other) {
    for (std::size_t i = 0; i < bits_.size(); ++i) bits_[i] |= other.bits_[i];
  }

  // Tiles of row r of slice z that are, or are beside, one of this set.
  TileRow near(int z, int r, TileRow words) const {
    TileRow near = 0;
    for (int nz = std::max(0, z - 1); nz <= std::min(slices_ - 1, z + 1); ++nz) {
      const TileRow* rows = slice(nz);
      near |= rows[r];
      if (r > 0) near |= rows[r - 1];
      if (r + 1 < rows_) near |= rows[r + 1];
    }
    return (near | near << 1 | near >> 1) & words;
  }

 private:
  std::size_t index(int z) const { return static_cast<std::size_t>(z) * static_cast<std::size_t>(rows_); }

  int slices_ = 0, rows_ = 0;
  std::vector<TileRow> bits_;
};

}  // namespace voxmelt::parallel
