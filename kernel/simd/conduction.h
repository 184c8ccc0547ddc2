// Phase `heat`: conduction through faces (Eq. 1), one slice in place. The flux through a face is computed
// once: a cell computes those to x + 1, y + 1 and z + 1 and takes the others from the lane, the row and the
// slice before it. So no old heats need be kept: what a cell still has to read has not been written yet.
#pragma once

#include "kernel/simd/flux.h"
#include "kernel/simd/heat_books.h"

namespace voxmelt::simd {

template <class Arch, bool kLatent>
class FaceConduction {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] FaceConduction(const View& view, const Step& step, int z, const OldHeat& old,
                                        const HeatFlux& flux)
      : v_(view),
        heat_(view.temperature + view.cell(0, 0, z)),
        amount_(view.amount + view.cell(0, 0, z)),
        below_(old.below),
        above_(old.above),
        up_(flux.up),
        front_(flux.front),
        z_(z),
        rules_{Plateau<Arch, kLatent>(step.parameters->material), along(step, 0), along(step, 1),
               along(step, 2)},
        melting_(step.parameters->material),
        books_(6 * step.parameters->heat.weight_face) {}

  [[gnu::always_inline]] std::int64_t run(const TileRow* carried, const TileRow* tiles,
                                          const HeatTiles& found) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      TileRow from_below = r > 0 ? tiles[r - 1] : 0;
      const TileRow from_back = carried != nullptr ? carried[r] : 0;
      Found tile{0, found.restless[r], found.hot[r]};
      for (int y = v_.tile_begin(r); y < v_.tile_end(r);) {
        const int rows = full_rows(y, v_.tile_end(r), tiles[r]);
        if (rows > 0)
          block(y, rows, tiles[r], from_below, from_back, tile);
        else
          row(y, tiles[r], from_below, from_back, tile);
        from_below = tiles[r];
        y += std::max(1, rows);
        books_.end_row();
      }
      found.changed[r] |= tile.changed;
      found.restless[r] = tile.restless;
      found.hot[r] = tile.hot;
    }
    return books_.total();
  }

 private:
  struct Found {
    TileRow changed, restless, hot;
  };
  struct Row {  // what lies at the first cell of a row, and beyond its faces; where there is nothing, itself
    std::uint16_t *here, *up_flux, *front_flux;
    const std::uint16_t *up, *front, *amount;
    MatterRow own, above, before;
  };
  struct Sums {
    TileRow changed;  // words
    V hottest;        // their hottest cells
  };
  struct Rules {  // copies: what may be anywhere in memory would be read again after every store
    Plateau<Arch, kLatent> plateau;
    Flux<Arch> along_x, along_y, along_z;
  };

  [[gnu::always_inline]] static Flux<Arch> along(const Step& step, int axis) {
    return {step.parameters->heat.weight_face, part_dither(step, axis, 3)};
  }

  [[gnu::always_inline]] Row row_at(int y) const {
    const std::size_t begin = v_.cell(0, y, 0);
    std::uint16_t* here = heat_ + begin;
    return {here,
            up_,
            front_ + begin,
            y + 1 < v_.ny ? here + v_.row : here,
            above_ != nullptr ? above_ + begin : here,
            amount_ + begin,
            MatterRow(v_, y, z_),
            MatterRow(v_, y + 1, z_),
            MatterRow(v_, y, z_ + 1)};
  }

  // from_below, from_back: words whose flux is carried.
  [[gnu::always_inline]] void row(int y, TileRow work, TileRow from_below, TileRow from_back, Found& found) {
    const Row row = row_at(y);
    V before = L::zero();  // flux along x through the faces of the vector before
    for (TileRow left = work; left != 0;) {
      const int w = __builtin_ctzll(left);
      const TileRow bit = left & -left;
      const TileRow full = full_words(row, left, bit);
      const TileRow now = full != 0 ? full : bit;
      left &= ~now;
      if (row.own[w] == 0) {
        before = L::zero();
        nothing(row, w);
        continue;
      }
      if ((now & ~from_below) != 0) enter_y(now & ~from_below, y);
      if ((now & ~from_back) != 0) enter_z(now & ~from_back, y);
      if ((work & bit >> 1) == 0) before = entering_x(w, y);
      const Sums sums = full != 0 ? full_run(y, 1, w, full, &before) : partial_word(row, w, before);
      note(y, 1, now, sums, found);
    }
  }

  // The words from the first of `left` on, side by side, in which all cells are of pairs along y and z, and,
  // but for the last one's last cell, along x.
  [[gnu::always_inline]] static TileRow full_words(const Row& row, TileRow left, TileRow first) {
    TileRow full = 0;
    for (TileRow bit = first; (left & bit) != 0; bit <<= 1) {
      const int w = __builtin_ctzll(bit);
      if ((row.own[w] & row.above[w] & row.before[w]) != ~std::uint64_t{0}) break;
      full |= bit;
    }
    return full;
  }

  // Rows from y on whose words of `work`, all side by side, are full in that sense.
  [[gnu::always_inline]] int full_rows(int y, int end, TileRow work) const {
    const TileRow first = work & -work;
    if ((work & (work + first)) != 0 || z_ + 1 == v_.nz) return 0;
    const int most = std::min({end - y, v_.ny - 1 - y, kMostRows}), words = v_.words;
    const std::size_t begin = v_.word(0, y, z_), plane = v_.word(0, 0, 1);
    // Most often all of a tile row, whose masks are one piece of memory.
    if (__builtin_popcountll(work) == words && all_matter(begin, (most + 1) * words) &&
        all_matter(begin + plane, most * words))
      return most;
    const std::size_t w = static_cast<std::size_t>(__builtin_ctzll(work));
    const int run = __builtin_popcountll(work);
    int rows = 0;
    for (std::size_t at = begin + w; rows < most; ++rows, at += static_cast<std::size_t>(words))
      if (!all_matter(at, run) || !all_matter(at + static_cast<std::size_t>(words), run) ||
          !all_matter(at + plane, run))
        break;
    return rows;
  }
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

  [[gnu::always_inline]] void block(int y, int rows, TileRow work, TileRow from_below, TileRow from_back,
                                    Found& found) {
    const int w = __builtin_ctzll(work);
    if ((work & ~from_below) != 0) enter_y(work & ~from_below, y);
    for (int k = 0; (work & ~from_back) != 0 && k < rows; ++k) enter_z(work & ~from_back, y + k);
    V before[kMostRows];
    for (int k = 0; k < rows; ++k) before[k] = entering_x(w, y + k);
    note(y, rows, work, full_run(y, rows, w, work, before), found);
  }

  // Sums of words `now` of some rows.
  [[gnu::always_inline]] void note(int y, int rows, TileRow now, const Sums& sums, Found& found) const {
    found.changed |= sums.changed;
    if (sums.changed != 0 && melting_.reached(sums.hottest)) found.hot |= sums.changed;
    for (TileRow still = now & ~sums.changed & ~found.restless; still != 0; still &= still - 1)
      for (int k = 0; k < rows; ++k)
        if (differs(__builtin_ctzll(still), y + k)) found.restless |= still & -still;
  }

  // Flux into a word from what this sweep did not visit: computed, not carried. Out of line, as all that is
  // rare here: the registers are for the lanes.
  [[gnu::always_inline]] V entering_x(int w, int y) const { return w > 0 ? from_left(w, y) : L::zero(); }
  [[gnu::noinline]] V from_left(int w, int y) const {
    const std::uint64_t pair = matter(v_, w, y, z_) & matter(v_, w - 1, y, z_) >> 63;
    const std::uint16_t* last = heat_ + v_.cell(w, y, 0) - L::kCount;
    return rules_.along_x.between(rules_.plateau(L::load_any(last)), rules_.plateau(L::load_any(last + 1)),
                                  L::from_bits(pair << (L::kCount - 1), 0));
  }
  [[gnu::noinline]] void enter_y(TileRow words, int y) const {
    for (; words != 0; words &= words - 1) {
      const int w = __builtin_ctzll(words);
      const std::uint16_t* to = heat_ + v_.cell(w, y, 0);
      enter(up_ + 64 * static_cast<std::size_t>(w), y > 0 ? to - v_.row : to, to,
            matter(v_, w, y, z_) & matter(v_, w, y - 1, z_), rules_.along_y);
    }
  }
  [[gnu::noinline]] void enter_z(TileRow words, int y) const {
    for (; words != 0; words &= words - 1) {
      const int w = __builtin_ctzll(words);
      const std::size_t at = v_.cell(w, y, 0);
      const std::uint16_t* to = heat_ + at;
      enter(front_ + at, below_ != nullptr ? below_ + at : to, to,
            matter(v_, w, y, z_) & matter(v_, w, y, z_ - 1), rules_.along_z);
    }
  }
  [[gnu::always_inline]] void enter(std::uint16_t* flux, const std::uint16_t* from, const std::uint16_t* to,
                                    std::uint64_t pairs, const Flux<Arch>& rule) const {
    for (int part = 0; part < L::kParts; ++part) {
      const int at = part * L::kCount;
      L::store(flux + at, rule.between(rules_.plateau(L::load(from + at)), rules_.plateau(L::load(to + at)),
                                       L::from_bits(pairs, part)));
    }
  }

  // No matter: nothing flows on.
  [[gnu::always_inline]] static void nothing(const Row& row, int w) {
    for (int at = 64 * w; at < 64 * w + 64; at += L::kCount) {
      L::store(row.up_flux + at, L::zero());
      L::store(row.front_flux + at, L::zero());
    }
  }

  // Words from w on, of rows from y on, whose cells are all of pairs: no mask is needed but for the last
  // cell's pair along x. Word by word, that the fluxes along y stay in registers; before[k]: flux along x
  // into row y + k, then out of it.
  [[gnu::noinline]] Sums full_run(int y, int rows, int w, TileRow run, V* before) {
    const Rules rules = rules_;
    const int last = 63 - __builtin_clzll(run);
    std::uint64_t ends[kMostRows];  // cells of the last word that are of a pair along x
    for (int k = 0; k < rows; ++k)
      ends[k] = cpu::from_right(~std::uint64_t{0}, last + 1 < v_.words ? matter(v_, last + 1, y + k, z_) : 0);
    Sums sums{0, L::zero()};
    for (; w < last; ++w) full_word<false>(rules, y, rows, w, ends, before, sums);
    full_word<true>(rules, y, rows, w, ends, before, sums);
    return sums;
  }

  // kLast: ends[k] says which cells of row y + k are of a pair along x, else all are.
  template <bool kLast>
  [[gnu::always_inline]] void full_word(const Rules& rules, int y, int rows, int w, const std::uint64_t* ends,
                                        V* before_rows, Sums& sums) {
    const std::size_t begin = v_.cell(w, y, 0), stride = v_.row;
    std::uint16_t *here = heat_ + begin, *front_flux = front_ + begin;
    const std::uint16_t *front = above_ + begin, *amount = amount_ + begin;
    const std::size_t ahead = static_cast<std::size_t>(rows) * stride;
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
        V x = rules.along_x.between(heat, rules.plateau(L::load_any(here + at + 1)));
        if constexpr (kLast && part + 1 == L::kParts) x = L::keep(L::from_bits(ends[k], part), x);
        const V y_flux = rules.along_y.between(heat, rules.plateau(own[part]));
        const V z_flux = rules.along_z.between(heat, rules.plateau(L::load(front + at)));
        const V gain =
            (x - L::after(before, x)) + (y_flux - up_flux[part]) + (z_flux - L::load(front_flux + at));
        before = x;
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

  // Word w, of whose cells some are of pairs.
  [[gnu::noinline]] Sums partial_word(const Row& row, int w, V& flux_before) {
    const Rules rules = rules_;
    const std::uint64_t own = row.own[w];
    const std::uint64_t right = own & cpu::from_right(own, w + 1 < v_.words ? row.own[w + 1] : 0),
                        up = own & row.above[w], front = own & row.before[w];
    V before = flux_before, any = L::zero(), hottest = L::zero(), gains[L::kParts];
    cpu::unrolled<L::kParts>([&](auto part) VOXMELT_LAMBDA {
      const int at = 64 * w + part * L::kCount;
      if ((own >> (part * L::kCount) & kAll) == 0) {
        gains[part] = before = L::zero();
        L::store(row.up_flux + at, before);
        L::store(row.front_flux + at, before);
        return;
      }
      const V old = L::load(row.here + at), here = rules.plateau(old);
      const V x = rules.along_x.between(here, rules.plateau(L::load_any(row.here + at + 1)),
                                        L::from_bits(right, part));
      const V y = rules.along_y.between(here, rules.plateau(L::load(row.up + at)), L::from_bits(up, part));
      const V z =
          rules.along_z.between(here, rules.plateau(L::load(row.front + at)), L::from_bits(front, part));
      gains[part] = exchange(row, at, old, x, y, z, before);
      any = any | gains[part];
      hottest = L::max(hottest, old + gains[part]);
    });
    books_.add(row.amount + 64 * w, row.here + 64 * w, gains);
    flux_before = before;
    return {L::nonzero(any) ? TileRow{1} << w : 0, hottest};
  }

  // One vector gains what flows in and out; x, y, z: out of it, or in if negative. Returns the gain.
  [[gnu::always_inline]] static V exchange(const Row& row, int at, V old, V x, V y, V z, V& before) {
    const V gain =
        (x - L::after(before, x)) + (y - L::load(row.up_flux + at)) + (z - L::load(row.front_flux + at));
    before = x;
    L::store(row.up_flux + at, y);
    L::store(row.front_flux + at, z);
    L::store(row.here + at, old + gain);
    return gain;
  }

  // Whether any pair of this word is of two temperatures. Neighbours may have changed in this pass: then they
  // are told to have, and wake this tile in any case.
  [[gnu::noinline]] bool differs(int w, int y) const {
    const std::uint64_t own = matter(v_, w, y, z_);
    const std::size_t in_slice = v_.cell(w, y, 0), row = v_.row;
    const std::uint16_t* here = heat_ + in_slice;
    const std::uint64_t front = own & matter(v_, w, y, z_ + 1), back = own & matter(v_, w, y, z_ - 1);
    const bool first = y == 0, last = y + 1 == v_.ny;
    return differ(here, here + 1, own & cpu::from_right(own, matter(v_, w + 1, y, z_))) ||
           differ(here, here - 1, own & cpu::from_left(own, matter(v_, w - 1, y, z_))) ||
           differ(here, last ? here : here + row, own & matter(v_, w, y + 1, z_)) ||
           differ(here, first ? here : here - row, own & matter(v_, w, y - 1, z_)) ||
           differ(here, above_ != nullptr ? above_ + in_slice : here, front) ||
           differ(here, below_ != nullptr ? below_ + in_slice : here, back);
  }
  [[gnu::always_inline]] bool differ(const std::uint16_t* here, const std::uint16_t* there,
                                     std::uint64_t pairs) const {
    std::uint64_t same = 0;
    for (int part = 0; part < L::kParts; ++part) {
      const int at = part * L::kCount;
      same |=
          L::to_bits(L::equal(rules_.plateau(L::load(here + at)), rules_.plateau(L::load_any(there + at))))
          << at;
    }
    return (pairs & ~same) != 0;
  }

  static constexpr int kMostRows = 8;  // of a block
  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  std::uint16_t* const heat_;  // of this slice
  const std::uint16_t* const amount_;
  const std::uint16_t *const below_, *const above_;
  std::uint16_t *const up_, *const front_;
  const int z_;
  const Rules rules_;
  const MeltingHeat<Arch> melting_;
  PairBooks<Arch> books_;
};

}  // namespace voxmelt::simd
