// Irradiance lies in memory in this form. Few cells have any, so only tokens that hold some are stored. The
// host writes the stream at a step of visibility, for each tile in the order in which it is streamed. Each
// time step of the cascade reads it for itself.
//
// The stream consists of words of 16 bits. A lit token has a word that counts the dark tokens before it. Then
// comes its mask (a bit per lane, the lowest lane lowest), and then a word for each bit of the mask, in the
// order of the lanes. Behind the last word all tokens are dark. A count that does not fit is followed by an
// empty mask.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "hwmodel/fabric/wires.h"
#include "hwmodel/pipeline/model/shape.h"
#include "kernel/automaton/state/field.h"

namespace voxmelt::hwmodel {

using Irradiance = state::Field<std::uint16_t>;
using IrradianceWords = std::vector<std::uint16_t>;

constexpr int mask_words(int lanes) { return (lanes + 15) / 16; }

class IrradianceStream {
 public:
  IrradianceStream() = default;
  IrradianceStream(const Irradiance& field, const Shape& shape);

  const IrradianceWords& words(int tile) const { return tiles_[tile]; }
  std::int64_t bits(int tile) const { return kWordBits * std::ssize(words(tile)); }
  // Counts over all tiles. Cells of a halo count more than once.
  struct Counts {
    std::int64_t bits = 0, lit_cells = 0, lit_tokens = 0;
  };
  const Counts& counts() const { return counts_; }
  std::int64_t bits() const { return counts_.bits; }
  static constexpr std::int64_t kWordBits = 16;

 private:
  IrradianceWords words_of(const Irradiance& field, const Shape& shape, int tile);

  std::vector<IrradianceWords> tiles_;
  Counts counts_;
};

// Lets a planted fault spoil what the machine makes of the words of irradiance, or of the bits of pieces.
class FeedFault {
 public:
  virtual ~FeedFault() = default;
  // `counted` is called when time step `t` of a pass has read how many dark tokens come from `place` on.
  // `masked` is called when it has read the mask of the token there. `pass` counts the tiles of the train.
  // `last_lost` takes away the last word of this mask.
  virtual void counted(int t, std::int64_t pass, const Place& place, std::uint32_t mask,
                       std::int64_t& dark) = 0;
  virtual void masked(int t, std::int64_t pass, const Place& place, std::uint32_t& mask, bool& last_lost) = 0;
  // This is called when the feed of pieces has read which cells of the token at `place` fall. `before` are
  // those of the token before it.
  virtual void told(std::int64_t /*pass*/, const Place& /*place*/, std::uint32_t /*before*/,
                    std::uint32_t& /*mask*/) {}
};

// Makes tokens of the words, one a cycle if the words are there.
class IrradianceReader {
 public:
  explicit IrradianceReader(int lanes) : lanes_(lanes) {}

  void begin(const IrradianceWords& words) {
    words_ = &words;
    at_ = 0;
    dark_ = 0;
    open_ = false;
  }

  // Returns how many words from the begin of the stream must be there before the next token can be made.
  std::int64_t needs() const {
    if (!open_ && at_ == words_->size()) return used();
    std::size_t end = at_;
    std::uint32_t mask = mask_;
    std::int64_t dark = dark_;
    if (!open_) {
      dark = word(at_);
      mask = mask_at(at_ + 1);
      end += 1 + head_words();
    }
    if (dark == 0) end += std::popcount(mask);
    return end;
  }
  std::int64_t used() const { return at_; }
  static std::int64_t word_bits() { return IrradianceStream::kWordBits; }

  // Makes the next token, at `place`.
  void next(UInt<16>* lanes, const Place& place, FeedFault* fault, int t, std::int64_t pass) {
    for (int lane = 0; lane < lanes_; ++lane) lanes[lane] = 0;
    if (!open_) {
      if (at_ >= words_->size()) return;
      dark_ = word(at_);
      mask_ = mask_at(at_ + 1);
      open_ = true;
      at_ += 1 + head_words();
      if (fault != nullptr) [[unlikely]]
        fault->counted(t, pass, place, mask_, dark_);
    }
    if (dark_-- > 0) return;
    open_ = false;
    bool last_lost = false;
    if (fault != nullptr) [[unlikely]]
      fault->masked(t, pass, place, mask_, last_lost);
    for (std::uint32_t left = mask_; left != 0; left &= left - 1) {
      if (last_lost && std::has_single_bit(left)) return;
      lanes[std::countr_zero(left)] = word(at_++);
    }
  }

 private:
  int head_words() const { return mask_words(lanes_); }
  // Behind the last word a memory may hold anything. This one gives 0.
  std::int64_t word(std::size_t at) const { return at < words_->size() ? (*words_)[at] : 0; }
  std::uint32_t mask_at(std::size_t at) const {
    std::uint32_t mask = 0;
    for (int i = 0; i < head_words(); ++i) mask |= static_cast<std::uint32_t>(word(at + i)) << (16 * i);
    return mask;
  }

  int lanes_;
  const IrradianceWords* words_ = nullptr;
  std::size_t at_ = 0;  // words that have been taken
  std::int64_t dark_ = 0;
  std::uint32_t mask_ = 0;
  bool open_ = false;  // has the head of the next lit token been taken?
};

}  // namespace voxmelt::hwmodel
