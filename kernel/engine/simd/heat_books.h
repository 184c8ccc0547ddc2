// A pass of heat finds more than the heats: the ledger's exact sum of amount x gain, and the cells that may
// melt.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"

namespace voxmelt::simd {

// Books the gains of a pass that moves heat in pairs. One cell loses what another gains, so the gains of a
// pass add up to 0. Then each amount may be counted from a full cell, and full cells need not be booked at
// all.
template <class Arch>
class PairBooks {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using W = typename L::W;

 public:
  // Takes `most_gain`, which no gain exceeds, up or down.
  [[gnu::always_inline]] explicit PairBooks(int most_gain) : fits_(most_gain <= 0x7FFF) {}

  // Returns a vector that is not 0 where cells must be booked.
  [[gnu::always_inline]] static V beside_full(V amount) { return amount ^ L::set(kFull); }

  // Books a vector of cells. Their heats are those after the gain.
  [[gnu::always_inline]] void add(V amount, V now, V gain) {
    if (L::nonzero(beside_full(amount))) book(amount, now, gain);
  }
  // Books a word of cells.
  [[gnu::always_inline]] void add(const std::uint16_t* amounts, const std::uint16_t* heats,
                                  const V (&gains)[L::kParts]) {
    for (int part = 0; part < L::kParts; ++part)
      book(L::load(amounts + part * L::kCount), L::load(heats + part * L::kCount), gains[part]);
  }

  // Ends a row, and must be called for every row: lanes overflow after 32,768 vectors, and a row has at most
  // 512.
  [[gnu::always_inline]] void end_row() {
    if ((++rows_ & 31) == 0) flush();
  }
  [[gnu::always_inline]] std::int64_t total() {
    flush();
    return total_;
  }

 private:
  static constexpr int kFull = 4096;

  [[gnu::always_inline]] void book(V amount, V now, V gain) {
    // Up to this amount, an amount counted from a full cell fits 16 signed bits. A gain fits if its sign
    // agrees with the order of old and new heat.
    V odd = L::sub_saturated(amount, L::set(0x7FFF + kFull));
    if (!fits_) {
      const V old = now - gain;
      odd = odd | ((now ^ old) & (gain ^ old) & L::set(0x8000));
    }
    if (L::nonzero(odd)) return one_by_one(amount, now, gain);
    const W pairs = L::pair_sums(gain, amount - L::set(kFull));
    low_ = low_ + (pairs & W(0xFFFF));
    high_ = high_ + (pairs >> 16);
  }

  [[gnu::always_inline]] void one_by_one(V amount, V now, V gain) {
    alignas(64) std::uint16_t a[L::kCount], before[L::kCount], after[L::kCount];
    L::store(a, amount);
    L::store(before, now - gain);
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
  const bool fits_;
};

// Sums amount x gain, for gain >= 0.
template <class Arch>
class GainBooks {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] void add(V amount, V gain) {
    if (!L::nonzero(gain)) return;
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
  [[gnu::always_inline]] void flush() {
    total_ += high_.total() * 65536 + low_.total();
    low_ = high_ = {};
  }

  typename L::Sums low_, high_;
  std::int64_t total_ = 0;
  unsigned rows_ = 0;
};

// Holds the heat from which on matter melts.
template <class Arch>
class MeltingHeat {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] explicit MeltingHeat(const rule::Material& material)
      : MeltingHeat(material.melting_point + material.latent_heat) {}
  [[gnu::always_inline]] explicit MeltingHeat(int least)
      : least_(least), below_(L::set(least > 0 ? least - 1 : 0)) {}
  // Tells if any lane has reached it. For several vectors, their maximum tells.
  [[gnu::always_inline]] bool reached(V heats) const {
    return least_ == 0 || L::nonzero(L::sub_saturated(heats, below_));
  }

 private:
  int least_;
  V below_;
};

}  // namespace voxmelt::simd
