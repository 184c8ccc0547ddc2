// Heat travels with liquid. A cell gets the exact mean of the heats that come together (docs/automaton.md,
// section 2).
#pragma once

#include <cstdint>

#include "kernel/engine/cpu/lanes.h"

namespace voxmelt::simd {

template <class Arch>
class Mix {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  using Wide = typename L::Wide;

 public:
  [[gnu::always_inline]] explicit Mix(std::uint32_t dither) : dither_(L::set(static_cast<int>(dither))) {}

  // Returns the mean of (a0, h0) and (a1, h1) where a1 > 0. Other lanes are undefined and not booked.
  [[gnu::always_inline]] V two(V a0, V h0, V a1, V h1) {
    return two(a0, h0, a1, h1, [&](V up, V down) VOXMELT_LAMBDA { book(up, down); });
  }
  // Does the same with books of the caller: book(up, down) takes the rounding, up - down in each lane.
  template <class Book>
  [[gnu::always_inline]] V two(V a0, V h0, V a1, V h1, const Book& book) const {
    // With one part, or two of one heat, the mean is that heat and nothing is rounded.
    const V differs = L::keep(L::less(L::zero(), L::min(a0, a1)), h0 ^ h1);
    if (L::to_bits(L::equal(differs, L::zero())) == kAll) return L::select(L::equal(a0, L::zero()), h1, h0);
    return mean(L::sum(L::product(a0, h0), L::product(a1, h1)), a0 + a1, L::less(L::zero(), a1), book);
  }

  // Returns content / amount, where `counts`.
  [[gnu::always_inline]] V mean(Wide content, V amount, M counts) {
    return mean(content, amount, counts, [&](V up, V down) VOXMELT_LAMBDA { book(up, down); });
  }

  [[gnu::always_inline]] void book(V up, V down) {
    up_.add(up);
    down_.add(down);
  }

  // Returns the term `rounded` of the books: amount x mean - content, which is offset - remainder.
  [[gnu::always_inline]] std::int64_t flush() {
    const std::int64_t rounded =
        static_cast<std::int64_t>(up_.total()) - static_cast<std::int64_t>(down_.total());
    up_ = down_ = {};
    return rounded;
  }

 private:
  template <class Book>
  [[gnu::always_inline]] V mean(Wide content, V amount, M counts, const Book& book) const {
    const V offset = L::high(amount, dither_);
    const auto divided = L::divide(L::sum(content, L::widen(offset)), amount);
    book(L::keep(counts, offset), L::keep(counts, divided.remainder));
    return divided.quotient;
  }
  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  V dither_;
  typename L::Sums up_, down_;
};

}  // namespace voxmelt::simd
