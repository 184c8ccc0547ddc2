// The work of `pattern` on a tile row is cut into items of two vectors each. Only items with a cell that may
// give are kept.
#pragma once

#include <cstdint>

#include "kernel/engine/simd/openness.h"

namespace voxmelt::simd {

template <class Arch, int kDirections, bool kSupport>
class GiverItems {
  using L = cpu::Lanes<Arch>;
  using Twin = typename L::Twin;

 public:
  static constexpr int kCells = 2 * L::kCount;  // in an item
  static constexpr int kMost = 64;              // items of a batch

  struct Item {
    std::uint32_t at;         // its first cell, counted from the first of the gifts
    std::uint32_t row, lane;  // its first cell: row in the gifts, x
    bool walls;               // walls beside some of its cells, not counting the border in x
    Twin givers;              // cells that may give
  };

  // Takes `below` as in Kernels::pattern.
  [[gnu::always_inline]] GiverItems(int z, const std::uint64_t* below, const Gifts& gifts)
      : z_(z), first_below_(below), gifts_(gifts) {}

  [[gnu::always_inline]] void begin(const View& view, int r, TileRow tiles) {
    tiles_ = work_ = tiles;
    y_ = view.tile_begin(r);
    end_ = view.tile_end(r);
    row_ = static_cast<std::uint32_t>(gifts_.row(y_));
    at_ = row_ * static_cast<std::uint32_t>(view.row);
    liquid_ = view.liquid + view.word(0, y_, z_);
    below_ = first_below_ != nullptr ? first_below_ : liquid_ - (y_ > 0 ? view.words : 0);
    walls_ = view.walls_at(y_, z_);
  }
  [[gnu::always_inline]] bool more() const { return y_ < end_; }

  // Fills the next batch, from row to row. It returns how many items the batch has.
  [[gnu::always_inline]] int collect(const View& view, const Openness<Arch, kDirections>& openness) {
    int count = 0;
    while (count + L::kTwins <= kMost) {
      if (work_ == 0) {
        climb(view);
        if (y_ == end_) break;
        work_ = tiles_;
        continue;
      }
      count = collect(view, openness, __builtin_ctzll(work_), count);
      work_ &= work_ - 1;
    }
    return count;
  }
  [[gnu::always_inline]] const Item& operator[](int i) const { return items_[i]; }

 private:
  [[gnu::always_inline]] void climb(const View& view) {
    ++y_;
    ++row_;
    at_ += static_cast<std::uint32_t>(view.row);
    below_ = liquid_;
    liquid_ += view.words;
    walls_ += view.words + 2;
  }

  // Appends the items of a word. It returns how many there are then.
  [[gnu::always_inline]] int collect(const View& view, const Openness<Arch, kDirections>& openness, int w,
                                     int count) {
    std::uint64_t givers = liquid_[w];
    if (view.set != nullptr) givers &= ~view.set[&liquid_[w] - view.liquid];
    if (givers == 0) return count;
    // With `support`, only cells that stand on something give. Below the grid all is wall.
    if (kSupport) givers &= walls_[w - (view.words + 2)] | below_[w];
    const std::uint64_t walls = openness.beside_walls(w, walls_);
    for (int twin = 0; twin < L::kTwins; ++twin) {
      const std::uint32_t lane = 64 * w + twin * kCells;
      items_[count] = {at_ + lane, row_, lane, static_cast<Twin>(walls >> (twin * kCells)) != 0,
                       static_cast<Twin>(givers >> (twin * kCells))};
      count += items_[count].givers != 0;
    }
    return count;
  }

  const int z_;
  const std::uint64_t* const first_below_;
  const Gifts& gifts_;
  TileRow tiles_ = 0, work_ = 0;  // tiles of a row: asked for, left
  int y_ = 0, end_ = 0;
  std::uint32_t row_ = 0, at_ = 0;  // row and first cell in the gifts
  const std::uint64_t *liquid_ = nullptr, *below_ = nullptr, *walls_ = nullptr;  // masks of the row
  Item items_[kMost];
};

}  // namespace voxmelt::simd
