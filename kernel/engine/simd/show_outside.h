// Cells outside runs show something, too, under the viscous law. They stand on a bed, on a run, or (all zero)
// in the air.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/beds.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

template <class Arch>
class ShowOutside {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] ShowOutside(const View& view, const Beds<Arch>& beds, int z, const Runs& runs)
      : v_(view), beds_(beds), r_(runs), z_(z) {}

  // Shows the cells of row y. `group` has words from `base` on. It returns those that changed.
  [[gnu::always_inline]] TileRow row(TileRow group, int base, int y) const {
    TileRow changed = 0;
    for (; group != 0; group &= group - 1) {
      const int g = __builtin_ctzll(group), w = base + g;
      const std::size_t word = v_.word(w, y, z_);
      const std::uint64_t in_run = r_.in_run[word], outside = ~(in_run | v_.blocked(w, y, z_));
      const std::uint64_t on_run = y > 0 ? outside & r_.in_run[v_.word(w, y - 1, z_)] : 0;
      const std::uint64_t on_bed = outside & v_.blocked(w, y - 1, z_);
      const std::uint64_t now = in_run | on_run | on_bed, work = (r_.shown[word] | now) & ~in_run;
      r_.shown[word] = now;
      if (work == 0) continue;
      bool differs = false;
      for (int part = 0; part < L::kParts; ++part) {
        if (!L::in_part(work, part)) continue;
        const std::size_t at = v_.cell(w, y, z_) + static_cast<std::size_t>(part * L::kCount);
        const M which = L::from_bits(work, part), stands = L::from_bits(on_bed, part);
        const V below_row = beds_.below(v_, w, y, z_, part);
        V head = L::keep(stands, L::set(512) + L::template shift_right<3>(below_row));
        V bed = L::keep(stands, L::set(16 * y - 15) + L::template shift_right<8>(below_row));
        V mobility = L::zero(), fine = L::zero(), limit = L::zero();
        if (on_run != 0) {
          const M tops = L::from_bits(on_run, part);
          const V below = L::load(r_.head + at - v_.row) - L::set(512);
          head = L::select(tops, below, head);
          bed = L::select(tops, L::load(r_.bed + at - v_.row), bed);
          mobility = L::keep(tops, L::load(r_.mobility + at - v_.row));
          fine = L::keep(tops, L::load(r_.fine + at - v_.row));
          limit = L::keep(tops, L::load(r_.limit + at - v_.row));
        }
        const V dead = L::keep(L::from_bits(on_run | on_bed, part), L::set(0xFFFF));
        differs |= put(r_.head + at, which, head);
        differs |= put(r_.mobility + at, which, mobility);
        differs |= put(r_.dead + at, which, dead);
        differs |= put(r_.bed + at, which, bed);
        differs |= put(r_.fine + at, which, fine);
        differs |= put(r_.limit + at, which, limit);
      }
      if (differs) changed |= TileRow{1} << g;
    }
    return changed;
  }

 private:
  [[gnu::always_inline]] static bool put(std::uint16_t* to, M which, V value) {
    const V old = L::load(to), now = L::select(which, value, old);
    if (L::to_bits(L::equal(old, now)) == kAll) return false;
    L::store(to, now);
    return true;
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View& v_;
  const Beds<Arch>& beds_;
  const Runs& r_;
  const int z_;
};

}  // namespace voxmelt::simd
