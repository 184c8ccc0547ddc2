// Phase `spread` of the paper's law, first half (Eqs. 7-10): which directions each cell gives to, and what.
//
// The work of a tile row is cut into items of two vectors each (a pattern is a byte, and so are dice), and
// goes through three stages by the batch, so that no stage waits for, or guesses, what another finds: items
// with a liquid cell; those with a direction that may receive; dice for two at a time.
#pragma once

#include "kernel/simd/contact.h"
#include "kernel/simd/features.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class Pattern {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  using Bytes = typename L::Bytes;
  using Twin = typename L::Twin;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;
  static constexpr int kCap = kFeatures.eight ? 4096 : 8192;
  static constexpr int kLimit = kFeatures.eight ? 11 * 4096 : 8 * 4096;
  static constexpr int kBatch = 64;

 public:
  [[gnu::always_inline]] Pattern(const View& view, const Step& step, int z, const std::uint64_t* below,
                                 Gifts& gifts)
      : v_(view),
        step_(step),
        law_(step.parameters->flow.paper),
        z_(z),
        row_blocks_((static_cast<std::uint32_t>(view.nx) + 7) / 8),
        walls_slice_(static_cast<std::ptrdiff_t>(view.ny + 2) * (view.words + 2)),
        below_(below),
        gifts_(gifts) {
    // The neighbour's place; beyond the grid its own: a masked lane.
    const std::ptrdiff_t front = z + 1 < v_.nz ? static_cast<std::ptrdiff_t>(v_.slice) : 0;
    const std::ptrdiff_t back = z > 0 ? -static_cast<std::ptrdiff_t>(v_.slice) : 0;
    const std::ptrdiff_t places[8] = {1, -1, front, back, front + 1, back + 1, front - 1, back - 1};
    for (int d = 0; d < 8; ++d) places_[d] = places[d];
  }

  // Returns the tiles where some cell may give.
  [[gnu::always_inline]] TileRow run(int r, TileRow tiles) {
    clear(r);
    int count = 0;
    for (int y = v_.tile_begin(r); tiles != 0 && y < v_.tile_end(r); ++y) {
      const std::size_t row = gifts_.row(y);
      for (TileRow work = tiles; work != 0; work &= work - 1) {
        const int w = __builtin_ctzll(work);
        const std::uint64_t givers = givers_of(w, y);
        if (givers == 0) continue;
        for (int twin = 0; twin < L::kTwins; ++twin) {
          const auto own = static_cast<Twin>(givers >> (twin * kCells));
          const std::size_t lane = static_cast<std::size_t>(64 * w + twin * kCells);
          items_[count] = {own, v_.cell(0, y, z_) + lane, row * v_.row + lane, gifts_.word(v_, w, row), y, w,
                           twin};
          count += own != 0;
        }
        if (count + L::kTwins <= kBatch) continue;
        process(count);
        count = 0;
      }
    }
    process(count);
    gifts_.tiles(v_, r) = giving_;
    return restless_;
  }

 private:
  static constexpr int kCells = 2 * L::kCount;  // of an item
  struct Item {
    Twin givers;
    std::size_t cell, gift, word;  // where it begins in the state, in the gifts, in their planes
    int y, w, twin;
  };

  // Patterns of words that give nothing are 0. (Rows beyond a last, shorter tile row stay as they are:
  // unread.)
  [[gnu::always_inline]] void clear(int r) {
    if (gifts_.tiles(v_, r) == 0) return;
    const std::size_t first = gifts_.row(v_.tile_begin(r)), rows = static_cast<std::size_t>(gifts_.rows);
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

  [[gnu::always_inline]] std::uint64_t givers_of(int w, int y) const {
    const std::uint64_t liquid = v_.liquid[v_.word(w, y, z_)];
    if (!kFeatures.support || y == 0) return liquid;
    const bool first = (y & ((1 << v_.tile_shift) - 1)) == 0;
    const std::uint64_t* below = first && below_ != nullptr ? below_ : v_.liquid + v_.word(0, y - 1, z_);
    return liquid & (v_.blocked(w, y - 1, z_) | below[w]);
  }

  [[gnu::always_inline]] void process(int count) {
    int found = 0;
    for (int i = 0; i < count; ++i) {
      const Item item = items_[i];
      const bool any = find_available(item);
      items_[found] = item;
      restless_ |= TileRow{any} << item.w;
      found += any;
    }
    for (int i = 0; i < found; i += 2) throw_dice(i, i + 1 < found);
  }

  struct Limits {
    V axis, diagonal;  // a neighbour receives if it holds less
    V flow, share;
    M energetic;
  };

  // The directions to which the cells of an item may give: open, and low enough; into its pattern, if there
  // is one. Lean: writes the gifts, too.
  [[gnu::always_inline]] bool find_available(const Item& item) {
    const std::size_t cell = item.cell;
    const Limits low = limits_of(cell), high = limits_of(cell + L::kCount);
    Bytes available = L::none();
    cpu::unrolled<kDirections>([&](auto d) VOXMELT_LAMBDA {
      const std::uint16_t* there = v_.amount + static_cast<std::ptrdiff_t>(cell) + places_[d];
      const M first = L::less(L::load_any(there), d < 4 ? low.axis : low.diagonal);
      const M second = L::less(L::load_any(there + L::kCount), d < 4 ? high.axis : high.diagonal);
      available = L::put(available, first, second, 1 << d);
    });
    available = L::both(L::in_order(available), givers_of(item, low, high));
    available = only_open(item, available);
    if (L::nonzero_bytes(available) == 0) return false;
    L::store_bytes(gifts_.pattern + item.gift, available);
    if constexpr (!kFeatures.general) {
      write_gifts(cell, item.gift, low);
      write_gifts(cell + L::kCount, item.gift + L::kCount, high);
    }
    return true;
  }
  [[gnu::always_inline]] void write_gifts(std::size_t cell, std::size_t gift, const Limits& of) const {
    const V warm = L::min(of.flow, L::high(L::load(v_.energy + cell), of.share));
    L::store(gifts_.flow[0] + gift, of.flow);
    L::store(gifts_.energy[0] + gift, warm);
    if constexpr (kFeatures.eight) {
      L::store(gifts_.flow[4] + gift, L::template shift_right<2>(of.flow));
      L::store(gifts_.energy[4] + gift, L::template shift_right<2>(warm));
    }
    if constexpr (kFeatures.hot)
      L::store(gifts_.heat + gift, L::load(v_.temperature + cell) ^ L::set(0x8000));
  }

  // Of one vector: a neighbour receives if it holds less than the giver's amount less the larger of flow and
  // margin.
  [[gnu::always_inline]] Limits limits_of(std::size_t cell) const {
    const V amount = L::load(v_.amount + cell), energy = L::load(v_.energy + cell);
    const V sh = share(cell);
    V flow = L::min(L::high(amount, sh), L::set(kCap));
    if constexpr (kFeatures.general)
      if (law_.use_table) flow = L::zero();
    const M energetic = L::less(L::set(law_.threshold), energy);
    V margin = L::set(law_.margin);
    if constexpr (kBuilt.slump) margin = L::select(energetic, margin, L::set(law_.slump));
    const V most = L::set(kLimit);
    V axis = L::min(most, L::sub_saturated(amount, L::max(flow, margin)));
    const V wider = L::add_saturated(margin, L::template shift_right<3>(margin));
    V diagonal = L::min(most, L::sub_saturated(amount, L::max(flow, wider)));
    if constexpr (kFeatures.general)
      if (!law_.downhill) axis = diagonal = most;
    return {axis, diagonal, flow, sh, energetic};
  }

  // All ones where a cell is liquid, and has the energy to give.
  [[gnu::always_inline]] Bytes givers_of(const Item& item, const Limits& low, const Limits& high) const {
    const Bytes liquid = item.givers == kEvery ? L::every() : L::put(L::none(), item.givers, 0xFF);
    if (kBuilt.slump && law_.slump != 0) return liquid;
    return L::both(liquid, L::in_order(L::put(L::none(), low.energetic, high.energetic, 0xFF)));
  }

  // Without directions whose neighbour is blocked or, across a diagonal, behind two blocked ones.
  [[gnu::always_inline]] Bytes only_open(const Item& item, Bytes available) const {
    const int w = item.w, shift = item.twin * kCells;
    const std::uint64_t *own = v_.walls_at(item.y, z_) + w, *front = own + walls_slice_,
                        *back = own - walls_slice_;
    const auto around = [](const std::uint64_t* row) { return row[0] | row[-1] >> 63 | row[1] << 63; };
    if ((around(own) | around(front) | around(back)) == 0) return available;  // most of the time
    Bytes open = L::none();
    const auto put = [&](int d, std::uint64_t blocked) VOXMELT_LAMBDA {
      open = L::put(open, static_cast<Twin>(~blocked >> shift), 1 << d);
    };
    const std::uint64_t right = cpu::from_right(own[0], own[1]), left = cpu::from_left(own[0], own[-1]);
    put(0, right);
    put(1, left);
    put(2, front[0]);
    put(3, back[0]);
    if constexpr (kFeatures.eight) {
      put(4, cpu::from_right(front[0], front[1]) | (right & front[0]));
      put(5, cpu::from_right(back[0], back[1]) | (right & back[0]));
      put(6, cpu::from_left(front[0], front[-1]) | (left & front[0]));
      put(7, cpu::from_left(back[0], back[-1]) | (left & back[0]));
    }
    return L::both(available, open);
  }

  // Keeps a random subset of the directions of an item, and of the next one if `two`.
  [[gnu::always_inline]] void throw_dice(int first, bool two) {
    const Item* items = items_ + first;
    std::uint32_t blocks[2];
    for (int i = 0; i < 2; ++i) {
      const Item& item = items[two ? i : 0];
      const auto row = static_cast<std::uint32_t>(z_) * static_cast<std::uint32_t>(v_.ny) +
                       static_cast<std::uint32_t>(item.y);
      blocks[i] = row * row_blocks_ + static_cast<std::uint32_t>(64 * item.w + item.twin * kCells) / 8;
    }
    Bytes dice[2];
    L::dice(step_.keys, step_.number, blocks, dice);
    keep(items[0], dice[0]);
    if (two) keep(items[1], dice[1]);
  }
  [[gnu::always_inline]] void keep(const Item& item, Bytes dice) {
    std::uint8_t* at = gifts_.pattern + item.gift;
    const Bytes pattern = L::both(L::load_bytes(at), dice);
    L::store_bytes(at, pattern);
    const Twin any = L::nonzero_bytes(pattern);
    auto* givers = reinterpret_cast<std::uint8_t*>(gifts_.givers + item.word);
    __builtin_memcpy(givers + static_cast<std::size_t>(item.twin) * sizeof(Twin), &any, sizeof(Twin));
    const TileRow gives = TileRow{any != 0} << item.w;
    giving_ |= gives;
    gifts_.giving[gifts_.row(item.y)] |= gives;
    if constexpr (kFeatures.general)
      if (any != 0) give(item);
  }

  // Thermal viscosity: share times the table, cut at what all neighbours together can take.
  [[gnu::always_inline]] V share(std::size_t cell) const {
    if constexpr (!kFeatures.thermal) return L::set(law_.share);
    const V mobility =
        L::lookup(step_.parameters->flow.mobility_table.data(), L::load(v_.temperature + cell));
    const V sh = L::set(law_.share);  // below 2^15: the product >> 15 may need 17 bits, which the cut takes
    const V high = L::high(sh, mobility), low = L::template shift_right<15>(L::low(sh, mobility));
    return L::min(L::add_saturated(L::add_saturated(high, high), low),
                  L::set(kFeatures.eight ? 13107 : 16384));
  }

  // The gifts of every direction on their own: shares by pattern, energy by the printed reading.
  [[gnu::always_inline]] void give(const Item& item) {
    for (int k = 0; k < 2; ++k) {
      const auto at = static_cast<std::size_t>(k * L::kCount);
      const std::size_t cell = item.cell + at, gift = item.gift + at;
      const V amount = L::load(v_.amount + cell), energy = L::load(v_.energy + cell);
      if constexpr (kFeatures.hot)
        L::store(gifts_.heat + gift, L::load(v_.temperature + cell) ^ L::set(0x8000));
      const V same = law_.use_table ? L::zero() : share(cell);
      for (int d = 0; d < kDirections; ++d) {
        const V sh = law_.use_table ? share_by_pattern(gifts_.pattern + gift, d) : same;
        V flow = L::min(L::high(amount, sh), L::set(kCap)), warm = L::min(L::high(energy, sh), L::set(kCap));
        if (d >= 4) {
          flow = L::template shift_right<2>(flow);
          warm = L::template shift_right<2>(warm);
        }
        warm = L::min(flow, warm);
        if (law_.reading == rule::EnergyReading::printed)
          warm = L::high(warm, contact_alpha<Arch>(v_, law_, item.w, item.y, z_, 2 * item.twin + k));
        L::store(gifts_.flow[d] + gift, flow);
        L::store(gifts_.energy[d] + gift, warm);
      }
    }
  }
  [[gnu::always_inline]] V share_by_pattern(const std::uint8_t* patterns, int d) const {
    alignas(64) std::uint16_t shares[L::kCount];
    for (int i = 0; i < L::kCount; ++i) shares[i] = law_.table[patterns[i] & 15][d];
    return L::load(shares);
  }

  static constexpr Twin kEvery = static_cast<Twin>(~Twin{0});
  const View v_;
  const Step& step_;
  const rule::PaperLaw& law_;
  const int z_;
  const std::uint32_t row_blocks_;
  const std::ptrdiff_t walls_slice_;
  TileRow restless_ = 0, giving_ = 0;
  const std::uint64_t* below_;
  Gifts& gifts_;
  std::ptrdiff_t places_[8];
  Item items_[kBatch + L::kTwins];
};

}  // namespace voxmelt::simd
