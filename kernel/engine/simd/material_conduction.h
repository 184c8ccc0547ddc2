// Phase `heat` conducts among several materials here, and from isothermal walls to them, one slice at a time.
// Every cell gathers from both sides of each axis. It reads heats from slices of before the pass. Each pair
// has a weight of its own.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/distant_conduction.h"
#include "kernel/engine/simd/flux.h"
#include "kernel/engine/simd/heat_books.h"
#include "kernel/engine/simd/material_lanes.h"
#include "kernel/engine/simd/wall_conduction.h"

namespace voxmelt::simd {

// Returns the weights of a material's pairs over such axes.
template <class Arch>
[[gnu::always_inline]] inline const rule::SolidMaterial::Weights& weights_of(const rule::SolidMaterial& row,
                                                                             FaceAxes<Arch> /*axes*/) {
  return row.weight_face;
}
template <class Arch>
[[gnu::always_inline]] inline const rule::SolidMaterial::Weights& weights_of(const rule::SolidMaterial& row,
                                                                             EdgeAxes<Arch> /*axes*/) {
  return row.weight_edge;
}
template <class Arch>
[[gnu::always_inline]] inline const rule::SolidMaterial::Weights& weights_of(const rule::SolidMaterial& row,
                                                                             CornerAxes<Arch> /*axes*/) {
  return row.weight_corner;
}

template <class Arch, class Axes>
class MaterialConduction {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] MaterialConduction(const View& view, const Step& step, int z, const OldHeat& old)
      : v_(view),
        slices_{old.below, old.own, old.above},
        z_(z),
        temperature_(*step.parameters),
        melting_(temperature_.least_liquid_from()),
        books_(set_weights(*step.parameters)) {
    for (int k = 0; k < Axes::kCount; ++k)
      most_[k] = L::set(static_cast<int>(0xFFFF - part_dither(step, k, Axes::kCount)));
  }

  [[gnu::always_inline]] void run(const TileRow* tiles, const HeatTiles& tell, Books& books) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      for (int y = v_.tile_begin(r); y < v_.tile_end(r); ++y) {
        for (TileRow work = tiles[r]; work != 0; work &= work - 1) {
          const int w = __builtin_ctzll(work);
          const TileRow bit = work & -work;
          const std::uint64_t own = matter(v_, w, y, z_);
          if (own == 0) continue;
          const Found found = word(w, y, own);
          if (L::nonzero(found.any)) {
            tell.changed[r] |= bit;
            if (melting_.reached(found.hottest)) tell.hot[r] |= bit;
          }
          if (L::nonzero(found.differ)) tell.restless[r] |= bit;
        }
        books_.end_row();
        gained_.end_row();
        lost_.end_row();
      }
    }
    books.heat.conducted += books_.total();
    books.heat.walls += gained_.total() - lost_.total();
  }

 private:
  struct Found {
    V any = L::zero(), differ = L::zero(), hottest = L::zero();
  };
  // Is what lies at an offset: heats and materials there, and the cells that have matter or inert there.
  struct Neighbour {
    const std::uint16_t* heat;
    const std::uint8_t* material;
    std::uint64_t matter, inert;
  };
  struct Gain {
    V matter = L::zero(), walls = L::zero(), differ = L::zero();
  };

  // Returns the most that a cell may gain in a pass.
  [[gnu::always_inline]] int set_weights(const rule::Parameters& parameters) {
    int most = 0;
    for (std::size_t m = 0; m < parameters.materials.size(); ++m) {
      const rule::SolidMaterial::Weights& row = weights_of(parameters.materials[m], Axes{});
      for (std::size_t other = 0; other < Palette::kMost; ++other) {
        weights_[m][other] = row[other];
        if (row[other] > most) most = row[other];
      }
      same_[m] = row[m];
    }
    return 2 * Axes::kCount * most;
  }

  [[gnu::always_inline]] std::uint64_t inert(int w, int y, int z) const {
    if (w < 0 || w >= v_.words || y < 0 || y >= v_.ny || z < 0 || z >= v_.nz) return 0;
    return v_.inert[v_.word(w, y, z)];
  }
  [[gnu::always_inline]] static std::uint64_t shifted(int dx, std::uint64_t before, std::uint64_t here,
                                                      std::uint64_t after) {
    if (dx > 0) return cpu::from_right(here, after);
    return dx < 0 ? cpu::from_left(here, before) : here;
  }
  [[gnu::always_inline]] Neighbour neighbour(int w, int y, std::uint64_t own, int dx, int dy, int dz) const {
    const int ny = y + dy, nz = z_ + dz;
    const bool inside = ny >= 0 && ny < v_.ny && slices_[1 + dz] != nullptr;
    const std::uint16_t* slice = inside ? slices_[1 + dz] : slices_[1];
    const int row = inside ? ny : y;
    return {slice + v_.cell(w, row, 0) + dx, v_.material + v_.cell(w, row, inside ? nz : z_) + dx,
            own & shifted(dx, matter(v_, w - 1, ny, nz), matter(v_, w, ny, nz), matter(v_, w + 1, ny, nz)),
            own & shifted(dx, inert(w - 1, ny, nz), inert(w, ny, nz), inert(w + 1, ny, nz))};
  }

  [[gnu::always_inline]] Found word(int w, int y, std::uint64_t own) {
    Neighbour after[Axes::kCount], before[Axes::kCount];
    for (int k = 0; k < Axes::kCount; ++k) {
      const Axis a = Axes::kAxes[k];
      after[k] = neighbour(w, y, own, a.dx, a.dy, a.dz);
      before[k] = neighbour(w, y, own, -a.dx, -a.dy, -a.dz);
    }
    const std::size_t cell = v_.cell(w, y, z_);
    const std::uint16_t* old_heats = slices_[1] + v_.cell(w, y, 0);
    Found found;
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(own, part)) continue;
      const std::size_t at = static_cast<std::size_t>(part * L::kCount);
      const V old = L::load(old_heats + at), amount = L::load(v_.amount + cell + at);
      const MaterialLanes<Arch> materials(v_.material + cell + at);
      const V heat = temperature_(old, materials);
      Gain gain;
      for (int k = 0; k < Axes::kCount; ++k) {
        add(after[k], part, k, heat, materials, true, gain);
        add(before[k], part, k, heat, materials, false, gain);
      }
      const V conducted = old + gain.matter, now = conducted + gain.walls;
      L::store(v_.heat + cell + at, now);
      books_.add(amount, conducted, gain.matter);
      gained_.add(amount, L::sub_saturated(now, conducted));
      lost_.add(amount, L::sub_saturated(conducted, now));
      found.any = found.any | (now ^ old);
      found.differ = found.differ | gain.differ;
      found.hottest = L::max(found.hottest, now);
    }
    return found;
  }

  // Adds what the cells gain from a neighbour. It is `after` them along axis k, or before them.
  [[gnu::always_inline]] void add(const Neighbour& neighbour, int part, int k, V heat,
                                  const MaterialLanes<Arch>& own, bool after, Gain& gain) const {
    if (!L::in_part(neighbour.matter | neighbour.inert, part)) return;
    const std::size_t at = static_cast<std::size_t>(part * L::kCount);
    const V content = L::load_any(neighbour.heat + at);
    const MaterialLanes<Arch> other(neighbour.material + at);
    const V there = temperature_(content, other);
    const M pairs = L::from_bits(neighbour.matter, part);
    gain.matter = gain.matter + L::keep(pairs, flux(heat, there, own.of(weights_, other), k, after));
    gain.differ = gain.differ | L::keep(pairs, heat ^ there);
    if (!L::in_part(neighbour.inert, part)) return;
    const M walls = L::from_bits(neighbour.inert, part) & L::less(L::zero(), content);
    gain.walls = gain.walls + L::keep(walls, flux(heat, there, own.of(same_), k, after));
    gain.differ = gain.differ | L::keep(walls, heat ^ there);
  }
  [[gnu::always_inline]] V flux(V heat, V there, V weight, int k, bool after) const {
    return after ? between(heat, there, weight, k) : L::zero() - between(there, heat, weight, k);
  }
  // Computes floor(((second - first) weight + dither) / 65536) modulo 65536.
  [[gnu::always_inline]] V between(V first, V second, V weight, int k) const {
    const V difference = second - first;
    const V flux = L::carry(L::high(difference, weight), L::low(difference, weight), most_[k]);
    return L::sub_if(L::less(second, first), flux, weight);
  }

  const View v_;
  const std::uint16_t* const slices_[3];
  const int z_;
  const Curves<Arch> temperature_;
  const MeltingHeat<Arch> melting_;
  std::uint16_t weights_[Palette::kMost][Palette::kMost] = {}, same_[Palette::kMost] = {};
  V most_[Axes::kCount];
  PairBooks<Arch> books_;
  GainBooks<Arch> gained_, lost_;
};

}  // namespace voxmelt::simd
