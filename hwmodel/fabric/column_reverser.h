// A memory of one column reverses columns: what comes bottom first leaves top first, a column later. One
// address serves both ports. The old word is read, then the new one is written in its place. The address
// changes direction after every column. So one memory does the work of two that swap (ping-pong).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/fabric/tap_line.h"

namespace voxmelt::hwmodel {

template <class Word>
class ColumnReverser {
 public:
  ColumnReverser(int lanes, std::int64_t depth) : lanes_(lanes), depth_(depth), words_(lanes_ * depth_) {}

  // Makes the next exchange the first of a column. The old contents of the memory are of no use then.
  void restart() {
    address_ = 0;
    done_ = 0;
    upwards_ = true;
  }

  // Writes a token of this column. Returns in `out` the token of the column before that lies as far from its
  // end.
  void exchange(const Word* in, Word* out) {
    if (address_ >= depth_) [[unlikely]]
      throw AddressError(address_, depth_);
    Word* slot = &words_[address_ * lanes_];
    std::copy(slot, slot + lanes_, out);
    std::copy(in, in + lanes_, slot);
    if (++done_ == depth_) {
      done_ = 0;
      upwards_ = !upwards_;  // the address stays: the last word written is the first one to be read
    } else {
      address_ = upwards_ ? address_ + 1 : address_ - 1;
    }
  }

  BufferCost cost(std::string name, std::int64_t bits) const {
    return {std::move(name), static_cast<std::int64_t>(depth_), static_cast<std::int64_t>(lanes_), bits};
  }

  // Returns the token that the n-th exchange will give. Planted faults call it at the begin of a column.
  const Word* will_give(std::int64_t n) const {
    const std::size_t from = n;
    return &words_[(upwards_ ? address_ + from : address_ - from) * lanes_];
  }
  // Keeps the address from changing direction, so that the column leaves as it came. A planted fault calls it
  // at the begin of a column.
  void miss_turn() {
    upwards_ = !upwards_;
    address_ = upwards_ ? 0 : depth_ - 1;
  }
  // Returns the token written last, within a column.
  Word* newest() { return &words_[(upwards_ ? address_ - 1 : address_ + 1) * lanes_]; }

 private:
  std::size_t lanes_, depth_, address_ = 0, done_ = 0;
  bool upwards_ = true;
  std::vector<Word> words_;
};

}  // namespace voxmelt::hwmodel
