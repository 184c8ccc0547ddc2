// Phase `heat` lets solids receive radiation and exposed cells exchange heat with air, and glow, here. Each
// cell acts alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernel/engine/simd/flux.h"
#include "kernel/engine/simd/heat_books.h"
#include "kernel/engine/simd/material_lanes.h"

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
        temperature_(*step.parameters),
        melting_(temperature_.least_liquid_from()),
        dither_(L::set(static_cast<int>(step.dither))),
        rest_(L::set(static_cast<int>(0xFFFF - step.dither))) {
    const rule::Heat& heat = step.parameters->heat;
    for (int n = 0; n < 3; ++n) {  // of n + 1 exposed axes
      rate_[n] = L::set((heat.air_exchange * (4 + n)) >> 2);
      glow_rate_[n] = L::set((heat.air_glow * (4 + n)) >> 2);
      if constexpr (kFeatures.palette)
        for (std::size_t m = 0; m < step.parameters->materials.size(); ++m)
          rates_[n][m] =
              static_cast<std::uint16_t>((step.parameters->materials[m].air_exchange * (4 + n)) >> 2);
    }
    sky_ = fourth_power(L::set(heat.air_sky));
    glows_ = kFeatures.air && heat.air_glow > 0;
    blows_ = kFeatures.air && (kFeatures.palette || heat.air_exchange > 0 || glows_);
  }

  [[gnu::always_inline]] void run(const TileRow* tiles, const HeatTiles& tell, Books& books) {
    run_all(tiles, tell);
    books.heat.radiated += radiated_.total();
    books.heat.warmed += warmed_.total();
    books.heat.cooled += cooled_.total();
  }

 private:
  [[gnu::always_inline]] void run_all(const TileRow* tiles, const HeatTiles& tell) {
    if constexpr (kFeatures.air)
      if (glows_) return run_rows<true>(tiles, tell);
    run_rows<false>(tiles, tell);
  }

  template <bool kGlows>
  [[gnu::always_inline]] void run_rows(const TileRow* tiles, const HeatTiles& tell) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      for (int y = v_.tile_begin(r); y < v_.tile_end(r); ++y) {
        const Row row = row_at(y);
        for (TileRow left = tiles[r]; left != 0; left &= left - 1) {
          const Found found = word<kGlows>(row, __builtin_ctzll(left));
          if (found.changed) tell.changed[r] |= left & -left;
          if (found.restless) tell.restless[r] |= left & -left;
          if (found.hot) tell.hot[r] |= left & -left;
        }
        radiated_.end_row();
        warmed_.end_row();
        cooled_.end_row();
      }
    }
  }

  struct Found {
    bool changed, restless, hot;
  };
  struct Exposed {  // cells with at least so many axes on which a side is air
    std::uint64_t one, two, three;
  };

  struct Near {  // words of a row
    const std::uint64_t *walls, *liquid;
    // A word beyond the grid along x is neither air nor liquid.
    [[gnu::always_inline]] std::uint64_t air(int w) const {
      const std::uint64_t open = ~walls[w];
      return open != 0 ? open & ~liquid[w] : 0;
    }
  };
  struct Row {
    int y;
    std::size_t mask, cell;  // places of its first word
    Near own, up, down, front, back;
  };
  [[gnu::always_inline]] Row row_at(int y) const {
    Row row{y, v_.word(0, y, z_), v_.cell(0, y, z_), {}, {}, {}, {}, {}};
    if constexpr (kFeatures.air) {
      const std::size_t line = v_.word(0, 1, 0), slice = v_.word(0, 0, 1);
      const std::uint64_t* liquid = v_.liquid + row.mask;
      // Beyond the grid all is wall. Bits that are read as liquid there do not matter.
      row.own = {v_.walls_at(y, z_), liquid};
      row.up = {v_.walls_at(y + 1, z_), y + 1 < v_.ny ? liquid + line : liquid};
      row.down = {v_.walls_at(y - 1, z_), y > 0 ? liquid - line : liquid};
      row.front = {v_.walls_at(y, z_ + 1), z_ + 1 < v_.nz ? liquid + slice : liquid};
      row.back = {v_.walls_at(y, z_ - 1), z_ > 0 ? liquid - slice : liquid};
    }
    return row;
  }
  [[gnu::always_inline]] Exposed exposed(const Row& row, int w, std::uint64_t cells) const {
    const std::uint64_t own = ~(row.own.walls[w] | row.own.liquid[w]);
    const std::uint64_t x =
        cells & (cpu::from_right(own, row.own.air(w + 1)) | cpu::from_left(own, row.own.air(w - 1)));
    const std::uint64_t up =
        cells & ~((row.up.walls[w] | row.up.liquid[w]) & (row.down.walls[w] | row.down.liquid[w]));
    const std::uint64_t front =
        cells & ~((row.front.walls[w] | row.front.liquid[w]) & (row.back.walls[w] | row.back.liquid[w]));
    return {x | up | front, (x & up) | (x & front) | (up & front), x & up & front};
  }

  template <bool kGlows>
  [[gnu::always_inline]] Found word(const Row& row, int w) {
    const std::size_t mask = row.mask + static_cast<std::size_t>(w),
                      cell = row.cell + 64 * static_cast<std::size_t>(w);
    const std::uint64_t solid = v_.solid[mask];
    Exposed bare{};
    if constexpr (kFeatures.air)
      if (const std::uint64_t cells = solid | v_.liquid[mask]; blows_ && cells != 0)
        bare = exposed(row, w, cells);
    const bool lit = kFeatures.radiation && irradiance_ != nullptr && solid != 0;
    if (!lit && bare.one == 0) return {};

    V any = L::zero(), left = L::zero(), hottest = L::zero();
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part((lit ? solid : 0) | bare.one, part)) continue;
      const std::size_t at = cell + static_cast<std::size_t>(part * L::kCount);
      const V old = L::load(v_.heat + at), amount = L::load(v_.amount + at);
      V heat = old;
      if constexpr (kFeatures.radiation)
        if (lit)
          heat = radiate(heat, amount, L::keep(L::from_bits(solid, part), L::load(irradiance_ + at)), left);
      if constexpr (kFeatures.air)
        if (bare.one != 0) heat = meet_air<kGlows>(row.y, heat, amount, bare, at, part, left);
      L::store(v_.heat + at, heat);
      any = any | (heat ^ old);
      hottest = L::max(hottest, heat);
    }
    return {L::nonzero(any), L::nonzero(left), L::nonzero(any) && melting_.reached(hottest)};
  }

  // Returns (4096 I + D) >> 16, cut at the top. `left` becomes other than 0 where a cell is not at rest.
  [[gnu::always_inline]] V radiate(V heat, V amount, V irradiance, V& left) {
    const V room = L::set(0xFFFF) - heat;
    const V low = L::template shift_left<12>(irradiance), high = L::template shift_right<4>(irradiance);
    const V gain = L::min(L::carry(high, low, rest_), room);
    radiated_.add(amount, gain);
    left = left | L::min(irradiance, room);
    return heat + gain;
  }

  [[gnu::always_inline]] static V fourth_power(V temperature) {
    const V square = L::high(temperature, temperature);
    return L::high(square, square);
  }

  // Exchanges heat with the air, and glows.
  template <bool kGlows>
  [[gnu::always_inline]] V meet_air(int y, V heat, V amount, const Exposed& bare, std::size_t at, int part,
                                    V& left) {
    const V air = L::set(air_temperature_[y]);
    if constexpr (kFeatures.palette) {
      const MaterialLanes<Arch> materials(v_.material + at);
      const V rates[3] = {materials.of(rates_[0]), materials.of(rates_[1]), materials.of(rates_[2])};
      heat = exchange(heat, amount, bare, temperature_(heat, materials), air, rates, part, left);
      if constexpr (!kGlows) return heat;
      return exchange(heat, amount, bare, fourth_power(temperature_(heat, materials)), sky_, glow_rate_, part,
                      left);
    } else {
      heat = exchange(heat, amount, bare, temperature_(heat), air, rate_, part, left);
      if constexpr (!kGlows) return heat;
      return exchange(heat, amount, bare, fourth_power(temperature_(heat)), sky_, glow_rate_, part, left);
    }
  }

  // Adds floor(((other - own) rate + D) / 65536). For other < own the rounding is reversed: |difference| rate
  // is rounded with 65535 - D.
  [[gnu::always_inline]] V exchange(V heat, V amount, const Exposed& bare, V own, V other,
                                    const V (&rates)[3], int part, V& left) {
    const V warmer = L::sub_saturated(other, own), colder = L::sub_saturated(own, other);
    const V rate = L::select(L::from_bits(bare.three, part), rates[2],
                             L::select(L::from_bits(bare.two, part), rates[1], rates[0]));
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
  const std::conditional_t<kFeatures.palette, Curves<Arch>, Plateau<Arch, kFeatures.latent>> temperature_;
  const MeltingHeat<Arch> melting_;
  const V dither_, rest_;
  V rate_[3], glow_rate_[3], sky_;
  std::uint16_t rates_[3][Palette::kMost] = {};  // rate_ by material
  bool blows_ = false, glows_ = false;
  GainBooks<Arch> radiated_, warmed_, cooled_;
};

}  // namespace voxmelt::simd
