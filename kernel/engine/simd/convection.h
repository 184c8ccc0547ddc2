// Phase `heat` convects here: heat rises in liquid that is hotter below. One slice is done in place, rows
// ascending. The heat that rises into a row is carried from the row below it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/flux.h"
#include "kernel/engine/simd/heat_books.h"

namespace voxmelt::simd {

// Temperature gives that of liquid, by its heat.
template <class Arch, class Temperature>
class Convection {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] Convection(const View& view, const Step& step, int z, const HeatFlux& flux)
      : v_(view),
        rising_(flux.up),
        z_(z),
        temperature_(*step.parameters),
        melting_(temperature_.least_liquid_from()),
        flux_(step.parameters->heat.convection, step.dither),
        books_(step.parameters->heat.convection) {}

  [[gnu::always_inline]] std::int64_t run(const TileRow* tiles, const HeatTiles& tell) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      TileRow carried = r > 0 ? tiles[r - 1] : 0;
      for (int y = v_.tile_begin(r); y < v_.tile_end(r); ++y) {
        for (TileRow left = tiles[r]; left != 0; left &= left - 1) {
          const TileRow bit = left & -left;
          const int w = __builtin_ctzll(left);
          const std::uint64_t own = v_.liquid[v_.word(w, y, z_)];
          std::uint16_t* rising = rising_ + 64 * static_cast<std::size_t>(w);
          if (own == 0) {
            for (int at = 0; at < 64; at += L::kCount) L::store(rising + at, L::zero());
            continue;
          }
          if ((carried & bit) == 0) enter(w, y, own, rising);
          const Found found = word(w, y, own, rising);
          if (found.changed) tell.changed[r] |= bit;
          if (found.hot) tell.hot[r] |= bit;
          if (found.restless) {  // marks both ends of the pairs
            tell.restless[r] |= bit;
            tell.restless[(y + 1) >> v_.tile_shift] |= bit;
          }
        }
        carried = tiles[r];
        books_.end_row();
      }
    }
    return books_.total();
  }

 private:
  struct Found {
    bool changed, restless, hot;
  };

  // Returns how much hotter the lower cells are, where a bit of `pairs` is set.
  [[gnu::always_inline]] V hotter(V lower, V upper, std::uint64_t pairs, int part) const {
    return L::keep(L::from_bits(pairs, part), L::sub_saturated(temperature_(lower), temperature_(upper)));
  }

  [[gnu::always_inline]] void enter(int w, int y, std::uint64_t own, std::uint16_t* rising) {
    const std::uint16_t* upper = v_.heat + v_.cell(w, y, z_);
    const std::uint16_t* lower = y > 0 ? upper - v_.row : upper;
    const std::uint64_t pairs = y > 0 ? own & v_.liquid[v_.word(w, y - 1, z_)] : 0;
    for (int part = 0; part < L::kParts; ++part) {
      const int at = part * L::kCount;
      L::store(rising + at, flux_.falling(hotter(L::load(lower + at), L::load(upper + at), pairs, part)));
    }
  }

  [[gnu::always_inline]] Found word(int w, int y, std::uint64_t own, std::uint16_t* rising) {
    const bool last = y + 1 == v_.ny;
    const std::size_t cell = v_.cell(w, y, z_);
    const std::uint64_t pairs = last ? 0 : own & v_.liquid[v_.word(w, y + 1, z_)];
    std::uint16_t* here = v_.heat + cell;
    const std::uint16_t* upper = last ? here : here + v_.row;
    V any = L::zero(), differ = L::zero(), hottest = L::zero();
    const std::uint64_t paired = pairs | (y > 0 ? own & v_.liquid[v_.word(w, y - 1, z_)] : 0);
    for (int part = 0; part < L::kParts; ++part) {
      const int at = part * L::kCount;
      if (!L::in_part(paired, part)) continue;  // the stored heat that rises into it is 0
      const V old = L::load(here + at), step = hotter(old, L::load(upper + at), pairs, part);
      const V out = flux_.falling(step), gain = L::load(rising + at) - out, now = old + gain;
      L::store(rising + at, out);
      L::store(here + at, now);
      books_.add(L::load(v_.amount + cell + at), now, gain);
      any = any | gain;
      differ = differ | step;
      hottest = L::max(hottest, now);
    }
    return {L::nonzero(any), L::nonzero(differ), L::nonzero(any) && melting_.reached(hottest)};
  }

  const View v_;
  std::uint16_t* const rising_;
  const int z_;
  const Temperature temperature_;
  const MeltingHeat<Arch> melting_;
  const Flux<Arch> flux_;
  PairBooks<Arch> books_;
};

}  // namespace voxmelt::simd
