// Phase `spread` of the paper's law, first half (Eqs. 7-10): which directions each cell gives to, and what.
//
// The work of a tile row is cut into items of two vectors each (a pattern is a byte, and so are dice), and
// goes through three stages by the batch, so that no stage waits for, or guesses, what another finds: items
// with a liquid cell; those with a direction that may receive; dice for two at a time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/contact.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/openness.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class Pattern {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using Bytes = typename L::Bytes;
  using Twin = typename L::Twin;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;
  static constexpr int kCap = rule::flow_cap(kDirections);
  static constexpr int kLimit = rule::receiver_limit(kDirections);
  static constexpr int kBatch = 64;

 public:
  [[gnu::always_inline]] Pattern(const View& view, const Step& step, int z, const std::uint64_t* below,
                                 Gifts& gifts)
      : v_(view),
        step_(step),
        law_(step.parameters->flow.paper),
        z_(z),
        base_(view.cell(0, gifts.first_row, z)),
        row_blocks_((static_cast<std::uint32_t>(view.nx) + 7) / 8),
        first_block_((static_cast<std::uint32_t>(z) * static_cast<std::uint32_t>(view.ny) +
                      static_cast<std::uint32_t>(gifts.first_row)) *
                     row_blocks_),
        openness_(view),
        share_(L::set(law_.share)),
        threshold_(L::set(law_.threshold)),
        margin_(L::set(law_.margin)),
        wider_(wider(margin_)),
        slumps_(kBuilt.slump && law_.slump != 0),
        below_(below),
        gifts_(gifts) {
    if constexpr (kFeatures.thermal) shares_ = share_table(*step.parameters);
    // Rows beyond the grid are masked: any address will do.
    own_ = view.amount + base_;
    front_ = z + 1 < view.nz ? own_ + view.slice : own_;
    back_ = z > 0 ? own_ - view.slice : own_;
  }

  // Returns the tiles where some cell may give.
  [[gnu::always_inline]] TileRow run(int r, TileRow tiles) {
    clear(r);
    const int end = v_.tile_end(r);
    Row row = row_of(v_.tile_begin(r));
    TileRow work = tiles;
    while (row.y < end) {
      int count = 0;
      while (count + L::kTwins <= kBatch) {
        if (work == 0) {
          row.climb(*this);
          if (row.y == end) break;
          work = tiles;
          continue;
        }
        count = collect(__builtin_ctzll(work), row, count);
        work &= work - 1;
      }
      process(count);
    }
    gifts_.tiles(v_, r) = giving_;
    return restless_;
  }

 private:
  static constexpr int kCells = 2 * L::kCount;  // of an item
  struct Item {
    std::uint32_t at;    // where it begins in the state and in the gifts, from their first row
    std::uint32_t mask;  // its word in the planes of the gifts
    std::uint32_t row;   // in the gifts
    std::uint16_t lane;  // its first cell along x
    bool walls;          // beside some of its cells, not counting the border in x
    Twin givers;
  };

  // Where a row begins in the planes and fields.
  struct Row {
    int y;
    std::uint32_t row, at, mask;  // in the gifts
    const std::uint64_t *liquid, *below, *walls;
    [[gnu::always_inline]] void climb(const Pattern& p) {
      ++y;
      ++row;
      at += static_cast<std::uint32_t>(p.v_.row);
      mask += static_cast<std::uint32_t>(p.v_.words) + 2;
      below = liquid;
      liquid += p.v_.words;
      walls += p.v_.words + 2;
    }
  };
  [[gnu::always_inline]] Row row_of(int y) const {
    const std::size_t row = gifts_.row(y);
    const std::uint64_t* liquid = v_.liquid + v_.word(0, y, z_);
    return {y,
            static_cast<std::uint32_t>(row),
            static_cast<std::uint32_t>(row * v_.row),
            static_cast<std::uint32_t>(gifts_.word(v_, 0, row)),
            liquid,
            below_ != nullptr ? below_ : liquid - (y > 0 ? v_.words : 0),
            v_.walls_at(y, z_)};
  }

  [[gnu::always_inline]] int y_of(const Item& item) const {
    return gifts_.first_row + static_cast<int>(item.row);
  }

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

  // Appends the items of a word in which somebody may give; returns how many there are then.
  [[gnu::always_inline]] int collect(int w, const Row& row, int count) {
    std::uint64_t givers = row.liquid[w];
    if (givers == 0) return count;
    // With support only who stands on something; what is below the grid is a wall.
    if (kFeatures.support) givers &= row.walls[w - (v_.words + 2)] | row.below[w];
    const std::uint64_t walls = openness_.beside_walls(w, row.walls);
    for (int twin = 0; twin < L::kTwins; ++twin) {
      const auto lane = static_cast<std::uint32_t>(64 * w + twin * kCells);
      items_[count] = {row.at + lane,
                       row.mask + static_cast<std::uint32_t>(w),
                       row.row,
                       static_cast<std::uint16_t>(lane),
                       static_cast<Twin>(walls >> (twin * kCells)) != 0,
                       static_cast<Twin>(givers >> (twin * kCells))};
      count += items_[count].givers != 0;
    }
    return count;
  }

  [[gnu::always_inline]] void process(int count) {
    int found = 0;
    for (int i = 0; i < count; ++i) {
      const Item& item = items_[i];
      const bool any = find_available(item);
      found_[found] = static_cast<std::uint8_t>(i);
      restless_ |= TileRow{any} << (item.lane / 64);
      found += any;
    }
    found_[found] = found == 0 ? std::uint8_t{0} : found_[found - 1];  // for the last of an odd number
    for (int i = 0; i < found; i += 2) throw_dice(items_[found_[i]], items_[found_[i + 1]]);
  }

  struct Margins {
    V axis, diagonal;
  };
  // Of one vector: who is starved of energy has a margin of its own.
  [[gnu::always_inline]] Margins margins_of(std::size_t at) const {
    const auto energetic = L::less(threshold_, L::load(v_.energy + base_ + at));
    const V margin = L::select(energetic, margin_, L::set(law_.slump));
    return {margin, wider(margin)};
  }

  struct Limits {
    V axis, diagonal;  // a neighbour receives if it holds less
    V flow, share;
  };

  // The directions to which the cells of an item may give: open, and low enough; into its pattern. Lean:
  // writes the gifts, too. Returns whether there is any.
  [[gnu::always_inline]] bool find_available(const Item& item) {
    const std::size_t at = item.at;
    Margins low_margins{margin_, wider_}, high_margins = low_margins;
    if (slumps_) {
      low_margins = margins_of(at);
      high_margins = margins_of(at + L::kCount);
    }
    const Limits low = limits_of(at, low_margins), high = limits_of(at + L::kCount, high_margins);
    Bytes closed = L::none();
    cpu::unrolled<kDirections>([&](auto i) VOXMELT_LAMBDA {
      constexpr int d = kDirections - 1 - i;
      constexpr std::ptrdiff_t dx = d < 4 ? (d == 0) - (d == 1) : (d < 6 ? 1 : -1);
      const std::uint16_t* there = (d < 2 ? own_ : d % 2 == 0 ? front_ : back_) + at + dx;
      const auto full = L::not_less(L::load_any(there), d < 4 ? low.axis : low.diagonal,
                                    L::load_any(there + L::kCount), d < 4 ? high.axis : high.diagonal);
      closed = L::push(closed, full, d);
    });
    if (!slumps_) {  // who has no energy gives nothing
      const std::uint16_t* energy = v_.energy + base_ + at;
      closed =
          L::fill(closed, L::not_less(threshold_, L::load(energy), threshold_, L::load(energy + L::kCount)));
    }
    Bytes available = L::without(L::bytes(kDirectionBits), L::in_order(closed));
    if (item.givers != kEvery) available = L::both(available, L::fill(L::none(), L::where(item.givers)));
    available = openness_.inside(item.lane, available);
    if (item.walls) available = openness_.past_walls(item.lane, v_.walls_at(y_of(item), z_), available);
    const bool any = L::nonzero_bytes(available) != 0;
    // Writing what nobody asks for costs less than a wrong guess; with heat, more.
    if (kFeatures.hot && !any) return false;
    L::store_bytes(gifts_.pattern + at, available);
    if constexpr (!kFeatures.general) {
      write_gifts(at, low);
      write_gifts(at + L::kCount, high);
    }
    return any;
  }
  [[gnu::always_inline]] void write_gifts(std::size_t at, const Limits& of) const {
    const V warm = L::min(of.flow, L::high(L::load(v_.energy + base_ + at), of.share));
    L::store(gifts_.flow[0] + at, of.flow);
    L::store(gifts_.energy[0] + at, warm);
    if constexpr (kFeatures.eight) {
      L::store(gifts_.flow[4] + at, L::template shift_right<2>(of.flow));
      L::store(gifts_.energy[4] + at, L::template shift_right<2>(warm));
    }
    if constexpr (kFeatures.hot) L::store(gifts_.heat + at, L::load(v_.heat + base_ + at) ^ L::set(0x8000));
  }

  // Of one vector: a neighbour receives if it holds less than the giver's amount less the larger of flow and
  // margin.
  [[gnu::always_inline]] Limits limits_of(std::size_t at, const Margins& margins) const {
    const V amount = L::load(own_ + at);
    const V sh = share(at);
    V flow = L::min(L::high(amount, sh), L::set(kCap));
    if constexpr (kFeatures.general)
      if (law_.use_table) flow = L::zero();
    const V most = L::set(kLimit);
    V axis = L::min(most, L::sub_saturated(amount, L::max(flow, margins.axis)));
    V diagonal = L::min(most, L::sub_saturated(amount, L::max(flow, margins.diagonal)));
    if constexpr (kFeatures.general)
      if (!law_.downhill) axis = diagonal = most;
    return {axis, diagonal, flow, sh};
  }

  [[gnu::always_inline]] static V wider(V margin) {
    return L::add_saturated(margin, L::template shift_right<3>(margin));
  }

  // Keeps a random subset of the directions of two items, which may be the same one.
  [[gnu::always_inline]] void throw_dice(const Item& first, const Item& second) {
    const std::uint32_t blocks[2] = {first_block_ + first.row * row_blocks_ + first.lane / 8u,
                                     first_block_ + second.row * row_blocks_ + second.lane / 8u};
    Bytes dice[2];
    L::dice(step_.keys, step_.number, blocks, dice);
    keep(first, dice[0]);
    if (&first != &second) keep(second, dice[1]);
  }
  [[gnu::always_inline]] void keep(const Item& item, Bytes dice) {
    std::uint8_t* at = gifts_.pattern + item.at;
    const Bytes pattern = L::both(L::load_bytes(at), dice);
    L::store_bytes(at, pattern);
    const Twin any = L::nonzero_bytes(pattern);
    auto* givers = reinterpret_cast<std::uint8_t*>(gifts_.givers + item.mask);
    __builtin_memcpy(givers + item.lane % 64 / kCells * sizeof(Twin), &any, sizeof(Twin));
    const TileRow gives = TileRow{any != 0} << (item.lane / 64);
    giving_ |= gives;
    gifts_.giving[item.row] |= gives;
    if constexpr (kFeatures.general)
      if (any != 0) give(item);
  }

  // Thermal viscosity: share times the table, cut at what all neighbours together can take.
  [[gnu::always_inline]] V share(std::size_t at) const {
    if constexpr (!kFeatures.thermal) return share_;
    return L::lookup(shares_, L::load(v_.heat + base_ + at));
  }
  [[gnu::always_inline]] static typename L::Table share_table(const rule::Parameters& parameters) {
    alignas(64) std::uint16_t shares[32];
    const V sh = L::set(parameters.flow.paper.share);  // below 2^15
    for (std::size_t i = 0; i < 32; i += L::kCount) {
      const V mobility = L::load_any(parameters.flow.mobility_table.data() + i);
      // The product >> 15 may need 17 bits, which the cut takes.
      const V high = L::high(sh, mobility), low = L::template shift_right<15>(L::low(sh, mobility));
      L::store(shares + i, L::min(L::add_saturated(L::add_saturated(high, high), low),
                                  L::set(rule::largest_share(kDirections))));
    }
    return L::table(shares);
  }

  // The gifts of every direction on their own: shares by pattern, energy by the printed reading.
  [[gnu::always_inline]] void give(const Item& item) {
    const int y = y_of(item);
    for (int k = 0; k < 2; ++k) {
      const std::size_t at = item.at + static_cast<std::size_t>(k * L::kCount);
      const V amount = L::load(own_ + at), energy = L::load(v_.energy + base_ + at);
      if constexpr (kFeatures.hot) L::store(gifts_.heat + at, L::load(v_.heat + base_ + at) ^ L::set(0x8000));
      const V same = law_.use_table ? L::zero() : share(at);
      for (int d = 0; d < kDirections; ++d) {
        const V sh = law_.use_table ? share_by_pattern(gifts_.pattern + at, d) : same;
        V flow = L::min(L::high(amount, sh), L::set(kCap)), warm = L::min(L::high(energy, sh), L::set(kCap));
        if (d >= 4) {
          flow = L::template shift_right<2>(flow);
          warm = L::template shift_right<2>(warm);
        }
        warm = L::min(flow, warm);
        if (law_.reading == rule::EnergyReading::printed)
          warm = L::high(warm, contact_alpha<Arch>(v_, law_, y == 0, v_.word(item.lane / 64, y, z_),
                                                   item.lane % 64 / L::kCount + k));
        L::store(gifts_.flow[d] + at, flow);
        L::store(gifts_.energy[d] + at, warm);
      }
    }
  }
  [[gnu::always_inline]] V share_by_pattern(const std::uint8_t* patterns, int d) const {
    alignas(64) std::uint16_t shares[L::kCount];
    for (int i = 0; i < L::kCount; ++i) shares[i] = law_.table[patterns[i] & 15][d];
    return L::load(shares);
  }

  static constexpr Twin kEvery = static_cast<Twin>(~Twin{0});
  static constexpr int kDirectionBits = (1 << kDirections) - 1;
  const View v_;
  const Step& step_;
  const rule::PaperLaw& law_;
  const int z_;
  const std::size_t base_;  // first cell of the gifts' first row
  const std::uint32_t row_blocks_, first_block_;
  const Openness<Arch, kDirections> openness_;
  const V share_, threshold_, margin_, wider_;
  const bool slumps_;
  typename L::Table shares_;                   // by heat; with thermal viscosity
  const std::uint16_t *own_, *front_, *back_;  // amounts there, in this slice and the ones beside it
  TileRow restless_ = 0, giving_ = 0;
  const std::uint64_t* below_;
  Gifts& gifts_;
  Item items_[kBatch];
  std::uint8_t found_[kBatch + 1];
};

}  // namespace voxmelt::simd
