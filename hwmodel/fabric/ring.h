// A ring is a queue of tokens (P lanes each) that keeps its memory. It grows when it is full.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace voxmelt::hwmodel {

template <class Word>
class Ring {
 public:
  explicit Ring(int lanes) : lanes_(lanes) {}

  bool empty() const { return count_ == 0; }
  void clear() { count_ = 0; }
  void push(const Word* lanes) {
    if (count_ == slots_) grow();
    std::copy(lanes, lanes + lanes_, slot(count_++));
  }
  // Removes the oldest token, and returns its lanes. They stay valid until the next push. The ring must hold
  // a token.
  const Word* pop() {
    const Word* const lanes = slot(0);
    first_ = (first_ + 1) % slots_;
    --count_;
    return lanes;
  }

 private:
  Word* slot(std::size_t after_first) { return &words_[(first_ + after_first) % slots_ * lanes_]; }
  void grow() {
    const std::size_t slots = slots_ == 0 ? 8 : 2 * slots_;
    std::vector<Word> more(slots * lanes_);
    for (std::size_t i = 0; i < count_; ++i) std::copy(slot(i), slot(i) + lanes_, &more[i * lanes_]);
    words_ = std::move(more);
    slots_ = slots;
    first_ = 0;
  }

  std::size_t lanes_, slots_ = 0, first_ = 0, count_ = 0;
  std::vector<Word> words_;
};

}  // namespace voxmelt::hwmodel
