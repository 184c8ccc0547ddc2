// The first half of phase `spread` of the paper's law (Eqs. 7-10) chooses the directions that each cell gives
// to, and its gifts.
//
// The work of a tile row is cut into items of two vectors each (a pattern is a byte, and so are dice). A
// batch of items goes through three stages. The first finds items with a liquid cell, the second those with a
// direction that may receive. The third throws dice for two at a time. So no stage waits for another's
// result, and no branch depends on it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/gift_writer.h"
#include "kernel/engine/simd/giver_items.h"
#include "kernel/engine/simd/openness.h"
#include "kernel/engine/simd/receivers.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class Pattern {
  using L = cpu::Lanes<Arch>;
  using Bytes = typename L::Bytes;
  using Twin = typename L::Twin;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;
  using Items = GiverItems<Arch, kDirections, kFeatures.support>;
  using Item = typename Items::Item;

 public:
  [[gnu::always_inline]] Pattern(const View& view, const Step& step, int z, const std::uint64_t* below,
                                 Gifts& gifts)
      : v_(view),
        step_(step),
        z_(z),
        gifts_(gifts),
        openness_(view),
        items_(z, below, gifts),
        receivers_(view, step.parameters->flow.paper, z, gifts),
        writer_(view, step, z, gifts),
        row_blocks_((static_cast<std::uint32_t>(view.nx) + 7) / 8),
        first_block_((static_cast<std::uint32_t>(z) * view.ny + gifts.first_row) * row_blocks_) {}

  // Returns the tiles where some cell may give.
  [[gnu::always_inline]] TileRow run(int r, TileRow tiles) {
    clear(r);
    items_.begin(v_, r, tiles);
    while (items_.more()) process(items_.collect(v_, openness_));
    gifts_.tiles(v_, r) = giving_;
    return restless_;
  }

 private:
  // Sets the patterns of words that give nothing to 0. (Rows beyond a last, shorter tile row stay as they
  // are, because nothing reads them.)
  [[gnu::always_inline]] void clear(int r) {
    if (gifts_.tiles(v_, r) == 0) return;
    const std::size_t first = gifts_.row(v_.tile_begin(r)), rows = gifts_.rows;
    const std::size_t tile = std::size_t{1} << v_.tile_shift, end = first + tile < rows ? first + tile : rows;
    for (std::size_t row = first; row < end; ++row) {
      for (TileRow old = gifts_.giving[row]; old != 0; old &= old - 1) {
        const int w = __builtin_ctzll(old);
        __builtin_memset(gifts_.pattern + row * v_.row + 64 * static_cast<std::size_t>(w), 0, 64);
        gifts_.givers[gifts_.word(v_, w, row)] = 0;
      }
      gifts_.giving[row] = 0;
    }
  }

  [[gnu::always_inline]] void process(int count) {
    std::uint8_t found[Items::kMost + 1];  // items with a direction that may receive
    int size = 0;
    for (int i = 0; i < count; ++i) {
      const Item& item = items_[i];
      const bool any = find_available(item);
      found[size] = static_cast<std::uint8_t>(i);
      restless_ |= TileRow{any} << word_of(item);
      size += any;
    }
    found[size] = size == 0 ? std::uint8_t{0} : found[size - 1];  // the partner of the last of an odd number
    for (int i = 0; i < size; i += 2) throw_dice(items_[found[i]], items_[found[i + 1]]);
  }

  // Writes into an item's pattern the directions to which its cells may give: open, and low enough. Without
  // `general` it writes the gifts, too. It returns true if there is any direction.
  [[gnu::always_inline]] bool find_available(const Item& item) const {
    const std::size_t at = item.at;
    const int lane = static_cast<int>(item.lane);
    typename Receivers<Arch, kFeatures>::Offer low, high;
    Bytes available = receivers_.find(at, writer_, low, high);
    if (item.givers != kEvery) available = L::both(available, L::fill(L::none(), L::where(item.givers)));
    available = openness_.inside(lane, available);
    if (item.walls) available = openness_.past_walls(lane, v_.walls_at(y_of(item), z_), available);
    const bool any = L::nonzero_bytes(available) != 0;
    // Writing unneeded gifts costs less than a mispredicted branch. With heat it costs more.
    if (kFeatures.hot && !any) return false;
    L::store_bytes(gifts_.pattern + at, available);
    if constexpr (!kFeatures.general) {
      writer_.write(at, low.flow, low.share);
      writer_.write(at + L::kCount, high.flow, high.share);
    }
    return any;
  }

  // Keeps a random subset of the directions of two items, which may be the same one.
  [[gnu::always_inline]] void throw_dice(const Item& first, const Item& second) {
    const std::uint32_t blocks[2] = {block_of(first), block_of(second)};
    Bytes dice[2];
    L::dice(step_.keys, step_.number, blocks, dice);
    keep(first, dice[0]);
    if (&first != &second) keep(second, dice[1]);
  }
  [[gnu::always_inline]] std::uint32_t block_of(const Item& item) const {
    return first_block_ + item.row * row_blocks_ + item.lane / 8;
  }

  [[gnu::always_inline]] void keep(const Item& item, Bytes dice) {
    std::uint8_t* pattern = gifts_.pattern + item.at;
    const Bytes kept = L::both(L::load_bytes(pattern), dice);
    L::store_bytes(pattern, kept);
    const Twin any = L::nonzero_bytes(kept);
    // There is one bit per cell. The bits of the cells from `lane` on begin at byte lane / 8 of the row.
    auto* row = reinterpret_cast<std::uint8_t*>(gifts_.givers + gifts_.word(v_, 0, item.row));
    __builtin_memcpy(row + item.lane / 8, &any, sizeof(Twin));
    const TileRow gives = TileRow{any != 0} << word_of(item);
    giving_ |= gives;
    gifts_.giving[item.row] |= gives;
    if constexpr (kFeatures.general)
      if (any != 0)
        for (std::uint32_t i = 0; i < Items::kCells; i += L::kCount)
          writer_.write_each(v_, item.at + i, y_of(item), item.lane + i);
  }

  [[gnu::always_inline]] int word_of(const Item& item) const { return static_cast<int>(item.lane / 64); }
  [[gnu::always_inline]] int y_of(const Item& item) const {
    return gifts_.first_row + static_cast<int>(item.row);
  }

  static constexpr Twin kEvery = static_cast<Twin>(~Twin{0});
  // No part refers to another, nor to v_, because g++ 12 keeps in memory any object that is pointed to.
  const View v_;
  const Step& step_;
  const int z_;
  Gifts& gifts_;
  const Openness<Arch, kDirections> openness_;
  Items items_;
  const Receivers<Arch, kFeatures> receivers_;
  const GiftWriter<Arch, kFeatures> writer_;
  const std::uint32_t row_blocks_, first_block_;  // block numbers of the random function
  TileRow restless_ = 0, giving_ = 0;
};

}  // namespace voxmelt::simd
