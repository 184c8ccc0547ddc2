// Phase `heat` conducts to neighbours over edges or corners here (Eq. 1 with 18 or 26 neighbours), one slice
// at a time. Every cell gathers from both sides of each axis. It reads heats from slices of before the pass.
// Words that are surrounded by matter need no masks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/flux.h"
#include "kernel/engine/simd/heat_books.h"

namespace voxmelt::simd {

struct Axis {
  int dx, dy, dz;
};
// These are templates, so that each instruction set has its own copy.
template <class Arch>
struct EdgeAxes {
  static constexpr int kCount = 6;
  static constexpr Axis kAxes[kCount]{{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};
  [[gnu::always_inline]] static int weight(const rule::Heat& heat) { return heat.weight_edge; }
};
template <class Arch>
struct CornerAxes {
  static constexpr int kCount = 4;
  static constexpr Axis kAxes[kCount]{{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
  [[gnu::always_inline]] static int weight(const rule::Heat& heat) { return heat.weight_corner; }
};

template <class Arch, bool kLatent, class Axes>
class DistantConduction {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] DistantConduction(const View& view, const Step& step, int z, const OldHeat& old)
      : v_(view),
        slices_{old.below, old.own, old.above},
        weight_(Axes::weight(step.parameters->heat)),
        z_(z),
        plateau_(step.parameters->material),
        melting_(step.parameters->material),
        books_(2 * Axes::kCount * weight_) {
    for (int k = 0; k < Axes::kCount; ++k)
      fluxes_[k] = Flux<Arch>(weight_, part_dither(step, k, Axes::kCount));
  }

  [[gnu::always_inline]] std::int64_t run(const TileRow* tiles, const HeatTiles& tell) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      const TileRow inner = amid_matter(r, tiles[r]);
      for (int y = v_.tile_begin(r); y < v_.tile_end(r); ++y) {
        const TileRow full = y > 0 && y + 1 < v_.ny ? inner : 0;
        for (TileRow work = tiles[r]; work != 0; work &= work - 1) {
          const int w = __builtin_ctzll(work);
          const TileRow bit = work & -work;
          const std::uint64_t own = matter(v_, w, y, z_);
          if (own == 0) continue;
          const Sum sum = (full & bit) != 0 ? full_word(w, y) : word(w, y, own);
          if (L::nonzero(sum.any)) {
            tell.changed[r] |= bit;
            if (melting_.reached(sum.hottest)) tell.hot[r] |= bit;
          } else if ((tell.restless[r] & bit) == 0 && differs(w, y, own)) {
            tell.restless[r] |= bit;
          }
        }
        books_.end_row();
      }
    }
    return books_.total();
  }

 private:
  struct Neighbour {
    const std::uint16_t* heat;
    std::uint64_t pairs;
  };
  struct Sum {
    V any, hottest;  // any: not 0 where heat changed
  };

  // Returns those of the words whose cells are matter, as are all cells around them in the rows and slices
  // beside tile row r. Only along x may a neighbour be beyond the grid.
  [[gnu::always_inline]] TileRow amid_matter(int r, TileRow words) const {
    if (z_ == 0 || z_ + 1 == v_.nz) return 0;
    const int begin = v_.tile_begin(r) > 0 ? v_.tile_begin(r) - 1 : 0,
              end = v_.tile_end(r) < v_.ny ? v_.tile_end(r) + 1 : v_.ny;
    TileRow all = 0;
    const TileRow in_grid = v_.words == 64 ? ~TileRow{0} : (TileRow{1} << v_.words) - 1;
    for (TileRow asked = (words | words << 1 | words >> 1) & in_grid; asked != 0; asked &= asked - 1) {
      const int w = __builtin_ctzll(asked);
      std::uint64_t every = ~std::uint64_t{0};
      for (int z = z_ - 1; z <= z_ + 1; ++z)
        for (int y = begin; y < end; ++y) every &= matter(v_, w, y, z);
      all |= TileRow{every == ~std::uint64_t{0}} << w;
    }
    return words & all & (all << 1 | 1) & (all >> 1 | TileRow{1} << (v_.words - 1));
  }

  // Finds the cells of the word that are matter and have matter at this offset, with the heats there.
  [[gnu::always_inline]] Neighbour neighbour(int w, int y, std::uint64_t own, int dx, int dy, int dz) const {
    std::uint64_t there = matter(v_, w, y + dy, z_ + dz);
    if (dx > 0) there = cpu::from_right(there, matter(v_, w + 1, y + dy, z_ + dz));
    if (dx < 0) there = cpu::from_left(there, matter(v_, w - 1, y + dy, z_ + dz));
    const std::uint16_t* slice = slices_[1 + dz] != nullptr ? slices_[1 + dz] : slices_[1];
    const int row = y + dy >= 0 && y + dy < v_.ny ? y + dy : y;
    return {slice + v_.cell(w, row, 0) + dx, own & there};
  }

  // Adds the fluxes of a word. If there is no pair, the neighbour counts as being as warm as the cell. So
  // nothing flows.
  [[gnu::always_inline]] Sum word(int w, int y, std::uint64_t own) {
    Neighbour to[Axes::kCount], from[Axes::kCount];
    find_neighbours(w, y, own, to, from);
    return add_up(w, y, own, [&](int part, V heat) VOXMELT_LAMBDA {
      typename Flux<Arch>::Total out, in;
      for (int k = 0; k < Axes::kCount; ++k) {
        fluxes_[k].add(out, heat, of_pairs(to[k], part, heat));
        fluxes_[k].add(in, of_pairs(from[k], part, heat), heat);
      }
      return fluxes_[0].value(out) - fluxes_[0].value(in);
    });
  }
  [[gnu::always_inline]] V of_pairs(const Neighbour& neighbour, int part, V heat) const {
    const V there = plateau_(L::load_any(neighbour.heat + part * L::kCount));
    return L::select(L::from_bits(neighbour.pairs, part), there, heat);
  }

  // Adds the fluxes of a word amid matter. Every neighbour exists, except those beyond the grid along x.
  [[gnu::always_inline]] Sum full_word(int w, int y) {
    const std::uint16_t* slices[3];
    for (int i = 0; i < 3; ++i) slices[i] = slices_[i] + v_.cell(w, y, 0);
    const bool first = w == 0, last = w + 1 == v_.words;
    return add_up(w, y, ~std::uint64_t{0}, [&](int part, V heat) VOXMELT_LAMBDA {
      // These lanes have a previous, or a next, cell along x within the grid.
      const std::uint64_t previous = first && part == 0 ? kAll - 1 : kAll,
                          next = last && part + 1 == L::kParts ? kAll >> 1 : kAll;
      const auto at = static_cast<std::size_t>(part * L::kCount);
      const std::uint16_t* here[3] = {slices[0] + at, slices[1] + at, slices[2] + at};
      return (previous & next) == kAll ? vector<false>(here, heat, previous, next)
                                       : vector<true>(here, heat, previous, next);
    });
  }
  template <bool kBorder>
  [[gnu::always_inline]] V vector(const std::uint16_t* const* here, V heat, std::uint64_t previous,
                                  std::uint64_t next) const {
    typename Flux<Arch>::Total out, in;
    cpu::unrolled<Axes::kCount>([&](auto k) VOXMELT_LAMBDA {
      constexpr Axis a = Axes::kAxes[k];
      const std::ptrdiff_t away = a.dy * static_cast<std::ptrdiff_t>(v_.row) + a.dx;
      V after = plateau_(L::load_any(here[1 + a.dz] + away)),
        before = plateau_(L::load_any(here[1 - a.dz] - away));
      if constexpr (kBorder && a.dx != 0) {
        after = L::select(L::from_bits(next, 0), after, heat);
        before = L::select(L::from_bits(previous, 0), before, heat);
      }
      fluxes_[k].add(out, heat, after);
      fluxes_[k].add(in, before, heat);
    });
    return fluxes_[0].value(out) - fluxes_[0].value(in);
  }

  // Changes the heats of a word. The cells of a vector gain gain(part, temperatures).
  template <class Gain>
  [[gnu::always_inline]] Sum add_up(int w, int y, std::uint64_t own, const Gain& gain) {
    const std::size_t cell = v_.cell(w, y, z_);
    const std::uint16_t* before = slices_[1] + v_.cell(w, y, 0);
    Sum sum{L::zero(), L::zero()};
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(own, part)) continue;
      const std::size_t at = part * L::kCount;
      const V old = L::load(before + at);
      const V gained = gain(part, plateau_(old)), now = old + gained;
      L::store(v_.heat + cell + at, now);
      books_.add(L::load(v_.amount + cell + at), now, gained);
      sum.any = sum.any | gained;
      sum.hottest = L::max(sum.hottest, now);
    }
    return sum;
  }

  // Tells if any pair of this word had two temperatures.
  [[gnu::always_inline]] bool differs(int w, int y, std::uint64_t own) const {
    Neighbour to[Axes::kCount], from[Axes::kCount];
    find_neighbours(w, y, own, to, from);
    V differ = L::zero();
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(own, part)) continue;
      const std::size_t at = part * L::kCount;
      const V heat = plateau_(L::load(slices_[1] + v_.cell(w, y, 0) + at));
      for (int k = 0; k < Axes::kCount; ++k)
        for (const Neighbour* one : {&to[k], &from[k]})
          differ =
              differ | L::keep(L::from_bits(one->pairs, part), heat ^ plateau_(L::load_any(one->heat + at)));
    }
    return L::nonzero(differ);
  }

  [[gnu::always_inline]] void find_neighbours(int w, int y, std::uint64_t own, Neighbour* to,
                                              Neighbour* from) const {
    for (int k = 0; k < Axes::kCount; ++k) {
      const Axis a = Axes::kAxes[k];
      to[k] = neighbour(w, y, own, a.dx, a.dy, a.dz);
      from[k] = neighbour(w, y, own, -a.dx, -a.dy, -a.dz);
    }
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const std::uint16_t* const slices_[3];
  const int weight_;
  const int z_;
  const Plateau<Arch, kLatent> plateau_;
  const MeltingHeat<Arch> melting_;
  Flux<Arch> fluxes_[Axes::kCount];
  PairBooks<Arch> books_;
};

}  // namespace voxmelt::simd
