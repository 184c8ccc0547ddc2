// Phase `spread` of the paper's law, second half (Eqs. 11-20): every cell gathers what its neighbours give.
// Row by row of one slice, in place: what a neighbour gives, and its heat, are read from the gifts.
#pragma once

#include "kernel/simd/contact.h"
#include "kernel/simd/features.h"
#include "kernel/simd/mix.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class Apply {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;

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
    TileRow changed = 0;
    int count = 0;
    for (int y = v_.tile_begin(r); y < v_.tile_end(r); ++y) {
      const std::size_t below = below_.row(y), own = own_.row(y), above = above_.row(y);
      const TileRow giving = below_.giving[below] | own_.giving[own] | above_.giving[above];
      const auto givers = [&](int w) VOXMELT_LAMBDA {
        return below_.givers[below_.word(v_, w, below)] | own_.givers[own_.word(v_, w, own)] |
               above_.givers[above_.word(v_, w, above)];
      };
      for (TileRow work = (giving | giving << 1 | giving >> 1) & words; work != 0; work &= work - 1) {
        const int w = __builtin_ctzll(work);
        const std::uint64_t here = givers(w);
        // Whoever may give or take.
        const std::uint64_t any =
            here | cpu::from_right(here, givers(w + 1)) | cpu::from_left(here, givers(w - 1));
        for (int part = 0; part < L::kParts; ++part) {
          const std::size_t lane = static_cast<std::size_t>(64 * w + part * L::kCount);
          items_[count] = {v_.cell(0, y, z_) + lane,
                           below * v_.row + lane,
                           own * v_.row + lane,
                           above * v_.row + lane,
                           y,
                           w,
                           part};
          count += (any >> (part * L::kCount) & kAll) != 0;
        }
        changed |= any != 0 ? TileRow{1} << w : 0;
        if (count + L::kParts <= kBatch) continue;
        process(count);
        count = 0;
      }
    }
    process(count);
    return changed;
  }

 private:
  static constexpr int kBatch = 64;
  struct Item {
    std::size_t cell, below, own, above;  // where it begins in the state, in the gifts of the three slices
    int y, w, part;
  };

  [[gnu::always_inline]] void process(int count) {
    if (count == 0) return;
    for (int i = 0; i < count; ++i) {
      const Item& item = items_[i];
      const int shift = item.part * L::kCount;
      const std::uint64_t wet = vectors(item) << shift;
      std::uint64_t& liquid = v_.liquid[v_.word(item.w, item.y, z_)];
      liquid = ((liquid & ~(kAll << shift)) | wet) & ~v_.blocked(item.w, item.y, z_);
    }
    flush();
  }

  // Returns the lanes that hold something.
  [[gnu::always_inline]] std::uint64_t vectors(const Item& item) {
    const V amount = L::load(v_.amount + item.cell), energy = L::load(v_.energy + item.cell);

    const V pattern = L::widen_bytes(own_.pattern + item.own);
    V out, energy_out;
    if constexpr (kFeatures.general) {
      out = energy_out = L::zero();
      cpu::unrolled<kDirections>([&](auto d) VOXMELT_LAMBDA {
        const M gives = L::has(pattern, 1 << d);
        out = L::add_if(gives, out, flow<d>(own_, item.own));
        energy_out = L::add_if(gives, energy_out, energy_flow<d>(own_, item.own));
      });
    } else {
      const V axes = L::count_four(pattern), diagonals = L::count_four(L::template shift_right<4>(pattern));
      out = L::low(axes, flow<0>(own_, item.own));
      energy_out = L::low(axes, energy_flow<0>(own_, item.own));
      if constexpr (kFeatures.eight) {
        out = out + L::low(diagonals, flow<4>(own_, item.own));
        energy_out = energy_out + L::low(diagonals, energy_flow<4>(own_, item.own));
      }
    }

    V in = L::zero(), energy_in = L::zero();
    typename L::Wide content{};
    V taken, heats;
    cpu::unrolled<kDirections>([&](auto d) VOXMELT_LAMBDA {
      // The neighbour there gives in the opposite direction.
      constexpr int opposite = d ^ (d < 4 ? 1 : 3);
      constexpr std::ptrdiff_t dx = d < 4 ? (d == 0) - (d == 1) : (d < 6 ? 1 : -1);
      const Gifts& giver = d < 2 ? own_ : (d % 2 == 0 ? above_ : below_);
      const std::size_t from =
          (d < 2 ? item.own : (d % 2 == 0 ? item.above : item.below)) + static_cast<std::size_t>(dx);
      const M takes = L::has(L::widen_bytes(giver.pattern + from), 1 << opposite);
      energy_in = L::add_if(takes, energy_in, energy_flow<opposite>(giver, from));
      if constexpr (!kFeatures.hot) {
        in = L::add_if(takes, in, flow<opposite>(giver, from));
      } else {
        const V given = L::keep(takes, flow<opposite>(giver, from));
        in = in + given;
        const V heat = L::load_any(giver.heat + from);
        if constexpr (d % 2 == 0) {
          taken = given;
          heats = heat;
        } else {
          content = L::sum(content, L::pair_product(taken, heats, given, heat));
        }
      }
    });

    const V kept = amount - out, now = kept + in;
    L::store(v_.amount + item.cell, now);
    const V gained = friction(energy_in, item.w, item.y, item.part);
    const V uncapped = energy - energy_out + gained, capped = L::min(uncapped, now);
    L::store(v_.energy + item.cell, capped);
    dissipated_.add(energy_in - gained);
    capped_.add(uncapped - capped);

    const M dry = L::equal(now, L::zero());
    if constexpr (kFeatures.hot) {
      const V heat = L::load(v_.temperature + item.cell);
      const M fed = L::less(L::zero(), in);
      V mixed = heat;
      if (L::to_bits(fed) != 0) {
        // Heats of gifts are 32768 less, to be signed: put back 32768 times what came in.
        const auto biased = L::unpack(L::template shift_left<15>(in), L::template shift_right<1>(in));
        const auto all = L::sum(L::sum(content, biased), L::product(kept, heat));
        mixed = L::select(fed, mix_.mean(all, now, fed), heat);
      }
      L::store(v_.temperature + item.cell, L::select(dry, L::zero(), mixed));
    }
    return L::to_bits(dry) ^ kAll;
  }

  // Lean: one flow for the axes and one for the diagonals.
  template <int d>
  [[gnu::always_inline]] static V flow(const Gifts& gifts, std::size_t at) {
    return L::load_any(gifts.flow[kFeatures.general ? d : d / 4 * 4] + at);
  }
  template <int d>
  [[gnu::always_inline]] static V energy_flow(const Gifts& gifts, std::size_t at) {
    return L::load_any(gifts.energy[kFeatures.general ? d : d / 4 * 4] + at);
  }

  // (alpha e + D) >> 16; the printed reading has paid at the giver's.
  [[gnu::always_inline]] V friction(V e, int w, int y, int part) const {
    if constexpr (kFeatures.general)
      if (law_.reading == rule::EnergyReading::printed) return e;
    const V alpha = contact_alpha<Arch>(v_, law_, w, y, z_, part);
    const V carry = L::keep(L::less(undithered_, L::low(e, alpha)), L::set(1));
    return L::high(e, alpha) + carry;
  }

  [[gnu::always_inline]] void flush() {
    books_.dissipated += static_cast<std::int64_t>(dissipated_.total());
    books_.capped += static_cast<std::int64_t>(capped_.total());
    dissipated_ = capped_ = {};
    if constexpr (kFeatures.hot) books_.rounded += mix_.flush();
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const rule::PaperLaw& law_;
  const V dither_, undithered_;
  const int z_;
  const Gifts &below_, &own_, &above_;
  Books& books_;
  Mix<Arch> mix_;
  typename L::Sums dissipated_, capped_;
  Item items_[kBatch + L::kParts];
};

}  // namespace voxmelt::simd
