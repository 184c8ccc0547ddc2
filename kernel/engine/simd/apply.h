// The second half of phase `spread` of the paper's law (Eqs. 11-20) lets every cell gather the gifts of its
// neighbours. It works row by row on one slice, in place. The amount, energy and heat that a neighbour gives
// are read from the gifts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernel/engine/simd/contact.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/mix.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class Apply {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;
  // A gift to a diagonal is a quarter of the stored one.
  static constexpr bool kQuarters = kFeatures.eight && !kFeatures.general && !L::kMaskedSums;

 public:
  [[gnu::always_inline]] Apply(const View& view, const Step& step, int z, const Gifts& below,
                               const Gifts& own, const Gifts& above, Books& books)
      : v_(view),
        law_(step.parameters->flow.paper),
        dither_(L::set(static_cast<int>(step.dither))),
        undithered_(L::set(static_cast<int>(0xFFFF - step.dither))),
        z_(z),
        below_(below),
        own_(own),
        above_(above),
        books_(books),
        mix_(step.dither) {}

  // Returns the tiles that changed.
  [[gnu::always_inline]] TileRow run(int r) {
    const TileRow words = v_.words == 64 ? ~TileRow{0} : (TileRow{1} << v_.words) - 1;
    const int end = v_.tile_end(r);
    start(v_.tile_begin(r));
    Row row{v_.tile_begin(r), 0, 0};
    TileRow changed = 0, work = beside_giving(row.y) & words;
    while (row.y < end) {
      int count = 0;
      while (count + L::kParts <= kBatch) {
        if (work == 0) {
          if (++row.y == end) break;
          row.at += static_cast<std::uint32_t>(v_.row);
          row.mask += static_cast<std::uint32_t>(v_.words);
          givers_.climb(v_);
          work = beside_giving(row.y) & words;
          continue;
        }
        const int w = __builtin_ctzll(work);
        work &= work - 1;
        const int before = count;
        count = collect(w, row, count);
        changed |= TileRow{count != before} << w;
      }
      process(count);
    }
    flush();
    return changed;
  }

 private:
  static constexpr int kBatch = 64;
  // Tells where a vector begins in the state and in the gifts, counted from the first row of the tile row.
  // The upper 32 bits hold its word in the planes.
  using Item = std::uint64_t;
  static Item item(std::uint32_t at, std::uint32_t mask) { return Item{mask} << 32 | at; }
  static std::size_t at(Item item) { return item & 0xFFFFFFFF; }
  static std::size_t mask(Item item) { return item >> 32; }
  struct Row {
    int y;
    std::uint32_t at, mask;
  };
  // Marks the cells that give something, in the present row of three slices.
  struct Givers {
    const std::uint64_t *below, *own, *above;
    [[gnu::always_inline]] void climb(const View& v) {
      below += v.words + 2;
      own += v.words + 2;
      above += v.words + 2;
    }
    [[gnu::always_inline]] std::uint64_t operator[](int w) const { return below[w] | own[w] | above[w]; }
  };

  [[gnu::always_inline]] void start(int y) {
    cell_ = v_.cell(0, y, z_);
    word_ = v_.word(0, y, z_);
    bottom_ = y == 0;
    below_at_ = below_.row(y) * v_.row;
    own_at_ = own_.row(y) * v_.row;
    above_at_ = above_.row(y) * v_.row;
    givers_ = {below_.givers + below_.word(v_, 0, below_.row(y)), own_.givers + own_.word(v_, 0, own_.row(y)),
               above_.givers + above_.word(v_, 0, above_.row(y))};
  }
  // Returns the words in or beside which a cell gives.
  [[gnu::always_inline]] TileRow beside_giving(int y) const {
    const TileRow giving =
        below_.giving[below_.row(y)] | own_.giving[own_.row(y)] | above_.giving[above_.row(y)];
    return giving | giving << 1 | giving >> 1;
  }

  // Appends the vectors of a word in which a cell may give or take. It returns how many there are then.
  [[gnu::always_inline]] int collect(int w, const Row& row, int count) {
    const std::uint64_t here = givers_[w];
    const std::uint64_t any =
        here | cpu::from_right(here, givers_[w + 1]) | cpu::from_left(here, givers_[w - 1]);
    const Item first =
        item(row.at + 64 * static_cast<std::uint32_t>(w), row.mask + static_cast<std::uint32_t>(w));
    std::size_t next = count;
    for (int part = 0; part < L::kParts; ++part) {
      items_[next] = first + static_cast<Item>(part * L::kCount);
      next += (any & kAll << (part * L::kCount)) != 0;
    }
    return static_cast<int>(next);
  }

  [[gnu::always_inline]] void process(int count) {
    if (count == 0) return;
    for (int i = 0; i < count; ++i) vectors(items_[i]);
    if ((++batches_ & 255) == 0) flush();  // sums hold 32,768 vectors
  }

  struct Sums {
    V amount, energy;
  };
  [[gnu::always_inline]] Sums given_away(std::size_t own_at) const {
    const V pattern = L::widen_bytes(own_.pattern + own_at);
    V out, energy_out;
    if constexpr (kFeatures.general) {
      out = energy_out = L::zero();
      cpu::unrolled<kDirections>([&](auto d) VOXMELT_LAMBDA {
        const M gives = L::has(pattern, 1 << d);
        out = L::add_if(gives, out, flow<d>(own_, own_at));
        energy_out = L::add_if(gives, energy_out, energy_flow<d>(own_, own_at));
      });
    } else {
      const V axes = L::count_four(pattern), diagonals = L::count_four(L::template shift_right<4>(pattern));
      out = L::low(axes, flow<0>(own_, own_at));
      energy_out = L::low(axes, energy_flow<0>(own_, own_at));
      if constexpr (kFeatures.eight) {
        out = out + L::low(diagonals, flow<4>(own_, own_at));
        energy_out = energy_out + L::low(diagonals, energy_flow<4>(own_, own_at));
      }
    }
    return {out, energy_out};
  }

  // Returns what the cells take. `content` gets amount x heat of it, with heats as they are stored.
  [[gnu::always_inline]] Sums taken(Item item, typename L::Wide& content) const {
    V in = L::zero(), energy_in = L::zero();
    V diagonal_in = L::zero(), diagonal_energy = L::zero();  // with kQuarters: four times these
    V taken, heats;
    cpu::unrolled<kDirections>([&](auto d) VOXMELT_LAMBDA {
      // The neighbour there gives in the opposite direction.
      constexpr int opposite = d ^ (d < 4 ? 1 : 3);
      constexpr int dx = d < 4 ? (d == 0) - (d == 1) : (d < 6 ? 1 : -1);
      const Gifts& giver = d < 2 ? own_ : (d % 2 == 0 ? above_ : below_);
      const std::size_t row_at = d < 2 ? own_at_ : (d % 2 == 0 ? above_at_ : below_at_);
      const std::size_t here = row_at + at(item);
      const M takes = L::has(L::template widen_beside<dx>(giver.pattern + here), 1 << opposite);
      if constexpr (kQuarters && d >= 4) {
        const V whole = L::keep(takes, L::set(0xFFFC));
        diagonal_energy = diagonal_energy + (whole & L::template load_beside<dx>(giver.energy[0] + here));
        if constexpr (!kFeatures.hot)
          diagonal_in = diagonal_in + (whole & L::template load_beside<dx>(giver.flow[0] + here));
      } else {
        energy_in = L::add_if(takes, energy_in, energy_flow<opposite, dx>(giver, here));
        if constexpr (!kFeatures.hot) in = L::add_if(takes, in, flow<opposite, dx>(giver, here));
      }
      if constexpr (kFeatures.hot) {
        const V given = L::keep(takes, flow<opposite, dx>(giver, here));
        in = in + given;
        const V heat = L::template load_beside<dx>(giver.heat + here);
        if constexpr (d % 2 == 0) {
          taken = given;
          heats = heat;
        } else {
          content = L::sum(content, L::pair_product(taken, heats, given, heat));
        }
      }
    });
    if constexpr (kQuarters) {
      in = in + L::template shift_right<2>(diagonal_in);
      energy_in = energy_in + L::template shift_right<2>(diagonal_energy);
    }
    return {in, energy_in};
  }

  [[gnu::always_inline]] void vectors(Item item) {
    const std::size_t cell = cell_ + at(item);
    const V amount = L::load(v_.amount + cell), energy = L::load(v_.energy + cell);
    const Sums out = given_away(own_at_ + at(item));
    typename L::Wide content{};
    const Sums in = taken(item, content);

    const V kept = amount - out.amount, now = kept + in.amount;
    L::store(v_.amount + cell, now);
    const V gained = friction(in.energy, item);
    const V uncapped = energy - out.energy + gained, capped = L::min(uncapped, now);
    L::store(v_.energy + cell, capped);
    dissipated_.add(in.energy - gained);
    capped_.add(uncapped - capped);

    const M dry = L::equal(now, L::zero());
    if constexpr (kFeatures.hot) mix(cell, in.amount, kept, now, content, dry);
    set_liquid(item, L::to_bits(dry) ^ kAll);
  }

  // Mixes the heat of cells that kept some of their liquid, and took `in`.
  [[gnu::always_inline]] void mix(std::size_t cell, V in, V kept, V now, const typename L::Wide& content,
                                  M dry) {
    const V heat = L::load(v_.heat + cell);
    const M fed = L::less(L::zero(), in);
    V mixed = heat;
    if (L::to_bits(fed) != 0) {
      // Heats of gifts are stored less 32768, to be signed. So 32768 times the incoming amount is added back.
      const auto biased = L::unpack(L::template shift_left<15>(in), L::template shift_right<1>(in));
      const auto all = L::sum(L::sum(content, biased), L::product(kept, heat));
      mixed = L::select(fed, mix_.mean(all, now, fed), heat);
    }
    L::store(v_.heat + cell, L::select(dry, L::zero(), mixed));
  }

  // Sets the new liquid mask of an item's cells. A cell that is not blocked and holds something is liquid.
  [[gnu::always_inline]] void set_liquid(Item item, std::uint64_t wet) const {
    const std::size_t word = word_ + mask(item);
    const int shift = static_cast<int>(at(item) % 64);
    const std::uint64_t liquid = v_.liquid[word] & ~(kAll << shift);
    v_.liquid[word] = liquid | (wet << shift & ~(v_.solid[word] | v_.inert[word]));
  }

  // Returns the flow to a direction. The lean form has one flow for the axes and one for the diagonals.
  template <int d, int dx = 0>
  [[gnu::always_inline]] static V flow(const Gifts& gifts, std::size_t at) {
    return given<d, dx>(gifts.flow, at);
  }
  template <int d, int dx = 0>
  [[gnu::always_inline]] static V energy_flow(const Gifts& gifts, std::size_t at) {
    return given<d, dx>(gifts.energy, at);
  }
  template <int d, int dx>
  [[gnu::always_inline]] static V given(std::uint16_t* const* planes, std::size_t at) {
    if constexpr (kQuarters && d >= 4)
      return L::template shift_right<2>(L::template load_beside<dx>(planes[0] + at));
    else
      return L::template load_beside<dx>(planes[kFeatures.general ? d : d / 4 * 4] + at);
  }

  // Returns (alpha e + D) >> 16. Under the printed reading the giver has paid already.
  [[gnu::always_inline]] V friction(V e, Item item) const {
    if constexpr (kFeatures.general)
      if (law_.reading == rule::EnergyReading::printed) return e;
    const bool floor = bottom_ && mask(item) < static_cast<std::size_t>(v_.words);
    const V alpha =
        contact_alpha<Arch>(v_, law_, floor, word_ + mask(item), static_cast<int>(at(item) % 64) / L::kCount);
    const V carry = L::keep(L::less(undithered_, L::low(e, alpha)), L::set(1));
    return L::high(e, alpha) + carry;
  }

  [[gnu::always_inline]] void flush() {
    books_.energy.dissipated += dissipated_.total();
    books_.energy.capped += capped_.total();
    dissipated_ = capped_ = {};
    if constexpr (kFeatures.hot) books_.heat.rounded += mix_.flush();
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const rule::PaperLaw& law_;
  const V dither_, undithered_;
  const int z_;
  const Gifts &below_, &own_, &above_;
  std::size_t cell_ = 0, word_ = 0;                       // first cell of the tile row, in the state
  std::size_t below_at_ = 0, own_at_ = 0, above_at_ = 0;  // the same place in the gifts
  bool bottom_ = false;                                   // it is the lowest tile row
  Givers givers_{};
  Books& books_;
  Mix<Arch> mix_;
  // With eight neighbours, a cell gives or takes at most 5 ONE. With four, it is 8 ONE.
  std::conditional_t<kFeatures.eight, typename L::SmallSums, typename L::Sums> dissipated_, capped_;
  int batches_ = 0;
  Item items_[kBatch];
};

}  // namespace voxmelt::simd
