// Phase `gravity` of the viscous law lets liquid outside runs fall (docs/automaton.md, section 8). It does
// one slice, ascending, in pairs of rows (y, y + 1), 64 cells at a time. It is free of kernel/automaton/rule
// on purpose.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/kernels.h"
#include "kernel/engine/simd/mix.h"

namespace voxmelt::simd {

template <class Arch, ViscousFeatures kFeatures>
class FallOutside {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] FallOutside(const View& view, const Step& step, int z, const Runs& runs,
                                     Books& books)
      : v_(view),
        fall_(step.parameters->flow.fall),
        in_run_(runs.in_run),
        z_(z),
        books_(books),
        mix_(step.dither) {}

  [[gnu::always_inline]] void run(const TileRow* tiles, TileRow* changed) {
    TileRow moved = 0;  // words that the last pair of rows changed, so that those above may follow
    for (int y = 0; y + 1 < v_.ny; ++y) {
      TileRow work = tiles[y >> v_.tile_shift] | tiles[(y + 1) >> v_.tile_shift] | moved;
      if (v_.words < 64) work &= (TileRow{1} << v_.words) - 1;
      moved = 0;
      for (; work != 0; work &= work - 1) {
        const int w = __builtin_ctzll(work);
        const std::size_t high = v_.word(w, y + 1, z_);
        const std::uint64_t loose = v_.liquid[high] & ~in_run_[high];
        if (loose == 0) continue;
        std::uint64_t open = loose & ~v_.blocked(w, y, z_);
        if (const std::uint64_t set = open & v_.set_cells(w, y + 1, z_); set != 0)
          open &= ~(set & surroundings(w, y + 1).overhang);
        if (open != 0 && pair(w, y, open)) moved |= work & -work;
      }
      if (moved == 0) continue;
      changed[y >> v_.tile_shift] |= moved;
      changed[(y + 1) >> v_.tile_shift] |= moved;
      if constexpr (kFeatures.hot) books_.heat.rounded += mix_.flush();
    }
  }

 private:
  [[gnu::always_inline]] bool pair(int w, int y, std::uint64_t open) {
    const std::size_t low = v_.cell(w, y, z_), high = v_.cell(w, y + 1, z_);
    Around around{};
    if constexpr (kFeatures.guided) around = surroundings(w, y + 1);
    bool moved = false;
    std::uint64_t low_wet = 0, high_wet = 0;
    const std::size_t low_word = v_.word(w, y, z_), high_word = v_.word(w, y + 1, z_);
    for (int part = 0; part < L::kParts; ++part) {
      const std::size_t at = part * L::kCount;
      if (!L::in_part(open, part)) {
        low_wet |= v_.liquid[low_word] & kAll << (part * L::kCount);
        high_wet |= v_.liquid[high_word] & kAll << (part * L::kCount);
        continue;
      }
      vectors(low + at, high + at, open, around, part, moved, low_wet, high_wet);
    }
    if (!moved) return false;
    v_.liquid[low_word] = low_wet & ~(v_.solid[low_word] | v_.inert[low_word]);
    v_.liquid[high_word] = high_wet & ~(v_.solid[high_word] | v_.inert[high_word]);
    return true;
  }

  struct Around {
    std::uint64_t wall, overhang;
  };
  // Tells for the cells of word w in row y if a side is blocked, and if there is something to hang from.
  [[gnu::always_inline]] Around surroundings(int w, int y) const {
    const std::uint64_t own = v_.blocked(w, y, z_);
    const std::uint64_t wall = cpu::from_right(own, v_.blocked(w + 1, y, z_)) |
                               cpu::from_left(own, v_.blocked(w - 1, y, z_)) | v_.blocked(w, y, z_ - 1) |
                               v_.blocked(w, y, z_ + 1);
    return {wall, wall | v_.blocked(w, y + 1, z_)};
  }

  [[gnu::always_inline]] V ready(V upper, V lower, Around around, int part) const {
    if constexpr (!kFeatures.guided) {
      return upper;
    } else {
      const V share = L::select(L::from_bits(around.wall, part), part_of(upper, fall_.wall_factor),
                                part_of(upper, fall_.factor));
      const V given = L::min(upper, L::add_saturated(share, L::set(fall_.minimum)));
      if (fall_.hang == 0) return given;
      const V hangs = L::keep(L::from_bits(around.overhang, part), L::set(0xFFFF));
      const V none_below = L::keep(L::equal(lower, L::zero()), hangs);
      const V light = L::keep(L::less(upper, L::set(fall_.hang)), none_below);
      return L::select(L::equal(light, L::zero()), given, L::zero());
    }
  }
  [[gnu::always_inline]] static V part_of(V a, std::uint32_t factor) {  // factor 0..65536, in 1/65536
    return factor > 0xFFFF ? a : L::high(a, L::set(static_cast<int>(factor)));
  }

  [[gnu::always_inline]] void vectors(std::size_t low, std::size_t high, std::uint64_t open, Around around,
                                      int part, bool& moved, std::uint64_t& low_wet,
                                      std::uint64_t& high_wet) {
    const int shift = part * L::kCount;
    const V lower = L::load(v_.amount + low), upper = L::load(v_.amount + high);
    const V flow = L::keep(L::from_bits(open, part),
                           L::min(ready(upper, lower, around, part), L::sub_saturated(L::set(4096), lower)));
    const V new_lower = lower + flow, new_upper = upper - flow;
    const M low_dry = L::equal(new_lower, L::zero()), high_dry = L::equal(new_upper, L::zero());
    low_wet |= (L::to_bits(low_dry) ^ kAll) << shift;
    high_wet |= (L::to_bits(high_dry) ^ kAll) << shift;
    if (L::to_bits(L::equal(flow, L::zero())) == kAll) return;
    moved = true;
    L::store(v_.amount + low, new_lower);
    L::store(v_.amount + high, new_upper);
    if constexpr (kFeatures.hot) {
      const V low_heat = L::load(v_.heat + low), high_heat = L::load(v_.heat + high);
      const V mixed = mix_.two(lower, low_heat, flow, high_heat);
      L::store(v_.heat + low, L::select(L::less(L::zero(), flow), mixed, low_heat));
      L::store(v_.heat + high, L::select(high_dry, L::zero(), high_heat));
    }
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const rule::Fall& fall_;
  const std::uint64_t* in_run_;
  const int z_;
  Books& books_;
  Mix<Arch> mix_;
};

}  // namespace voxmelt::simd
