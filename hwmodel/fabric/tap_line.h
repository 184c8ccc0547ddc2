// A line buffer delays whole tokens (P lanes each), and has taps. Behind every tap there is a register or the
// read port of a memory. A word written through a tap travels on. Each stretch between two taps acts as a
// memory of its own (one read, one write per cycle), whose word is updated on the way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/fabric/wires.h"

namespace voxmelt::hwmodel {

// Tells what a buffer costs: it is `words` deep and `lanes` words wide, of `bits` each.
struct BufferCost {
  std::string name;
  std::int64_t words = 0, lanes = 0, bits = 0;
  std::int64_t total() const { return words * lanes * bits; }
};

template <class Word>
class TapLine {
 public:
  TapLine() = default;
  // Tokens leave `delay` shifts after they came.
  TapLine(int lanes, std::size_t delay) : lanes_(lanes), slots_(delay + 1), words_(slots_ * lanes_) {}

  // Moves everything on by one token. The new token (tap 0) is blank.
  void shift() {
    newest_ = newest_ + 1 == slots_ ? 0 : newest_ + 1;
    Word* word = &words_[newest_ * lanes_];
    for (std::size_t lane = 0; lane < lanes_; ++lane) word[lane] = Word{};
  }

  // Returns the lanes of the token that came `delay` shifts ago (0: the newest), for reading and writing.
  Word* tap(std::size_t delay) {
    if (delay >= slots_) [[unlikely]]
      throw AddressError(delay, slots_);
    const std::size_t slot = newest_ >= delay ? newest_ - delay : newest_ + slots_ - delay;
    return &words_[slot * lanes_];
  }

  std::size_t delay() const { return slots_ - 1; }

 private:
  std::size_t lanes_ = 1, slots_ = 1, newest_ = 0;
  std::vector<Word> words_;
};

}  // namespace voxmelt::hwmodel
