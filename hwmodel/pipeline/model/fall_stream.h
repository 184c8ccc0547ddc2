// The cells that fall lie in memory in this form: one bit for each cell, in the order in which its tile is
// streamed, the lowest lane of a token lowest. Lanes beyond the grid have one, too. The host writes them
// before a pass in which something falls. Only the first time step of a pass reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/fabric/wires.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/shape.h"
#include "kernel/automaton/state/bit_plane.h"

namespace voxmelt::hwmodel {

using FallMasks = std::vector<std::uint32_t>;  // one for each token

class FallStream {
 public:
  FallStream(const state::BitPlane& falling, const Shape& shape);

  const FallMasks& words(int tile) const { return tiles_[tile]; }
  static std::int64_t bits_of_tile(const Shape& shape) { return shape.tokens() * shape.lanes; }

 private:
  std::vector<FallMasks> tiles_;
};

// Makes tokens of the bits, one a cycle if they are there.
class FallReader {
 public:
  explicit FallReader(int lanes) : lanes_(lanes) {}

  void begin(const FallMasks& masks) {
    masks_ = &masks;
    at_ = 0;
  }
  std::int64_t word_bits() const { return lanes_; }
  // Counts the words from the begin of the stream: those that the next token needs, and those taken.
  std::int64_t needs() const { return used() + 1; }
  std::int64_t used() const { return static_cast<std::int64_t>(at_); }

  // Makes the next token, at `place`.
  void next(UInt<1>* lanes, const Place& place, FeedFault* fault, int /*t*/, std::int64_t pass) {
    std::uint32_t mask = (*masks_)[at_];
    if (fault != nullptr) [[unlikely]]
      fault->told(pass, place, at_ > 0 ? (*masks_)[at_ - 1] : 0, mask);
    ++at_;
    for (int lane = 0; lane < lanes_; ++lane) lanes[lane] = mask >> lane & 1;
  }

 private:
  int lanes_;
  const FallMasks* masks_ = nullptr;
  std::size_t at_ = 0;  // masks that have been taken
};

}  // namespace voxmelt::hwmodel
