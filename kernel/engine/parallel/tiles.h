// A set of tiles has one bit per mask word of x, [slice][tile row], with an empty slice and row at every
// side. Such sets tell which tiles sleep. A slice in which nothing is awake costs one test.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/engine/simd/kernels.h"

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
  Tiles(int slices, int rows)
      : slices_(slices), rows_(rows), bits_(index(slices + 1)), touched_(count(slices)) {}

  int slices() const { return slices_; }
  int rows() const { return rows_; }
  std::ptrdiff_t stride() const { return rows_ + 2; }  // rows from a slice to the next
  const TileRow* slice(int z) const { return bits_.data() + index(z); }
  // Gives a slice for writing. A slice that stays empty should be tidied.
  TileRow* edit(int z) {
    touched_[count(z)] = 1;
    return bits_.data() + index(z);
  }
  void tidy(int z) { touched_[count(z)] = any(z); }

  bool any(int z) const {
    return z >= 0 && z < slices_ && touched_[count(z)] != 0 &&
           std::any_of(slice(z), slice(z) + rows_, [](TileRow row) { return row != 0; });
  }
  bool any_near(int z) const { return any(z - 1) || any(z) || any(z + 1); }

  void fill(TileRow value) {
    for (int z = 0; z < slices_; ++z) std::fill_n(edit(z), rows_, value);
  }
  void clear(int z) {
    if (touched_[count(z)] == 0) return;
    std::fill_n(edit(z), rows_, TileRow{0});
    touched_[count(z)] = 0;
  }
  void clear() {
    for (int z = 0; z < slices_; ++z) clear(z);
  }
  void add(int z, const TileRow* rows) {
    if (std::all_of(rows, rows + rows_, [](TileRow row) { return row == 0; })) return;
    TileRow* own = edit(z);
    for (int r = 0; r < rows_; ++r) own[r] |= rows[r];
  }
  void add(const Tiles& other) {
    for (int z = 0; z < slices_; ++z)
      if (other.touched_[count(z)] != 0) add(z, other.slice(z));
  }

  // Returns the tiles of row r of slice z that are, or are beside, one of this set.
  TileRow near(int z, int r, TileRow words) const {
    const TileRow *own = slice(z) + r, *front = slice(z + 1) + r, *back = slice(z - 1) + r;
    const TileRow near =
        own[-1] | own[0] | own[1] | front[-1] | front[0] | front[1] | back[-1] | back[0] | back[1];
    return (near | near << 1 | near >> 1) & words;
  }

 private:
  static std::size_t count(int z) { return z; }
  std::size_t index(int z) const { return count(z + 1) * count(rows_ + 2) + 1; }

  int slices_ = 0, rows_ = 0;
  std::vector<TileRow> bits_;
  std::vector<std::uint8_t> touched_;  // slices that may hold something
};

}  // namespace voxmelt::parallel
