// Phase `heat` conducts from isothermal walls here. These are inert cells whose heat is not 0
// (docs/automaton.md, section 6). It belongs to the same synchronous pass as conduction among matter. So the
// gains are found before that pass changes any heat, and added after it. The walls themselves never change.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/distant_conduction.h"
#include "kernel/engine/simd/flux.h"
#include "kernel/engine/simd/heat_books.h"

namespace voxmelt::simd {

template <class Arch>
struct FaceAxes {
  static constexpr int kCount = 3;
  static constexpr Axis kAxes[kCount]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  [[gnu::always_inline]] static int weight(const rule::Heat& heat) { return heat.weight_face; }
};

template <class Arch, bool kLatent, class Axes>
class WallConduction {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] WallConduction(const View& view, const Step& step, int z, const WallGains& gains)
      : v_(view),
        gains_(gains),
        z_(z),
        plateau_(step.parameters->material),
        melting_(step.parameters->material) {
    for (int k = 0; k < Axes::kCount; ++k)
      fluxes_[k] = Flux<Arch>(Axes::weight(step.parameters->heat), part_dither(step, k, Axes::kCount));
  }

  [[gnu::always_inline]] void find(const TileRow* tiles, TileRow* restless) const {
    for_words(tiles, [&](int w, int y, int r, TileRow bit) VOXMELT_LAMBDA {
      const Contacts contacts = contacts_of(w, y);
      gains_.cells[v_.word(w, y, z_)] = contacts.all;
      V differ = L::zero();
      for (int part = 0; part < L::kParts; ++part) {
        if (!L::in_part(contacts.all, part)) continue;
        const std::size_t at = v_.cell(w, y, z_) + static_cast<std::size_t>(part * L::kCount);
        const std::uint16_t* const own = v_.heat + at;
        const V heat = plateau_(L::load(own));
        V gain = L::zero();
        for (int k = 0; k < Axes::kCount; ++k) {
          const V after = wall_or(contacts.after[k], part, own + ahead(k), heat),
                  before = wall_or(contacts.before[k], part, own - ahead(k), heat);
          gain = gain + fluxes_[k].between(heat, after) - fluxes_[k].between(before, heat);
          differ = differ | (heat ^ after) | (heat ^ before);
        }
        L::store(gains_.gain + at, gain);
      }
      if (L::nonzero(differ)) restless[r] |= bit;
    });
  }

  // Adds the gains. It returns the sum of amount x gain.
  [[gnu::always_inline]] std::int64_t add(const TileRow* tiles, const HeatTiles& tell) {
    for_words(tiles, [&](int w, int y, int r, TileRow bit) VOXMELT_LAMBDA {
      const std::uint64_t cells = gains_.cells[v_.word(w, y, z_)];
      if (cells == 0) return;
      V any = L::zero(), hottest = L::zero();
      for (int part = 0; part < L::kParts; ++part) {
        if (!L::in_part(cells, part)) continue;
        const std::size_t at = v_.cell(w, y, z_) + static_cast<std::size_t>(part * L::kCount);
        const V old = L::load(v_.heat + at), amount = L::load(v_.amount + at);
        const V gain = L::load(gains_.gain + at), now = old + gain;
        L::store(v_.heat + at, now);
        gained_.add(amount, L::sub_saturated(now, old));
        lost_.add(amount, L::sub_saturated(old, now));
        any = any | gain;
        hottest = L::max(hottest, now);
      }
      gained_.end_row();
      lost_.end_row();
      if (!L::nonzero(any)) return;
      tell.changed[r] |= bit;
      if (melting_.reached(hottest)) tell.hot[r] |= bit;
    });
    return gained_.total() - lost_.total();
  }

 private:
  // Marks the cells of matter whose neighbour along an axis, or against it, is a wall.
  struct Contacts {
    std::uint64_t after[Axes::kCount] = {}, before[Axes::kCount] = {}, all = 0;
  };

  // Calls visit(w, y, tile row, bit of w) for the words of the tiles.
  template <class Visit>
  [[gnu::always_inline]] void for_words(const TileRow* tiles, const Visit& visit) const {
    for (int r = 0; r < v_.tile_rows(); ++r)
      for (int y = v_.tile_begin(r); tiles[r] != 0 && y < v_.tile_end(r); ++y)
        for (TileRow left = tiles[r]; left != 0; left &= left - 1)
          visit(__builtin_ctzll(left), y, r, left & -left);
  }

  [[gnu::always_inline]] Contacts contacts_of(int w, int y) const {
    Contacts contacts;
    const std::uint64_t own = matter(v_, w, y, z_);
    if (own == 0) return contacts;
    for (int k = 0; k < Axes::kCount; ++k) {
      const Axis a = Axes::kAxes[k];
      contacts.after[k] = own & walls(w, y + a.dy, z_ + a.dz, a.dx);
      contacts.before[k] = own & walls(w, y - a.dy, z_ - a.dz, -a.dx);
      contacts.all |= contacts.after[k] | contacts.before[k];
    }
    return contacts;
  }

  // Returns the walls of a row, seen by the cells of word w whose neighbours stand dx further.
  [[gnu::always_inline]] std::uint64_t walls(int w, int y, int z, int dx) const {
    if (y < 0 || y >= v_.ny || z < 0 || z >= v_.nz) return 0;
    const std::uint64_t own = walls_of(w, y, z);
    if (dx > 0) return cpu::from_right(own, walls_of(w + 1, y, z));
    if (dx < 0) return cpu::from_left(own, walls_of(w - 1, y, z));
    return own;
  }
  [[gnu::always_inline]] std::uint64_t walls_of(int w, int y, int z) const {
    const std::uint64_t inert = w < 0 || w >= v_.words ? 0 : v_.inert[v_.word(w, y, z)];
    std::uint64_t cold = 0;
    for (int part = 0; part < L::kParts; ++part)
      if (L::in_part(inert, part))
        cold |= L::to_bits(L::equal(L::load(v_.heat + v_.cell(w, y, z) + part * L::kCount), L::zero()))
                << (part * L::kCount);
    return inert & ~cold;
  }

  [[gnu::always_inline]] std::ptrdiff_t ahead(int k) const {
    const Axis a = Axes::kAxes[k];
    return a.dz * static_cast<std::ptrdiff_t>(v_.slice) + a.dy * static_cast<std::ptrdiff_t>(v_.row) + a.dx;
  }
  // Returns the temperatures of the walls at a place. Without a wall it is the cell's own, so that nothing
  // flows.
  [[gnu::always_inline]] V wall_or(std::uint64_t contacts, int part, const std::uint16_t* at, V heat) const {
    if (!L::in_part(contacts, part)) return heat;
    return L::select(L::from_bits(contacts, part), plateau_(L::load_any(at)), heat);
  }

  const View v_;
  const WallGains gains_;
  const int z_;
  const Plateau<Arch, kLatent> plateau_;
  const MeltingHeat<Arch> melting_;
  Flux<Arch> fluxes_[Axes::kCount];
  GainBooks<Arch> gained_, lost_;
};

}  // namespace voxmelt::simd
