// Phase `heat`: radiation received by solids, and exchange with air at exposed cells; each cell alone.
#pragma once

#include "kernel/simd/flux.h"
#include "kernel/simd/heat_books.h"

namespace voxmelt::simd {

template <class Arch, HeatFeatures kFeatures>
class Exchange {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] Exchange(const View& view, const Step& step, int z)
      : v_(view),
        irradiance_(step.irradiance),
        air_temperature_(step.parameters->heat.air_temperature.data()),
        z_(z),
        plateau_(step.parameters->material),
        melting_(step.parameters->material),
        dither_(L::set(static_cast<int>(step.dither))),
        rest_(L::set(static_cast<int>(0xFFFF - step.dither))) {
    // 4096 times the root of the number of exposed axes.
    constexpr int kExposure[3]{4096, 5793, 7094};
    const int exchange = step.parameters->heat.air_exchange;
    for (int n = 0; n < 3; ++n) rate_[n] = L::set((exchange * kExposure[n]) >> 12);
    blows_ = kFeatures.air && exchange > 0;
  }

  [[gnu::always_inline]] void run(const TileRow* tiles, const HeatTiles& tell, Books& books) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      for (int y = v_.tile_begin(r); y < v_.tile_end(r); ++y) {
        for (TileRow left = tiles[r]; left != 0; left &= left - 1) {
          const Found found = word(__builtin_ctzll(left), y);
          if (found.changed) tell.changed[r] |= left & -left;
          if (found.restless) tell.restless[r] |= left & -left;
          if (found.hot) tell.hot[r] |= left & -left;
        }
        radiated_.end_row();
        warmed_.end_row();
        cooled_.end_row();
      }
    }
    books.radiated += radiated_.total();
    books.warmed += warmed_.total();
    books.cooled += cooled_.total();
  }

 private:
  struct Found {
    bool changed, restless, hot;
  };
  struct Exposed {  // cells with at least so many axes on which a side is air
    std::uint64_t one, two, three;
  };

  [[gnu::always_inline]] std::uint64_t air(int w, int y, int z) const {
    const std::uint64_t open = ~v_.blocked(w, y, z);
    return open != 0 ? open & ~v_.liquid[v_.word(w, y, z)] : 0;
  }
  [[gnu::always_inline]] Exposed exposed(int w, int y, std::uint64_t cells) const {
    const std::uint64_t own = air(w, y, z_);
    const std::uint64_t x =
        cells & (cpu::from_right(own, air(w + 1, y, z_)) | cpu::from_left(own, air(w - 1, y, z_)));
    const std::uint64_t up = cells & (air(w, y + 1, z_) | air(w, y - 1, z_));
    const std::uint64_t front = cells & (air(w, y, z_ + 1) | air(w, y, z_ - 1));
    return {x | up | front, (x & up) | (x & front) | (up & front), x & up & front};
  }

  [[gnu::always_inline]] Found word(int w, int y) {
    const std::size_t mask = v_.word(w, y, z_), cell = v_.cell(w, y, z_);
    const std::uint64_t solid = v_.solid[mask];
    Exposed bare{};
    if constexpr (kFeatures.air)
      if (blows_ && (solid | v_.liquid[mask]) != 0) bare = exposed(w, y, solid | v_.liquid[mask]);
    const bool lit = kFeatures.radiation && irradiance_ != nullptr && solid != 0;
    if (!lit && bare.one == 0) return {};

    V any = L::zero(), left = L::zero(), hottest = L::zero();
    for (int part = 0; part < L::kParts; ++part) {
      const std::size_t at = cell + static_cast<std::size_t>(part * L::kCount);
      const V old = L::load(v_.temperature + at), amount = L::load(v_.amount + at);
      V heat = old;
      if constexpr (kFeatures.radiation)
        if (lit)
          heat = radiate(heat, amount, L::keep(L::from_bits(solid, part), L::load(irradiance_ + at)), left);
      if constexpr (kFeatures.air)
        if (bare.one != 0) heat = blow(heat, amount, bare, L::set(air_temperature_[y]), part, left);
      L::store(v_.temperature + at, heat);
      any = any | (heat ^ old);
      hottest = L::max(hottest, heat);
    }
    return {L::nonzero(any), L::nonzero(left), L::nonzero(any) && melting_.reached(hottest)};
  }

  // (4096 I + D) >> 16, cut at the top. `left`: not 0 where a cell is not at rest.
  [[gnu::always_inline]] V radiate(V heat, V amount, V irradiance, V& left) {
    const V room = L::set(0xFFFF) - heat;
    const V low = L::template shift_left<12>(irradiance), high = L::template shift_right<4>(irradiance);
    const V gain = L::min(L::carry(high, low, rest_), room);
    radiated_.add(amount, gain);
    left = left | L::min(irradiance, room);
    return heat + gain;
  }

  // floor((air - T) rate + D) / 65536): for air < T the rounding turns over, |difference| rate by 65535 - D.
  [[gnu::always_inline]] V blow(V heat, V amount, const Exposed& bare, V air, int part, V& left) {
    const V own = plateau_(heat), warmer = L::sub_saturated(air, own), colder = L::sub_saturated(own, air);
    const V rate = L::select(L::from_bits(bare.three, part), rate_[2],
                             L::select(L::from_bits(bare.two, part), rate_[1], rate_[0]));
    const V difference = L::keep(L::from_bits(bare.one, part), warmer + colder);
    const M cools = L::less(L::zero(), colder);
    const V moved =
        L::carry(L::high(difference, rate), L::low(difference, rate), L::select(cools, dither_, rest_));
    const V loss = L::keep(cools, moved), gain = L::min(moved - loss, L::set(0xFFFF) - heat);
    warmed_.add(amount, gain);
    cooled_.add(amount, loss);
    left = left | difference;
    return heat + gain - loss;
  }

  const View v_;
  const std::uint16_t* const irradiance_;
  const std::uint16_t* const air_temperature_;
  const int z_;
  const Plateau<Arch, kFeatures.latent> plateau_;
  const MeltingHeat<Arch> melting_;
  const V dither_, rest_;
  V rate_[3];
  bool blows_ = false;
  GainBooks<Arch> radiated_, warmed_, cooled_;
};

}  // namespace voxmelt::simd
