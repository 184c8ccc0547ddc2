// A bit plane holds one bit per cell, packed 64 cells to a word along x.
//
//   word(w, y, z): bit b is cell x = 64 w + b; every row starts a new word; bits past the grid are 0.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernel/automaton/state/grid.h"
#include "kernel/automaton/state/pages.h"

namespace voxmelt::state {

class BitPlane {
 public:
  BitPlane() = default;
  explicit BitPlane(Grid grid)
      : grid_(grid),
        row_words_(words_for(grid.x)),
        pages_(row_words_ * grid.y * grid.z * sizeof(std::uint64_t)) {}

  bool empty() const { return row_words_ == 0; }
  bool test(int x, int y, int z) const { return (data()[word_index(x, y, z)] >> (x & 63)) & 1u; }

  void set(int x, int y, int z, bool value) {
    const std::uint64_t bit = std::uint64_t{1} << (x & 63);
    std::uint64_t& word = data()[word_index(x, y, z)];
    word = value ? word | bit : word & ~bit;
  }

  void clear() { pages_.clear(); }

  std::size_t row_words() const { return row_words_; }
  std::span<const std::uint64_t> row(int y, int z) const {
    return {data() + word_index(0, y, z), row_words_};
  }
  std::span<std::uint64_t> row(int y, int z) { return {data() + word_index(0, y, z), row_words_}; }
  std::span<const std::uint64_t> words() const { return {data(), pages_.size() / sizeof(std::uint64_t)}; }

  std::int64_t count() const {
    std::int64_t total = 0;
    for (const std::uint64_t word : words()) total += std::popcount(word);
    return total;
  }

  std::uint64_t* data() { return reinterpret_cast<std::uint64_t*>(pages_.data()); }
  const std::uint64_t* data() const { return reinterpret_cast<const std::uint64_t*>(pages_.data()); }

  friend bool operator==(const BitPlane& a, const BitPlane& b) {
    return a.grid_ == b.grid_ && a.pages_ == b.pages_;
  }

 private:
  std::size_t word_index(std::size_t x, std::size_t y, std::size_t z) const {
    return (z * grid_.y + y) * row_words_ + x / 64;
  }

  Grid grid_{};
  std::size_t row_words_ = 0;
  Pages pages_;
};

}  // namespace voxmelt::state
