// Phase `heat` conducts through faces here (Eq. 1), one slice in place. The flux through a face is computed
// once. A cell computes those to x + 1, y + 1 and z + 1, and takes the others from the lane, the row and the
// slice before it. So no old heats need be kept: a heat that a cell still has to read has not been written
// yet.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/full_conduction.h"

namespace voxmelt::simd {

template <class Arch, bool kLatent>
class FaceConduction {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] FaceConduction(const View& view, const Step& step, int z, const OldHeat& old,
                                        const HeatFlux& flux)
      : v_(view),
        heat_(view.heat),
        below_(old.below),
        above_(old.above),
        up_(flux.up),
        front_(flux.front),
        z_(z),
        plateau_(step.parameters->material),
        melting_(step.parameters->material),
        along_x_(step.parameters->heat.weight_face, part_dither(step, 0, 3)),
        along_y_(step.parameters->heat.weight_face, part_dither(step, 1, 3)),
        along_z_(step.parameters->heat.weight_face, part_dither(step, 2, 3)),
        books_(6 * step.parameters->heat.weight_face) {}

  // Conducts in the tiles. `full` works on tile rows that are matter throughout.
  [[gnu::always_inline]] std::int64_t run(const TileRow* carried, const TileRow* tiles,
                                          FullConduction<Arch, kLatent>& full, const HeatTiles& found) {
    for (int r = 0; r < v_.tile_rows(); ++r) {
      if (tiles[r] == 0) continue;
      TileRow from_below = r > 0 ? tiles[r - 1] : 0;
      const TileRow from_back = carried != nullptr ? carried[r] : 0;
      Found tile{0, found.restless[r], found.hot[r]};
      int y = v_.tile_begin(r);
      if (const int rows = full.rows(y, v_.tile_end(r), tiles[r]); rows > 0) {
        for (TileRow left = tiles[r] & ~from_below; left != 0; left &= left - 1)
          enter_y(__builtin_ctzll(left), y, ~std::uint64_t{0});
        for (TileRow left = tiles[r] & ~from_back; left != 0; left &= left - 1)
          for (int k = 0; k < rows; ++k) enter_z(__builtin_ctzll(left), y + k, ~std::uint64_t{0});
        const auto sums = full.run(y, rows, tiles[r]);
        tile.changed |= sums.changed;
        if (sums.changed != 0 && melting_.reached(sums.hottest)) tile.hot |= sums.changed;
        for (TileRow left = tiles[r] & ~sums.changed & ~tile.restless; left != 0; left &= left - 1)
          for (int k = 0; k < rows; ++k)
            if (differs(__builtin_ctzll(left), y + k, ~std::uint64_t{0})) tile.restless |= left & -left;
        from_below = tiles[r];
        y += rows;
      }
      for (; y < v_.tile_end(r); ++y) {
        row(y, tiles[r], from_below, from_back, tile);
        from_below = tiles[r];
        books_.end_row();
      }
      found.changed[r] |= tile.changed;
      found.restless[r] = tile.restless;
      found.hot[r] = tile.hot;
    }
    return books_.total();
  }

 private:
  struct Found {
    TileRow changed, restless, hot;
  };

  // Holds a row's masks of matter, and those above and in front of it. Beyond the grid these are any, and not
  // asked.
  struct Row {
    int y;
    bool last_row, last_slice;
    std::size_t cell, in_slice;  // places of its first word: in the volume, in a slice
    const std::uint64_t *solid, *liquid;
    std::size_t up, front;  // words from here to there
    [[gnu::always_inline]] std::uint64_t own(int w) const { return solid[w] | liquid[w]; }
    [[gnu::always_inline]] std::uint64_t above(std::size_t w) const { return solid[w + up] | liquid[w + up]; }
    [[gnu::always_inline]] std::uint64_t ahead(std::size_t w) const {
      return solid[w + front] | liquid[w + front];
    }
  };
  [[gnu::always_inline]] Row row_at(int y) const {
    const std::size_t word = v_.word(0, y, z_);
    return {y,
            y + 1 == v_.ny,
            z_ + 1 == v_.nz,
            v_.cell(0, y, z_),
            v_.cell(0, y, 0),
            v_.solid + word,
            v_.liquid + word,
            v_.word(0, 1, 0),
            v_.word(0, 0, 1)};
  }

  // Works on one row. from_below and from_back are the words whose flux is carried.
  [[gnu::always_inline]] void row(int y, TileRow work, TileRow from_below, TileRow from_back, Found& found) {
    const Row row = row_at(y);
    for (TileRow left = work; left != 0; left &= left - 1) {
      const TileRow bit = left & -left;
      const int w = __builtin_ctzll(left);
      const std::uint64_t own = row.own(w);
      if (own == 0) {
        nothing(w, y, (from_below & bit) != 0, (from_back & bit) != 0);
        continue;
      }
      if ((from_below & bit) == 0) enter_y(w, y, own);
      if ((from_back & bit) == 0) enter_z(w, y, own);
      if ((work & bit >> 1) == 0) enter_x(w, y, own);
      const Sum sum = word(row, w, own);
      if (L::nonzero(sum.any)) {
        found.changed |= bit;
        if (melting_.reached(sum.hottest)) found.hot |= bit;
      } else if ((found.restless & bit) == 0 && differs(w, y, own)) {
        found.restless |= bit;
      }
    }
  }

  // Computes the flux into a word from words that this sweep did not visit, since it is not carried.
  [[gnu::always_inline]] void enter_x(int w, int y, std::uint64_t own) {
    const std::uint64_t pair = own & matter(v_, w - 1, y, z_) >> 63;
    const std::uint16_t* last = heat_ + v_.cell(w, y, z_) - L::kCount;
    before_ = along_x_.between(plateau_(L::load_any(last)), plateau_(L::load_any(last + 1)),
                               L::from_bits(pair << (L::kCount - 1), 0));
  }
  [[gnu::always_inline]] void enter_y(int w, int y, std::uint64_t own) {
    const std::uint16_t* to = heat_ + v_.cell(w, y, z_);
    enter(up_ + 64 * static_cast<std::size_t>(w), y > 0 ? to - v_.row : to, to,
          own & matter(v_, w, y - 1, z_), along_y_);
  }
  [[gnu::always_inline]] void enter_z(int w, int y, std::uint64_t own) {
    const std::uint16_t* to = heat_ + v_.cell(w, y, z_);
    const std::size_t at = v_.cell(w, y, 0);
    enter(front_ + at, below_ != nullptr ? below_ + at : to, to, own & matter(v_, w, y, z_ - 1), along_z_);
  }
  [[gnu::always_inline]] void enter(std::uint16_t* flux, const std::uint16_t* from, const std::uint16_t* to,
                                    std::uint64_t pairs, const Flux<Arch>& rule) {
    for (int part = 0; part < L::kParts; ++part) {
      const int at = part * L::kCount;
      if (!L::in_part(pairs, part))
        L::store(flux + at, L::zero());
      else
        L::store(flux + at, rule.between(plateau_(L::load(from + at)), plateau_(L::load(to + at)),
                                         L::from_bits(pairs, part)));
    }
  }

  // Clears the fluxes out of a word without matter. A flux that was carried here is 0.
  [[gnu::always_inline]] void nothing(int w, int y, bool from_below, bool from_back) {
    before_ = L::zero();
    for (int at = 0; at < 64; at += L::kCount) {
      if (!from_below) L::store(up_ + 64 * w + at, L::zero());
      if (!from_back) L::store(front_ + v_.cell(w, y, 0) + at, L::zero());
    }
  }

  struct Pairs {  // cells that are matter and have a neighbour of matter
    std::uint64_t right, up, front;
  };

  struct Sum {
    V any, hottest;  // any: not 0 where heat changed
  };

  [[gnu::always_inline]] Sum word(const Row& row, int w, std::uint64_t own) {
    const std::size_t in_words = w;
    const std::uint64_t right = w + 1 < v_.words ? row.own(w + 1) : 0;
    const Pairs pairs{own & cpu::from_right(own, right), row.last_row ? 0 : own & row.above(in_words),
                      row.last_slice ? 0 : own & row.ahead(in_words)};
    const std::size_t in_row = 64 * in_words, cell = row.cell + in_row, in_slice = row.in_slice + in_row;
    const std::uint16_t *up = heat_ + cell, *front = up;
    if (!row.last_row) up += v_.row;
    if (above_ != nullptr) front = above_ + in_slice;
    V any = L::zero(), hottest = L::zero();
    for (int part = 0; part < L::kParts; ++part) {
      const std::size_t at = static_cast<std::size_t>(part * L::kCount);
      if (!L::in_part(own, part)) {  // the stored fluxes into it are 0, and so are those out of it
        before_ = L::zero();
        continue;
      }
      std::uint16_t* here = heat_ + cell + at;
      const V old = L::load(here), heat = plateau_(old);
      const V x_flux =
          along_x_.between(heat, plateau_(L::load_any(here + 1)), L::from_bits(pairs.right, part));
      const V y_flux = along_y_.between(heat, plateau_(L::load(up + at)), L::from_bits(pairs.up, part));
      const V z_flux = along_z_.between(heat, plateau_(L::load(front + at)), L::from_bits(pairs.front, part));
      const V gain = (x_flux - L::after(before_, x_flux)) + (y_flux - L::load(up_ + in_row + at)) +
                     (z_flux - L::load(front_ + in_slice + at));
      before_ = x_flux;
      L::store(up_ + in_row + at, y_flux);
      L::store(front_ + in_slice + at, z_flux);
      const V now = old + gain;
      L::store(here, now);
      books_.add(L::load(v_.amount + cell + at), now, gain);
      any = any | gain;
      hottest = L::max(hottest, now);
    }
    return {any, hottest};
  }

  // Tells if any pair of this word has two temperatures. A neighbour that changed in this pass is reported as
  // changed, and wakes this tile in any case.
  [[gnu::always_inline]] bool differs(int w, int y, std::uint64_t own) const {
    const std::uint16_t* here = heat_ + v_.cell(w, y, z_);
    const std::size_t in_slice = v_.cell(w, y, 0), row = v_.row;
    const std::uint64_t front = own & matter(v_, w, y, z_ + 1), back = own & matter(v_, w, y, z_ - 1);
    const bool first = y == 0, last = y + 1 == v_.ny;
    return differ(here, here + 1, own & cpu::from_right(own, matter(v_, w + 1, y, z_))) ||
           differ(here, here - 1, own & cpu::from_left(own, matter(v_, w - 1, y, z_))) ||
           differ(here, last ? here : here + row, own & matter(v_, w, y + 1, z_)) ||
           differ(here, first ? here : here - row, own & matter(v_, w, y - 1, z_)) ||
           differ(here, above_ != nullptr ? above_ + in_slice : here, front) ||
           differ(here, below_ != nullptr ? below_ + in_slice : here, back);
  }
  [[gnu::always_inline]] bool differ(const std::uint16_t* here, const std::uint16_t* there,
                                     std::uint64_t pairs) const {
    std::uint64_t same = 0;
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(pairs, part)) continue;
      const int at = part * L::kCount;
      same |= L::to_bits(L::equal(plateau_(L::load(here + at)), plateau_(L::load_any(there + at)))) << at;
    }
    return (pairs & ~same) != 0;
  }

  const View v_;
  std::uint16_t* const heat_;
  const std::uint16_t *const below_, *const above_;
  std::uint16_t *const up_, *const front_;
  const int z_;
  const Plateau<Arch, kLatent> plateau_;
  const MeltingHeat<Arch> melting_;
  const Flux<Arch> along_x_, along_y_, along_z_;
  V before_ = L::zero();  // flux along x through the faces of the vector before
  PairBooks<Arch> books_;
};

}  // namespace voxmelt::simd
