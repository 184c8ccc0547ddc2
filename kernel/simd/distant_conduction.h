// Phase `heat`: conduction to neighbours over edges or corners (Eq. 1 with 18 or 26 neighbours), one slice.
// Every cell gathers from both sides of each axis; the heats are read from slices of before the pass.
#pragma once

#include "kernel/simd/flux.h"
#include "kernel/simd/heat_books.h"

namespace voxmelt::simd {

struct Axis {
  int dx, dy, dz;
};
// Templates, that each instruction set has its own copy.
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
        step_(step),
        weight_(Axes::weight(step.parameters->heat)),
        z_(z),
        plateau_(step.parameters->material),
        melting_(step.parameters->material),
        books_(2 * Axes::kCount * weight_) {}

  [[gnu::always_inline]] std::int64_t run(const TileRow* tiles, const HeatTiles& tell) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      for (int y = v_.tile_begin(r); y < v_.tile_end(r); ++y) {
        for (TileRow work = tiles[r]; work != 0; work &= work - 1) {
          const int w = __builtin_ctzll(work);
          const std::uint64_t own = matter(v_, w, y, z_);
          if (own == 0) continue;
          const Found found = word(w, y, own);
          if (found.changed) tell.changed[r] |= work & -work;
          if (found.restless) tell.restless[r] |= work & -work;
          if (found.hot) tell.hot[r] |= work & -work;
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
  struct Found {
    bool changed, restless, hot;
  };

  // Cells of the word whose neighbour at this offset is matter as they are, and its heats.
  [[gnu::always_inline]] Neighbour neighbour(int w, int y, std::uint64_t own, int dx, int dy, int dz) const {
    std::uint64_t there = matter(v_, w, y + dy, z_ + dz);
    if (dx > 0) there = cpu::from_right(there, matter(v_, w + 1, y + dy, z_ + dz));
    if (dx < 0) there = cpu::from_left(there, matter(v_, w - 1, y + dy, z_ + dz));
    const std::uint16_t* slice = slices_[1 + dz] != nullptr ? slices_[1 + dz] : slices_[1];
    const int row = y + dy >= 0 && y + dy < v_.ny ? y + dy : y;
    return {slice + v_.cell(w, row, 0) + dx, own & there};
  }

  [[gnu::always_inline]] Found word(int w, int y, std::uint64_t own) {
    Neighbour to[Axes::kCount], from[Axes::kCount];
    for (int k = 0; k < Axes::kCount; ++k) {
      const Axis a = Axes::kAxes[k];
      to[k] = neighbour(w, y, own, a.dx, a.dy, a.dz);
      from[k] = neighbour(w, y, own, -a.dx, -a.dy, -a.dz);
    }
    const std::size_t cell = v_.cell(w, y, z_);
    V any = L::zero(), differ = L::zero(), hottest = L::zero();
    V gains[L::kParts];
    for (int part = 0; part < L::kParts; ++part) {
      const std::size_t at = static_cast<std::size_t>(part * L::kCount);
      const V old = L::load(slices_[1] + v_.cell(w, y, 0) + at), heat = plateau_(old);
      V gain = L::zero();
      for (int k = 0; k < Axes::kCount; ++k) {
        const Flux<Arch> flux(weight_, part_dither(step_, k, Axes::kCount));
        const V after = plateau_(L::load_any(to[k].heat + at)),
                before = plateau_(L::load_any(from[k].heat + at));
        gain = gain + flux.between(heat, after, L::from_bits(to[k].pairs, part)) -
               flux.between(before, heat, L::from_bits(from[k].pairs, part));
        differ = differ | L::keep(L::from_bits(to[k].pairs, part), heat ^ after) |
                 L::keep(L::from_bits(from[k].pairs, part), heat ^ before);
      }
      const V now = old + gain;
      L::store(v_.temperature + cell + at, now);
      gains[part] = gain;
      any = any | gain;
      hottest = L::max(hottest, now);
    }
    books_.add(v_.amount + cell, v_.temperature + cell, gains);
    return {L::nonzero(any), L::nonzero(differ), L::nonzero(any) && melting_.reached(hottest)};
  }

  const View v_;
  const std::uint16_t* const slices_[3];
  const Step& step_;
  const int weight_;
  const int z_;
  const Plateau<Arch, kLatent> plateau_;
  const MeltingHeat<Arch> melting_;
  PairBooks<Arch> books_;
};

}  // namespace voxmelt::simd
