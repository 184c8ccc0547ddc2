// Phase `spread` of the paper's law, first half (Eqs. 7-10): which directions each cell gives to, and what.
//
// The work of a tile row is cut into items of one vector each, and goes through three stages by the batch, so
// that no stage waits for, or guesses, what another finds: items with a liquid cell; those with a direction
// that may receive; dice for four items at a time.
#pragma once

#include "kernel/simd/contact.h"
#include "kernel/simd/features.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class Pattern {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  using Bits = typename L::Bits;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;
  static constexpr int kCap = kFeatures.eight ? 4096 : 8192;
  static constexpr int kLimit = kFeatures.eight ? 11 * 4096 : 8 * 4096;
  static constexpr int kBatch = 128;

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
    for (int y = v_.tile_begin(r); tiles != 0 && y < v_.tile_end(r); ++y)
      for (TileRow work = tiles; work != 0; work &= work - 1) {
        const int w = __builtin_ctzll(work);
        const std::uint64_t givers = givers_of(w, y);
        if (givers == 0) continue;
        for (int part = 0; part < L::kParts; ++part) {
          const auto own = static_cast<Bits>(givers >> (part * L::kCount));
          items_[count] = {y, w, part, own};
          count += own != 0;
        }
        if (count + L::kParts <= kBatch) continue;
        process(count);
        count = 0;
      }
    process(count);
    gifts_.tiles(v_, r) = giving_;
    return restless_;
  }

 private:
  struct Item {
    int y, w, part;
    Bits givers;
  };
  using Four = Bits[4];  // of four items

  // Planes of words that give nothing are 0. (Rows beyond a last, shorter tile row stay as they are: unread.)
  [[gnu::always_inline]] void clear(int r) {
    if (gifts_.tiles(v_, r) == 0) return;
    const std::size_t first = gifts_.row(v_.tile_begin(r)), rows = static_cast<std::size_t>(gifts_.rows);
    const std::size_t tile = std::size_t{1} << v_.tile_shift, end = first + tile < rows ? first + tile : rows;
    for (std::size_t row = first; row < end; ++row) {
      for (TileRow old = gifts_.giving[row]; old != 0; old &= old - 1) {
        std::uint64_t* planes = gifts_.planes + gift_word(__builtin_ctzll(old), row);
        for (int d = 0; d < 8; ++d) planes[d] = 0;
      }
      gifts_.giving[row] = gifts_.giving_left[row] = gifts_.giving_right[row] = 0;
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
      const bool any = find_available(item, available_[found / 4], found % 4);
      items_[found] = item;
      restless_ |= TileRow{any} << item.w;
      found += any;
    }
    for (int i = found; i % 4 != 0; ++i) {  // the last four are filled up with items that give nothing
      items_[i] = items_[0];
      for (int d = 0; d < kDirections; ++d) available_[i / 4][d][i % 4] = 0;
    }
    for (int i = 0; i < found; i += 4) throw_dice(i, found - i < 4 ? found - i : 4);
  }

  // The directions to which the cells of an item may give: open, and low enough. Lean: writes the gifts, too.
  [[gnu::always_inline]] bool find_available(const Item& item, Four* available, int place) {
    const std::size_t lane = lane_of(item);
    const std::size_t cell = v_.cell(0, item.y, z_) + lane;
    const V amount = L::load(v_.amount + cell), energy = L::load(v_.energy + cell);
    const V sh = share(cell);
    V flow = L::min(L::high(amount, sh), L::set(kCap));
    if constexpr (kFeatures.general)
      if (law_.use_table) flow = L::zero();
    // A neighbour receives if it holds less than a limit: the giver's amount less the larger of flow and
    // margin.
    const M energetic = L::less(L::set(law_.threshold), energy);
    V margin = L::set(law_.margin);
    if constexpr (kBuilt.slump) margin = L::select(energetic, margin, L::set(law_.slump));
    const V most = L::set(kLimit);
    V limits[2];
    limits[0] = L::min(most, L::sub_saturated(amount, L::max(flow, margin)));
    const V diagonal = L::add_saturated(margin, L::template shift_right<3>(margin));
    limits[1] = L::min(most, L::sub_saturated(amount, L::max(flow, diagonal)));
    if constexpr (kFeatures.general)
      if (!law_.downhill) limits[0] = limits[1] = most;

    Bits givers = item.givers;
    if (!kBuilt.slump || law_.slump == 0) givers = static_cast<Bits>(givers & L::to_bits(energetic));
    givers = static_cast<Bits>(givers & ~L::to_bits(L::equal(limits[0], L::zero())));
    if (givers == 0) return false;  // films too thin to give

    Bits own[8], any = 0;
    const Bits* open = open_directions(item, own);
    cpu::unrolled<kDirections>([&](auto d) VOXMELT_LAMBDA {
      const V there = L::load_any(v_.amount + static_cast<std::ptrdiff_t>(cell) + places_[d]);
      const auto receives = static_cast<Bits>(L::to_bits(L::less(there, limits[d / 4])) & open[d] & givers);
      available[d][place] = receives;
      any = static_cast<Bits>(any | receives);
    });
    if (any == 0) return false;
    if constexpr (!kFeatures.general) {
      const std::size_t gift = gifts_.row(item.y) * v_.row + lane;
      const V warm = L::min(flow, L::high(energy, sh));
      L::store(gifts_.flow[0] + gift, flow);
      L::store(gifts_.energy[0] + gift, warm);
      if constexpr (kFeatures.eight) {
        L::store(gifts_.flow[4] + gift, L::template shift_right<2>(flow));
        L::store(gifts_.energy[4] + gift, L::template shift_right<2>(warm));
      }
      if constexpr (kFeatures.hot)
        L::store(gifts_.heat + gift, L::load(v_.temperature + cell) ^ L::set(0x8000));
    }
    return true;
  }

  // Cells whose neighbour is neither blocked nor, across a diagonal, behind two blocked ones; in `own` unless
  // no wall is near, which is most of the time.
  [[gnu::always_inline]] const Bits* open_directions(const Item& item, Bits* own_open) const {
    static constexpr Bits kOpen[8] = {kEvery, kEvery, kEvery, kEvery, kEvery, kEvery, kEvery, kEvery};
    const int w = item.w, shift = item.part * L::kCount;
    const std::uint64_t *own = v_.walls_at(item.y, z_) + w, *front = own + walls_slice_,
                        *back = own - walls_slice_;
    const auto around = [](const std::uint64_t* row) { return row[0] | row[-1] >> 63 | row[1] << 63; };
    if ((around(own) | around(front) | around(back)) == 0) return kOpen;
    const auto put = [&](int d, std::uint64_t blocked) {
      own_open[d] = static_cast<Bits>(~blocked >> shift);
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
    return own_open;
  }

  // Keeps a random subset of the directions of four items, of which the first `count` are there.
  [[gnu::always_inline]] void throw_dice(int first, int count) {
    std::uint32_t blocks[4];
    for (int i = 0; i < 4; ++i) {
      const Item& item = items_[first + i];
      const auto row = static_cast<std::uint32_t>(z_) * static_cast<std::uint32_t>(v_.ny) +
                       static_cast<std::uint32_t>(item.y);
      blocks[i] = row * row_blocks_ + static_cast<std::uint32_t>(lane_of(item)) / 8;
    }
    alignas(16) Four dice[8];
    L::dice(step_.keys, step_.number, blocks, dice);
    Four* patterns = available_[first / 4];
    Four any{}, left{}, right{};
    cpu::unrolled<kDirections>([&](auto d) VOXMELT_LAMBDA {
      for (int i = 0; i < 4; ++i) {
        const auto pattern = static_cast<Bits>(patterns[d][i] & dice[d][i]);
        patterns[d][i] = pattern;
        any[i] = static_cast<Bits>(any[i] | pattern);
        if constexpr (d == 1 || d == 6 || d == 7) left[i] = static_cast<Bits>(left[i] | pattern);
        if constexpr (d == 0 || d == 4 || d == 5) right[i] = static_cast<Bits>(right[i] | pattern);
      }
    });
    for (int i = 0; i < count; ++i) {
      const Item& item = items_[first + i];
      const std::size_t row = gifts_.row(item.y);
      auto* planes = reinterpret_cast<Bits*>(gifts_.planes + gift_word(item.w, row)) + item.part;
      cpu::unrolled<kDirections>([&](auto d) VOXMELT_LAMBDA { planes[d * L::kParts] = patterns[d][i]; });
      const TileRow word = TileRow{1} << item.w, gives = any[i] != 0 ? word : 0;
      giving_ |= gives;
      gifts_.giving[row] |= gives;
      gifts_.giving_left[row] |= item.part == 0 && (left[i] & 1u) != 0 ? word : 0;
      gifts_.giving_right[row] |= item.part == L::kParts - 1 && (right[i] >> (L::kCount - 1)) != 0 ? word : 0;
      if constexpr (kFeatures.general) {
        Bits pattern[8];
        for (int d = 0; d < kDirections; ++d) pattern[d] = patterns[d][i];
        if (any[i] != 0) give(item, pattern);
      }
    }
  }

  [[gnu::always_inline]] std::size_t gift_word(int w, std::size_t row) const {
    return 8 * (row * static_cast<std::size_t>(v_.words + 2) + 1 + static_cast<std::size_t>(w));
  }
  [[gnu::always_inline]] static std::size_t lane_of(const Item& item) {
    return 64 * static_cast<std::size_t>(item.w) + static_cast<std::size_t>(item.part * L::kCount);
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
  [[gnu::always_inline]] void give(const Item& item, const Bits* pattern) {
    const std::size_t cell = v_.cell(0, item.y, z_) + lane_of(item);
    const std::size_t gift = gifts_.row(item.y) * v_.row + lane_of(item);
    const V amount = L::load(v_.amount + cell), energy = L::load(v_.energy + cell);
    if constexpr (kFeatures.hot)
      L::store(gifts_.heat + gift, L::load(v_.temperature + cell) ^ L::set(0x8000));
    const V same = law_.use_table ? L::zero() : share(cell);
    for (int d = 0; d < kDirections; ++d) {
      const V sh = law_.use_table ? share_by_pattern(pattern, d) : same;
      V flow = L::min(L::high(amount, sh), L::set(kCap)), warm = L::min(L::high(energy, sh), L::set(kCap));
      if (d >= 4) {
        flow = L::template shift_right<2>(flow);
        warm = L::template shift_right<2>(warm);
      }
      warm = L::min(flow, warm);
      if (law_.reading == rule::EnergyReading::printed)
        warm = L::high(warm, contact_alpha<Arch>(v_, law_, item.w, item.y, z_, item.part));
      L::store(gifts_.flow[d] + gift, flow);
      L::store(gifts_.energy[d] + gift, warm);
    }
  }
  [[gnu::always_inline]] V share_by_pattern(const Bits* planes, int d) const {
    alignas(64) std::uint16_t shares[L::kCount];
    for (int i = 0; i < L::kCount; ++i) {
      std::size_t pattern = 0;
      for (std::size_t k = 0; k < 4; ++k) pattern |= static_cast<std::size_t>(planes[k] >> i & 1u) << k;
      shares[i] = (&law_.table[0][0])[4 * pattern + static_cast<std::size_t>(d)];
    }
    return L::load(shares);
  }

  static constexpr Bits kEvery = static_cast<Bits>(~Bits{0});
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
  Item items_[kBatch + 4];
  alignas(64) Four available_[kBatch / 4 + 1][8];
};

}  // namespace voxmelt::simd
