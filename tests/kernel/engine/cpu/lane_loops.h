// Implements the operations of tests/kernel/engine/cpu/lane_operations.h for one instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/flux.h"
#include "kernel/engine/simd/mix.h"
#include "tests/kernel/engine/cpu/lane_operations.h"

namespace voxmelt::cpu {

template <class Arch>
struct LaneLoops {
  using L = Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  using W = typename L::W;
  using Wide = typename L::Wide;
  using In = const std::uint16_t*;
  using Out = std::uint16_t*;
  static constexpr std::size_t kCount = L::kCount;

  template <class F>
  static void each(In in, Out out, const F& f) {
    for (std::size_t i = 0; i < kAllValues; i += kCount) L::store(out + i, f(L::load(in + i)));
  }
  static V low_half(Wide w) { return L::narrow({w.low & W(0xFFFF), w.high & W(0xFFFF)}); }
  static V high_half(Wide w) { return L::narrow({(w.low >> 16) & W(0xFFFF), (w.high >> 16) & W(0xFFFF)}); }
  static V one_if(M m) { return L::keep(m, L::set(1)); }

  static void row(RowOperation operation, int scalar, int r, In in, Out out) {
    const V s = L::set(scalar & 0xFFFF), b = L::set(r & 0xFFFF), rest = L::set(0xFFFF - (r & 0xFFFF));
    switch (operation) {
      case RowOperation::high:
        return each(in, out, [=](V a) { return L::high(a, s); });
      case RowOperation::low:
        return each(in, out, [=](V a) { return L::low(a, s); });
      case RowOperation::product_high:
        return each(in, out, [=](V a) { return high_half(L::product(a, s)); });
      case RowOperation::product_low:
        return each(in, out, [=](V a) { return low_half(L::product(a, s)); });
      case RowOperation::unpack_high:
        return each(in, out, [=](V a) { return high_half(L::unpack(a, s)); });
      case RowOperation::unpack_low:
        return each(in, out, [=](V a) { return low_half(L::unpack(a, s)); });
      case RowOperation::dithered:
        return each(in, out, [=](V a) { return L::high(a, s) + one_if(L::less(rest, L::low(a, s))); });
      case RowOperation::carried:
        return each(in, out, [=](V a) { return L::carry(L::high(a, s), L::low(a, s), rest); });
      case RowOperation::given:
        return each(in, out,
                    [=](V a) { return L::min(a, L::add_saturated(scalar > 0xFFFF ? a : L::high(a, s), b)); });
      case RowOperation::less:
        return each(in, out, [=](V a) { return one_if(L::less(a, s)); });
      case RowOperation::more:
        return each(in, out, [=](V a) { return one_if(L::less(s, a)); });
      case RowOperation::equal:
        return each(in, out, [=](V a) { return one_if(L::equal(a, s)); });
      case RowOperation::min:
        return each(in, out, [=](V a) { return L::min(a, s); });
      case RowOperation::max:
        return each(in, out, [=](V a) { return L::max(a, s); });
      case RowOperation::add_saturated:
        return each(in, out, [=](V a) { return L::add_saturated(a, s); });
      case RowOperation::sub_saturated:
        return each(in, out, [=](V a) { return L::sub_saturated(a, s); });
      case RowOperation::sub_saturated_from:
        return each(in, out, [=](V a) { return L::sub_saturated(s, a); });
      case RowOperation::mean:
        return each(in, out, [=](V a) { return L::mean(a, s); });
      case RowOperation::select:
        return each(in, out, [=](V a) { return L::select(L::less(a, s), b, a); });
      case RowOperation::keep:
        return each(in, out, [=](V a) { return L::keep(L::less(a, s), a); });
      case RowOperation::add_if:
        return each(in, out, [=](V a) { return L::add_if(L::less(a, s), a, b); });
      case RowOperation::sub_if:
        return each(in, out, [=](V a) { return L::sub_if(L::less(a, s), a, b); });
      case RowOperation::temperature: {
        rule::Material material;
        material.melting_point = static_cast<rule::Temperature>(scalar);
        material.latent_heat = static_cast<rule::Temperature>(r);
        return each(in, out, [=](V a) { return simd::Plateau<Arch, true>(material)(a); });
      }
      case RowOperation::conducted: {
        const simd::Flux<Arch> flux(r >> 16, static_cast<std::uint32_t>(r) & 0xFFFFu);
        return each(in, out, [=](V a) { return flux.between(s, a); });
      }
      case RowOperation::falling: {
        const simd::Flux<Arch> flux(scalar, static_cast<std::uint32_t>(r));
        return each(in, out, [=](V a) { return flux.falling(a); });
      }
    }
  }

  static void shift(bool left, int by, In in, Out out) {
    unrolled<15>([&](auto n) {
      constexpr int kBy = n + 1;
      if (by != kBy) return;
      if (left)
        each(in, out, [](V a) { return L::template shift_left<kBy>(a); });
      else
        each(in, out, [](V a) { return L::template shift_right<kBy>(a); });
    });
  }

  static void lookup(In table, In index, Out out) {
    const auto entries = L::table(table);
    each(index, out, [&](V a) { return L::lookup(entries, a); });
  }

  static std::uint64_t bits(std::uint64_t word, Out lanes) {
    std::uint64_t back = 0;
    for (int part = 0; part < L::kParts; ++part) {
      const M m = L::from_bits(word, part);
      L::store(lanes + static_cast<std::size_t>(part) * kCount, L::keep(m, L::set(0xFFFF)));
      back |= L::to_bits(m) << (part * L::kCount);
      if (L::nonzero(one_if(m)) != (L::to_bits(m) != 0)) return ~word;
    }
    return back;
  }

  static void divide(std::size_t size, In low, In high, In d, Out quotient, Out remainder) {
    for (std::size_t i = 0; i < size; i += kCount) {
      const auto divided = L::divide(L::unpack(L::load(low + i), L::load(high + i)), L::load(d + i));
      L::store(quotient + i, divided.quotient);
      L::store(remainder + i, divided.remainder);
    }
  }

  static void pair_product(std::size_t size, In a, In b, In c, In d, Out low, Out high) {
    for (std::size_t i = 0; i < size; i += kCount) {
      const Wide w = L::pair_product(L::load(a + i), L::load(b + i), L::load(c + i), L::load(d + i));
      L::store(low + i, low_half(w));
      L::store(high + i, high_half(w));
    }
  }

  static void pair_sums(std::size_t size, In a, In b, std::int32_t* out) {
    for (std::size_t i = 0; i < size; i += kCount)
      L::pair_sums(L::load(a + i), L::load(b + i)).store_aligned(out + i / 2);
  }

  static void after(std::size_t size, In previous, In current, Out out) {
    for (std::size_t i = 0; i < size; i += kCount)
      L::store(out + i, L::after(L::load(previous + i), L::load(current + i)));
  }

  static void beside(In at, Out left, Out right) {
    L::store(left, L::template load_beside<-1>(at));
    L::store(right, L::template load_beside<1>(at));
  }
  static void bytes_beside(const std::uint8_t* at, Out left, Out right) {
    L::store(left, L::template widen_beside<-1>(at));
    L::store(right, L::template widen_beside<1>(at));
  }

  template <class Sums>
  static std::uint64_t total(std::size_t size, In a) {
    Sums sums;
    for (std::size_t i = 0; i < size; i += kCount) sums.add(L::load(a + i));
    return sums.total();
  }

  static std::int64_t mix(std::size_t size, int dither, In a0, In h0, In a1, In h1, Out out) {
    simd::Mix<Arch> mix(static_cast<std::uint32_t>(dither));
    for (std::size_t i = 0; i < size; i += kCount)
      L::store(out + i, mix.two(L::load(a0 + i), L::load(h0 + i), L::load(a1 + i), L::load(h1 + i)));
    return mix.flush();
  }

  static std::uint64_t bytes(const std::uint16_t (*a)[64], const std::uint16_t (*b)[64], std::uint64_t keep,
                             std::uint8_t* out) {
    using Bytes = typename L::Bytes;
    using Twin = typename L::Twin;
    Bytes together = L::none(), apart = L::none(), filled = L::none(), spread = L::none();
    for (int d = 7; d >= 0; --d) {
      const V a0 = L::load(a[d]), b0 = L::load(b[d]), a1 = L::load_any(a[d] + kCount),
              b1 = L::load_any(b[d] + kCount);
      const auto not_less = L::not_less(a0, b0, a1, b1);
      together = L::push(together, not_less, d);
      filled = L::fill(filled, not_less);
      const Twin less = L::filled(L::keep(L::less(a0, b0), a0 ^ b0), L::keep(L::less(a1, b1), a1 ^ b1));
      apart = L::push(apart, L::where(static_cast<Twin>(~less)), d);
      spread = L::fill(spread, L::where(static_cast<Twin>(~less)));
    }
    const Bytes kept = L::fill(L::none(), L::where(static_cast<Twin>(keep))),
                left_out = L::fill(L::none(), L::where(static_cast<Twin>(~keep)));
    std::uint8_t other[64], all[64], one[64];
    L::store_bytes(out, L::both(L::in_order(together), kept));
    L::store_bytes(other, L::without(apart, left_out));
    L::store_bytes(all, L::in_order(filled));
    L::store_bytes(one, L::both(spread, L::bytes(0xFF)));
    const std::uint64_t found = L::nonzero_bytes(L::load_bytes(out));
    const std::size_t size = 2 * static_cast<std::size_t>(kCount);
    return __builtin_memcmp(out, other, size) == 0 && __builtin_memcmp(all, one, size) == 0 ? found : ~found;
  }

  static void widen(const std::uint8_t* bytes, int bit, Out lanes, Out has, Out count) {
    for (std::size_t i = 0; i < 64; i += kCount) {
      const V wide = L::widen_bytes(bytes + i);
      L::store(lanes + i, wide);
      L::store(has + i, L::keep(L::has(wide, 1 << bit), L::set(0xFFFF)));
      L::store(count + i, L::count_four(wide));
    }
  }

  static void dice(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
                   std::uint8_t* bytes) {
    typename L::Bytes dice[2];
    L::dice(keys, step, blocks, dice);
    for (int i = 0; i < 2; ++i) L::store_bytes(bytes + static_cast<std::size_t>(i) * 2 * kCount, dice[i]);
  }

  static Operations operations() {
    return {L::kCount,
            row,
            shift,
            lookup,
            bits,
            divide,
            pair_product,
            pair_sums,
            after,
            beside,
            bytes_beside,
            total<typename L::Sums>,
            total<typename L::SmallSums>,
            mix,
            bytes,
            widen,
            dice};
  }
};

template <class Arch>
Operations operations_for() {
  return LaneLoops<Arch>::operations();
}

}  // namespace voxmelt::cpu
