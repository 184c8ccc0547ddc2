// Phase `melt` turns hot solids into liquid. The extra `reheat` gives hot liquid its energy back.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

template <class Arch, bool kPaper>
class Melt {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] Melt(const View& view, const Step& step, int z, Books& books)
      : v_(view),
        z_(z),
        reheat_(kPaper && kBuilt.reheat ? step.parameters->flow.paper.reheat : 0),
        melts_(L::set(step.parameters->material.melting_point + step.parameters->material.latent_heat)),
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
    const std::uint64_t solid = v_.solid[mask], wet = reheat_ > 0 ? v_.liquid[mask] : 0;
    if ((solid | wet) == 0) return false;
    std::uint64_t cold = 0;
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(solid | wet, part)) continue;
      const int at = part * L::kCount;
      cold |= L::to_bits(L::less(L::load(v_.heat + cell + at), melts_)) << at;
    }
    const std::uint64_t fresh = solid & ~cold, again = wet & ~cold;
    if ((fresh | again) == 0) return false;
    v_.liquid[mask] |= fresh;
    v_.solid[mask] = solid & ~fresh;
    bool stirred = false;
    if constexpr (kPaper) stirred = energise(cell, fresh, again);
    return fresh != 0 || stirred;
  }

  // Fresh liquid gets E = A. Other liquid gets a part of what it lacks.
  [[gnu::always_inline]] bool energise(std::size_t cell, std::uint64_t fresh, std::uint64_t again) {
    V any = L::zero();
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(fresh | again, part)) continue;
      const std::size_t at = cell + static_cast<std::size_t>(part * L::kCount);
      const V amount = L::load(v_.amount + at), energy = L::load(v_.energy + at);
      const V melted = L::keep(L::from_bits(fresh, part), amount - energy);
      const V reheated = L::keep(L::from_bits(again, part), L::high(amount - energy, L::set(reheat_)));
      L::store(v_.energy + at, energy + melted + reheated);
      melted_.add(melted);
      reheated_.add(reheated);
      any = any | melted | reheated;
    }
    return L::to_bits(L::equal(any, L::zero())) != kAll;
  }

  [[gnu::always_inline]] void flush() {
    if constexpr (kPaper) {
      books_.energy.melted += melted_.total();
      books_.energy.reheated += reheated_.total();
      melted_ = reheated_ = {};
    }
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const int z_;
  const int reheat_;
  const V melts_;
  Books& books_;
  typename L::Sums melted_, reheated_;
};

}  // namespace voxmelt::simd
