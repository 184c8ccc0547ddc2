// Tiles of a picture are dealt in an order that gives a pipe some of all. Air, matter and ground load
// different stages. So tiles come in turn from several bands of rows, and from another place along each of
// them.
#pragma once

#include <algorithm>

namespace voxmelt::hwmodel::raycast {

class TileTurns {
 public:
  TileTurns() = default;
  TileTurns(int tiles_x, int tiles_y, int bands)
      : tiles_x_(tiles_x), tiles_y_(tiles_y), bands_(std::min(bands, tiles_y)) {
    rows_ = bands_ == 0 ? 0 : (tiles_y_ + bands_ - 1) / bands_;
  }
  // Returns the number of turns. In some of them there is no tile, because the last band may have fewer rows.
  int count() const { return rows_ * tiles_x_ * bands_; }
  struct Tile {
    int x = 0, y = 0;
    bool any = false;
  };
  Tile at(int turn) const {
    const int place = turn / bands_,
              band = (turn % bands_ + place) % bands_;  // each band in each place of a round
    const int y = band * rows_ + place / tiles_x_;
    return {(place + (mirrored(band) * tiles_x_ >> kBandBits)) % tiles_x_, y,
            y < std::min((band + 1) * rows_, tiles_y_)};
  }

 private:
  static constexpr int kBandBits = 6;
  // Returns the place in its row at which a band begins, in 64ths: the bits of its number, mirrored. So bands
  // that are at the same place of their rows lie far apart.
  static int mirrored(int band) {
    int part = 0;
    for (int bit = 1 << (kBandBits - 1); band > 0; band >>= 1, bit >>= 1) part += (band & 1) * bit;
    return part;
  }

  int tiles_x_ = 0, tiles_y_ = 0, bands_ = 0, rows_ = 0;
};

}  // namespace voxmelt::hwmodel::raycast
