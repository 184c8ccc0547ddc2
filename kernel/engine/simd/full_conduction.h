// Conduction through faces (see conduction.h) is faster for a tile row that is matter throughout, with matter
// above and in front of it. It needs no masks, and takes several rows at once. It is apart from the rest, so
// that each has enough registers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/flux.h"
#include "kernel/engine/simd/heat_books.h"

namespace voxmelt::simd {

template <class Arch, bool kLatent>
class FullConduction {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] FullConduction(const View& view, const Step& step, int z, const OldHeat& old,
                                        const HeatFlux& flux)
      : v_(view),
        heat_(view.heat + view.cell(0, 0, z)),
        amount_(view.amount + view.cell(0, 0, z)),
        above_(old.above),
        up_(flux.up),
        front_(flux.front),
        z_(z),
        rules_{Plateau<Arch, kLatent>(step.parameters->material), along(step, 0), along(step, 1),
               along(step, 2)},
        books_(6 * step.parameters->heat.weight_face) {}

  // Returns how many rows from y on have only cells of pairs in the words of `work`, which are side by side.
  // The last cell of the last word along x may be an exception.
  [[gnu::always_inline]] int rows(int y, int end, TileRow work) const {
    const TileRow first = work & -work;
    if ((work & (work + first)) != 0 || z_ + 1 == v_.nz) return 0;
    if (matter(v_, __builtin_ctzll(work), y, z_) != ~std::uint64_t{0}) return 0;
    const int most = std::min({end - y, v_.ny - 1 - y, kMostRows}), words = v_.words;
    const std::size_t begin = v_.word(0, y, z_), plane = v_.word(0, 0, 1);
    // Most often the words are a whole tile row, whose masks are contiguous in memory.
    if (__builtin_popcountll(work) == words && all_matter(begin, (most + 1) * words) &&
        all_matter(begin + plane, most * words))
      return most;
    const std::size_t w = __builtin_ctzll(work);
    const int run = __builtin_popcountll(work);
    int rows = 0;
    for (std::size_t at = begin + w; rows < most; ++rows, at += words)
      if (!all_matter(at, run) || !all_matter(at + words, run) || !all_matter(at + plane, run)) break;
    return rows;
  }

  struct Sums {
    TileRow changed;  // words that changed
    V hottest;        // the hottest cells, lane by lane
  };

  // Conducts in these rows. It needs the flux along y into row y, and along z into all rows. It goes word by
  // word, so that the fluxes along y stay in registers. before[k] is the flux along x into row y + k, and
  // then out of it.
  [[gnu::noinline]] Sums run(int y, int rows, TileRow words) {
    int w = __builtin_ctzll(words);
    V before[kMostRows];
    for (int k = 0; k < rows; ++k) before[k] = w > 0 ? from_left(w, y + k) : L::zero();
    const Rules rules = rules_;
    const int last = 63 - __builtin_clzll(words);
    std::uint64_t ends[kMostRows];  // cells of the last word that have a pair along x
    for (int k = 0; k < rows; ++k)
      ends[k] = cpu::from_right(~std::uint64_t{0}, last + 1 < v_.words ? matter(v_, last + 1, y + k, z_) : 0);
    Sums sums{0, L::zero()};
    for (; w < last; ++w) full_word<false>(rules, y, rows, w, ends, before, sums);
    full_word<true>(rules, y, rows, w, ends, before, sums);
    for (int k = 0; k < rows; ++k) books_.end_row();
    return sums;
  }

  [[gnu::always_inline]] std::int64_t total() { return books_.total(); }

 private:
  struct Rules {
    Plateau<Arch, kLatent> plateau;
    Flux<Arch> along_x, along_y, along_z;
  };

  [[gnu::always_inline]] static Flux<Arch> along(const Step& step, int axis) {
    return {step.parameters->heat.weight_face, part_dither(step, axis, 3)};
  }

  // Tells if so many words, from a given one on, are all matter.
  [[gnu::always_inline]] bool all_matter(std::size_t word, int words) const {
    const std::uint64_t *solid = v_.solid + word, *liquid = v_.liquid + word;
    constexpr int kAtOnce = 64 / L::kParts / 4;  // words of a vector
    std::uint64_t all = ~std::uint64_t{0};
    if (words < kAtOnce) {
      for (int i = 0; i < words; ++i) all &= solid[i] | liquid[i];
      return all == ~std::uint64_t{0};
    }
    const auto matter_at = [&](int i) VOXMELT_LAMBDA {
      return L::load_any(reinterpret_cast<const std::uint16_t*>(solid + i)) |
             L::load_any(reinterpret_cast<const std::uint16_t*>(liquid + i));
    };
    V every = matter_at(words - kAtOnce);
    for (int i = 0; i + kAtOnce < words; i += kAtOnce) every = every & matter_at(i);
    return !L::nonzero(every ^ L::set(0xFFFF));
  }

  // Returns the flux along x into word w.
  [[gnu::always_inline]] V from_left(int w, int y) const {
    const std::uint64_t pair = matter(v_, w, y, z_) & matter(v_, w - 1, y, z_) >> 63;
    const std::uint16_t* last = heat_ + v_.cell(w, y, 0) - L::kCount;
    return rules_.along_x.between(rules_.plateau(L::load_any(last)), rules_.plateau(L::load_any(last + 1)),
                                  L::from_bits(pair << (L::kCount - 1), 0));
  }

  // Conducts in one word of all rows. With kLast, ends[k] tells which cells of row y + k belong to a pair
  // along x. Otherwise all do.
  template <bool kLast>
  [[gnu::always_inline]] void full_word(const Rules& rules, int y, int rows, int w, const std::uint64_t* ends,
                                        V* before_rows, Sums& sums) {
    const std::size_t begin = v_.cell(w, y, 0), stride = v_.row;
    std::uint16_t *here = heat_ + begin, *front_flux = front_ + begin;
    const std::uint16_t *front = above_ + begin, *amount = amount_ + begin;
    const std::size_t ahead = rows * stride;
    V any = L::zero(), other = L::zero(), hottest = L::zero();
    V own[L::kParts], up_flux[L::kParts], gains[kMostRows][L::kParts];
    for (int part = 0; part < L::kParts; ++part) {
      own[part] = L::load(here + part * L::kCount);
      up_flux[part] = L::load(up_ + 64 * w + part * L::kCount);
    }
    for (int k = 0; k < rows; ++k) {
      V before = before_rows[k];
      __builtin_prefetch(front + ahead);
      __builtin_prefetch(front + ahead + 32);
      __builtin_prefetch(amount + ahead);
      __builtin_prefetch(amount + ahead + 32);
      cpu::unrolled<L::kParts>([&](auto part) VOXMELT_LAMBDA {
        constexpr int at = part * L::kCount;
        other = other | books_.beside_full(L::load(amount + at));
        const V old = own[part], heat = rules.plateau(old);
        own[part] = L::load(here + stride + at);
        V x_flux = rules.along_x.between(heat, rules.plateau(L::load_any(here + at + 1)));
        if constexpr (kLast && part + 1 == L::kParts) x_flux = L::keep(L::from_bits(ends[k], part), x_flux);
        const V y_flux = rules.along_y.between(heat, rules.plateau(own[part]));
        const V z_flux = rules.along_z.between(heat, rules.plateau(L::load(front + at)));
        const V gain = (x_flux - L::after(before, x_flux)) + (y_flux - up_flux[part]) +
                       (z_flux - L::load(front_flux + at));
        before = x_flux;
        up_flux[part] = y_flux;
        L::store(front_flux + at, z_flux);
        const V now = old + gain;
        L::store(here + at, now);
        gains[k][part] = gain;
        any = any | gain;
        hottest = L::max(hottest, now);
      });
      before_rows[k] = before;
      here += stride;
      front += stride;
      front_flux += stride;
      amount += stride;
    }
    for (int part = 0; part < L::kParts; ++part) L::store(up_ + 64 * w + part * L::kCount, up_flux[part]);
    sums.hottest = L::max(sums.hottest, hottest);
    if (L::nonzero(any)) sums.changed |= TileRow{1} << w;
    if (!L::nonzero(other)) return;
    for (int k = 0; k < rows; ++k)
      books_.add(amount_ + v_.cell(w, y + k, 0), heat_ + v_.cell(w, y + k, 0), gains[k]);
  }

  static constexpr int kMostRows = 8;
  const View& v_;
  std::uint16_t* const heat_;  // heats of this slice
  const std::uint16_t *const amount_, *const above_;
  std::uint16_t *const up_, *const front_;
  const int z_;
  const Rules rules_;
  PairBooks<Arch> books_;
};

}  // namespace voxmelt::simd
