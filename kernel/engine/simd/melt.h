// Phase `melt` turns hot solids into liquid. The extra `reheat` gives hot liquid its energy back. Cold liquid
// freezes where it is full and touches something, and is set elsewhere.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/kernels.h"
#include "kernel/engine/simd/material_lanes.h"

namespace voxmelt::simd {

// Stands in where there is one material.
struct NoPalette {
  [[gnu::always_inline]] explicit NoPalette(const rule::Parameters& /*one material*/) {}
};

template <class Arch, MeltFeatures kFeatures>
class Melt {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] Melt(const View& view, const Step& step, int z, Books& books)
      : v_(view),
        z_(z),
        reheat_(kFeatures.paper && kBuilt.reheat ? step.parameters->flow.paper.reheat : 0),
        melts_(L::set(step.parameters->material.melting_point + step.parameters->material.latent_heat)),
        freezes_(L::set(step.parameters->material.freezing_point)),
        palette_(*step.parameters),
        books_(books) {}

  [[gnu::always_inline]] void run(const TileRow* tiles, TileRow* changed) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      for (int y = v_.tile_begin(r); y < v_.tile_end(r); ++y) {
        TileRow moved = 0;
        for (TileRow left = tiles[r]; left != 0; left &= left - 1)
          if (word(__builtin_ctzll(left), y)) moved |= left & -left;
        if (moved == 0) continue;
        changed[r] |= moved;
        flush();
      }
    }
  }

 private:
  [[gnu::always_inline]] bool word(int w, int y) {
    const std::size_t mask = v_.word(w, y, z_), cell = v_.cell(w, y, z_);
    const std::uint64_t solid = v_.solid[mask], wet = kFeatures.freezes || reheat_ > 0 ? v_.liquid[mask] : 0;
    std::uint64_t frozen = 0;
    bool stirred = false;
    if constexpr (kFeatures.freezes) {
      const std::uint64_t cold = wet == 0 ? 0 : cold_cells(cell, wet);
      if (cold != 0) frozen = cold & full_cells(cell, cold) & touching(w, y);
      stirred = v_.set[mask] != (cold & ~frozen);
      if (stirred) v_.set[mask] = cold & ~frozen;
    }
    if ((solid | wet) == 0) return stirred;
    std::uint64_t below = 0;
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(solid | wet, part)) continue;
      const int at = part * L::kCount;
      V melts = melts_;
      if constexpr (kFeatures.palette)
        melts = MaterialLanes<Arch>(v_.material + cell + at).of(palette_.liquid_from);
      below |= L::to_bits(L::less(L::load(v_.heat + cell + at), melts)) << at;
    }
    const std::uint64_t fresh = solid & ~below, again = reheat_ > 0 ? wet & ~below : 0;
    if ((fresh | again | frozen) == 0) return stirred;
    v_.liquid[mask] = (v_.liquid[mask] | fresh) & ~frozen;
    v_.solid[mask] = (solid & ~fresh) | frozen;
    if constexpr (kFeatures.palette) become_first(cell, fresh);
    if constexpr (kFeatures.paper) stirred |= energise(cell, fresh, again, frozen);
    return (fresh | frozen) != 0 || stirred;
  }

  // Fresh liquid of another material goes on as the first one, at the temperature that it has.
  [[gnu::always_inline]] void become_first(std::size_t cell, std::uint64_t fresh) {
    for (std::uint64_t left = fresh; left != 0; left &= left - 1) {
      const std::size_t at = cell + static_cast<std::size_t>(__builtin_ctzll(left));
      const std::uint8_t material = v_.material[at];
      if (material == 0) continue;
      const std::uint32_t before = v_.heat[at], more = before - palette_.liquid_from[material];
      const std::uint32_t after = std::min(65535u, palette_.as_first[material] + more);
      books_.heat.melted += (std::int64_t{after} - before) * v_.amount[at];
      v_.heat[at] = static_cast<std::uint16_t>(after);
      v_.material[at] = 0;
    }
  }

  // Returns the liquid cells below the freezing point.
  [[gnu::always_inline]] std::uint64_t cold_cells(std::size_t cell, std::uint64_t wet) const {
    std::uint64_t cold = 0;
    for (int part = 0; part < L::kParts; ++part)
      if (L::in_part(wet, part))
        cold |= L::to_bits(L::less(L::load(v_.heat + cell + part * L::kCount), freezes_))
                << (part * L::kCount);
    return wet & cold;
  }
  // Returns those of some cells that hold enough to become solid.
  [[gnu::always_inline]] std::uint64_t full_cells(std::size_t cell, std::uint64_t cells) const {
    const V least = L::set(4096 - 64);
    std::uint64_t short_of = 0;
    for (int part = 0; part < L::kParts; ++part)
      if (L::in_part(cells, part))
        short_of |= L::to_bits(L::less(L::load(v_.amount + cell + part * L::kCount), least))
                    << (part * L::kCount);
    return cells & ~short_of;
  }
  // Returns the cells beside something blocked. The plane of walls is that before this phase.
  [[gnu::always_inline]] std::uint64_t touching(int w, int y) const {
    const std::uint64_t* row = v_.walls_at(y, z_);
    return cpu::from_right(row[w], row[w + 1]) | cpu::from_left(row[w], row[w - 1]) |
           v_.blocked(w, y - 1, z_) | v_.blocked(w, y + 1, z_) | v_.blocked(w, y, z_ - 1) |
           v_.blocked(w, y, z_ + 1);
  }

  // Fresh liquid gets E = A, and frozen cells lose it. Other liquid gets a part of what it lacks.
  [[gnu::always_inline]] bool energise(std::size_t cell, std::uint64_t fresh, std::uint64_t again,
                                       std::uint64_t frozen) {
    V any = L::zero();
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(fresh | again | frozen, part)) continue;
      const std::size_t at = cell + static_cast<std::size_t>(part * L::kCount);
      const V amount = L::load(v_.amount + at), energy = L::load(v_.energy + at);
      const V melted = L::keep(L::from_bits(fresh, part), amount - energy);
      const V reheated = L::keep(L::from_bits(again, part), L::high(amount - energy, L::set(reheat_)));
      V lost = L::zero();
      if constexpr (kFeatures.freezes) {
        lost = L::keep(L::from_bits(frozen, part), energy);
        frozen_.add(lost);
      }
      L::store(v_.energy + at, energy + melted + reheated - lost);
      melted_.add(melted);
      reheated_.add(reheated);
      any = any | melted | reheated;
    }
    return L::to_bits(L::equal(any, L::zero())) != kAll;
  }

  [[gnu::always_inline]] void flush() {
    if constexpr (kFeatures.paper) {
      books_.energy.melted += melted_.total();
      books_.energy.reheated += reheated_.total();
      books_.energy.frozen += frozen_.total();
      melted_ = reheated_ = frozen_ = {};
    }
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const int z_;
  const int reheat_;
  const V melts_, freezes_;
  const std::conditional_t<kFeatures.palette, Palette, NoPalette> palette_;
  Books& books_;
  typename L::Sums melted_, reheated_, frozen_;
};

}  // namespace voxmelt::simd
