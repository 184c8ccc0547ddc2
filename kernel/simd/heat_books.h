// The heat ledger's sums of amount x gain, exact.
#pragma once

#include "kernel/cpu/lanes.h"

namespace voxmelt::simd {

// Gains of a pass that moves heat in pairs. What one cell gains another loses, so the gains of a pass add up
// to 0, and each amount may be counted from a full cell: full cells need not be booked at all.
template <class Arch>
class PairBooks {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using W = typename L::W;

 public:
  [[gnu::always_inline]] void add(V amount, V old, V now) {
    const V full = L::set(kFull);
    if (L::to_bits(L::equal(amount, full)) == kAll) return;
    // A gain fits 16 signed bits if its sign is that of old and now, or theirs differ as it says.
    const V gain = now - old, overflow = (now ^ old) & (gain ^ old);
    const auto odd =
        L::to_bits(L::less(L::set(0x7FFF), overflow)) | L::to_bits(L::less(L::set(0x7FFF + kFull), amount));
    if (odd != 0) return one_by_one(amount, old, now);
    const W pairs = L::pair_sums(gain, amount - full);
    low_ = low_ + (pairs & W(0xFFFF));
    high_ = high_ + (pairs >> 16);
  }

  // To be called for every row: lanes overflow after 32,768 calls of add, a row has at most 512.
  [[gnu::always_inline]] void end_row() {
    if ((++rows_ & 31) == 0) flush();
  }
  [[gnu::always_inline]] std::int64_t total() {
    flush();
    return total_;
  }

 private:
  static constexpr int kFull = 4096;
  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;

  [[gnu::always_inline]] void one_by_one(V amount, V old, V now) {
    alignas(64) std::uint16_t a[L::kCount], before[L::kCount], after[L::kCount];
    L::store(a, amount);
    L::store(before, old);
    L::store(after, now);
    for (int i = 0; i < L::kCount; ++i)
      total_ += std::int64_t{a[i] - kFull} * (static_cast<int>(after[i]) - static_cast<int>(before[i]));
  }
  [[gnu::always_inline]] void flush() {
    alignas(64) std::int32_t low[W::size], high[W::size];
    low_.store_aligned(low);
    high_.store_aligned(high);
    for (std::size_t i = 0; i < W::size; ++i)
      total_ += std::int64_t{high[i]} * 65536 + static_cast<std::uint32_t>(low[i]);
    low_ = high_ = W(0);
  }

  W low_ = W(0), high_ = W(0);
  std::int64_t total_ = 0;
  unsigned rows_ = 0;
};

// Sum of amount x gain, gain >= 0.
template <class Arch>
class GainBooks {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] void add(V amount, V gain) {
    if (L::to_bits(L::equal(gain, L::zero())) == kAll) return;
    low_.add(L::low(amount, gain));
    high_.add(L::high(amount, gain));
  }
  [[gnu::always_inline]] void end_row() {
    if ((++rows_ & 31) == 0) flush();
  }
  [[gnu::always_inline]] std::int64_t total() {
    flush();
    return total_;
  }

 private:
  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;

  [[gnu::always_inline]] void flush() {
    total_ += static_cast<std::int64_t>(high_.total() * 65536 + low_.total());
    low_ = high_ = {};
  }

  typename L::Sums low_, high_;
  std::int64_t total_ = 0;
  unsigned rows_ = 0;
};

}  // namespace voxmelt::simd
