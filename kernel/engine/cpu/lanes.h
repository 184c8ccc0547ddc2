// 16-bit lanes are the one place where instruction sets differ. The library xsimd gives the types and the
// plain operations. Its version 8.1 lacks or breaks some for 16 bits: multiply-high, masks from and to bit
// words, widening. One specialisation of Lanes per instruction set adds these, in lanes_*.h.
//
// A word of 64 mask bits serves kParts vectors of kCount lanes. `part` counts them along x, and lane i is bit
// i. Nothing here allocates, throws, or is emitted out of line. So the linker cannot take code of one
// instruction set for another.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#include <xsimd/xsimd.hpp>

#define VOXMELT_LANES [[gnu::always_inline]] static inline
#define VOXMELT_MEMBER [[gnu::always_inline]] inline

namespace voxmelt::cpu {

// LanesOf has the parts that all instruction sets share. Lanes<Arch> adds:
//   V high(V a, V b)                    (a b) >> 16
//   V shift_right<n>(V), shift_left<n>(V)
//   M less(V a, V b)                    unsigned
//   M from_bits(uint64_t word, int part), uint64_t to_bits(M)
//   bool nonzero(V)                     any lane is not 0
//   Twin filled(V a, V b)               lanes that are not 0; those of a come first
//   V mean(V a, V b)                    (a + b + 1) >> 1
//   V keep(M, V)                        the lane, or 0
//   V add_if(M, V a, V b)               a + b where M, else a
//   V sub_if(M, V a, V b)               a - b where M, else a
//   V carry(V a, V low, V most)         a + 1 where low > most, else a
//   Wide unpack(V low, V high)          high 65536 + low
//   V narrow(Wide)                      lanes below 65536
//   Wide pair_product(V f0, V h0, V f1, V h1)   f0 h0 + f1 h1, all signed 16-bit
//   V after(V previous, V current)      lanes moved up by one: lane 0 is the last of `previous`
//   W pair_sums(V a, V b)               a b + a b of neighbouring lanes, all signed 16-bit
//   Bytes                               2 kCount bytes: one for each lane of two neighbouring vectors
//   Twin                                2 kCount bits
//   Bytes load_bytes(const uint8_t*), void store_bytes(uint8_t*, Bytes)      any alignment
//   Bytes none(), bytes(int value)      all 0; all the same
//   Where                               a truth value for each of Bytes
//   Where not_less(V a0, V b0, V a1, V b1)       not a < b; in an order of its own
//   Bytes in_order(Bytes)               what came from `not_less` by cells
//   Where where(Twin)                   by cells
//   Bytes push(Bytes, Where, int bit)   sets this bit; bits must come in descending order, down to 0
//   Bytes fill(Bytes, Where)            sets all bits
//   Bytes both(Bytes a, Bytes b), without(Bytes a, Bytes b)          a & b; a & ~b
//   Twin nonzero_bytes(Bytes)
//   V widen_bytes(const uint8_t*)       kCount bytes as lanes
//   M has(V v, int bit)                 lanes with this bit
//   V count_four(V v)                   how many of the lowest four bits are set
//   void dice(keys, step, const uint32_t blocks[2], Bytes dice[2])    the random bytes (docs/automaton.md,
//                                       section 2) of the cells of two pairs of vectors, by their first
//                                       blocks
//   Table table(const uint16_t entries[32]); V lookup(Table, V index)          entries[index >> 11]
template <class Arch>
struct Lanes;

template <class Arch>
struct LanesOf {
  using V = xsimd::batch<std::uint16_t, Arch>;       // unsigned 16-bit lanes
  using M = xsimd::batch_bool<std::uint16_t, Arch>;  // one truth value per lane
  using W = xsimd::batch<std::int32_t, Arch>;
  using F = xsimd::batch<float, Arch>;
  struct Wide {  // the lanes as 32-bit numbers, in two halves, in the order in which unpacking leaves them
    W low, high;
  };
  struct Divided {
    V quotient, remainder;
  };
  static constexpr int kCount = static_cast<int>(V::size);
  static constexpr int kParts = 64 / kCount;
  static constexpr int kTwins = kParts / 2;  // pairs of vectors in a word
  // Is true if a sum under a mask costs no more than a sum.
  static constexpr bool kMaskedSums = std::is_same_v<Arch, xsimd::avx512bw>;

  // Tells if the word has a bit among the lanes of the part. Most words of a scene are empty but for one or
  // two parts, so asking is cheaper than computing.
  VOXMELT_LANES bool in_part(std::uint64_t word, int part) {
    return (word >> (part * kCount) & ~std::uint64_t{0} >> (64 - kCount)) != 0;
  }

  VOXMELT_LANES V load(const std::uint16_t* at) { return V::load_aligned(at); }  // 64-byte aligned rows
  VOXMELT_LANES V load_any(const std::uint16_t* at) { return V::load_unaligned(at); }
  VOXMELT_LANES void store(std::uint16_t* at, V v) { v.store_aligned(at); }
  // Both take the lanes at + dx, for an aligned address and dx from -1 to 1. The second widens bytes to
  // lanes.
  template <int dx>
  VOXMELT_LANES V load_beside(const std::uint16_t* at) {
    if constexpr (dx == 0) return load(at);
    return load_any(at + dx);
  }
  template <int dx>
  VOXMELT_LANES V widen_beside(const std::uint8_t* at) {
    return Lanes<Arch>::widen_bytes(at + dx);
  }
  VOXMELT_LANES V set(int value) { return V(static_cast<std::uint16_t>(value)); }
  VOXMELT_LANES V zero() { return V(std::uint16_t{0}); }

  VOXMELT_LANES V low(V a, V b) { return a * b; }  // modulo 65536, as + and - are
  VOXMELT_LANES V add_saturated(V a, V b) { return xsimd::sadd(a, b); }
  VOXMELT_LANES V sub_saturated(V a, V b) { return xsimd::ssub(a, b); }
  VOXMELT_LANES V min(V a, V b) { return xsimd::min(a, b); }
  VOXMELT_LANES V max(V a, V b) { return xsimd::max(a, b); }
  VOXMELT_LANES M equal(V a, V b) { return a == b; }
  VOXMELT_LANES V select(M m, V yes, V no) { return xsimd::select(m, yes, no); }

  VOXMELT_LANES Wide widen(V v) { return Lanes<Arch>::unpack(v, zero()); }
  VOXMELT_LANES Wide product(V a, V b) { return Lanes<Arch>::unpack(low(a, b), Lanes<Arch>::high(a, b)); }
  VOXMELT_LANES Wide sum(Wide a, Wide b) { return {a.low + b.low, a.high + b.high}; }

  // Returns quotient and remainder of unsigned 32-bit by 16-bit numbers, d > 0. The quotient is below 65536
  // in the lanes that matter. The result is exact: rounding the operands and the quotient to 24 bits leaves
  // an error below 1/64. So the whole part is at most one off, and the remainder shows it.
  VOXMELT_LANES Divided divide(Wide n, V d) {
    const Wide divisor = widen(d);
    const Half l = divide(n.low, divisor.low), h = divide(n.high, divisor.high);
    return {Lanes<Arch>::narrow({l.quotient, h.quotient}), Lanes<Arch>::narrow({l.remainder, h.remainder})};
  }

  // Sums lanes below 32,768 over at most 32,768 vectors.
  class SmallSums {
   public:
    VOXMELT_MEMBER void add(V v) { pairs_ = pairs_ + Lanes<Arch>::pair_sums(v, V(std::uint16_t{1})); }
    VOXMELT_MEMBER std::uint64_t total() const {
      alignas(64) std::int32_t pairs[W::size];
      pairs_.store_aligned(pairs);
      std::uint64_t total = 0;
      for (const std::int32_t sum : pairs) total += sum;
      return total;
    }

   private:
    W pairs_ = W(0);
  };

  // Sums lanes over at most 32,768 vectors.
  class Sums {
   public:
    VOXMELT_MEMBER void add(V v) {
      const Pairs pairs = xsimd::bitwise_cast<Pairs>(v);
      pairs_ = pairs_ + pairs;
      high_ = high_ + (pairs >> 16);
    }
    VOXMELT_MEMBER std::uint64_t total() const {
      // Pairs are summed modulo 2^32. Subtracting the upper lanes leaves the lower ones. Both sums are
      // below 2^32.
      const auto sums =
          xsimd::bitwise_cast<xsimd::batch<std::uint64_t, Arch>>(pairs_ - (high_ << 16) + high_);
      alignas(64) std::uint64_t two[W::size / 2];
      ((sums >> 32) + (sums & xsimd::batch<std::uint64_t, Arch>(0xFFFFFFFF))).store_aligned(two);
      std::uint64_t total = 0;
      for (const std::uint64_t sum : two) total += sum;
      return total;
    }

   private:
    using Pairs = xsimd::batch<std::uint32_t, Arch>;
    Pairs pairs_ = Pairs(0), high_ = Pairs(0);
  };

 private:
  struct Half {
    W quotient, remainder;
  };
  VOXMELT_LANES Half divide(W n, W d) {
    const F high = xsimd::to_float((n >> 16) & W(0xFFFF)), low = xsimd::to_float(n & W(0xFFFF));
    W q = xsimd::to_int((high * F(65536.f) + low) / xsimd::to_float(d));
    W r = n - q * d;
    const auto over = r < W(0);
    q = xsimd::select(over, q - W(1), q);
    r = xsimd::select(over, r + d, r);
    const auto under = r >= d;
    return {xsimd::select(under, q + W(1), q), xsimd::select(under, r - d, r)};
  }
};

// Calls f(0) .. f(n - 1) with constants for arguments, as unrolled code.
#define VOXMELT_LAMBDA __attribute__((always_inline))
template <int n, class F>
VOXMELT_LANES void unrolled(const F& f) {
  [&]<int... i>(std::integer_sequence<int, i...>) VOXMELT_LAMBDA {
    (f(std::integral_constant<int, i>{}), ...);
  }
  (std::make_integer_sequence<int, n>{});
}

// Makes the compiler hold an address in one register. If addresses are sums of parts that many cells share,
// GCC 12 keeps the parts in memory and adds them up again for every cell.
template <class T>
VOXMELT_LANES T* settled(T* address) {
  asm("" : "+r"(address));
  return address;
}

// Shifts a word of the row along x. Bit x of the result is bit x + 1 of the row, or x - 1 for from_left.
VOXMELT_LANES std::uint64_t from_right(std::uint64_t word, std::uint64_t next) {
  return word >> 1 | next << 63;
}
VOXMELT_LANES std::uint64_t from_left(std::uint64_t word, std::uint64_t previous) {
  return word << 1 | previous >> 63;
}

}  // namespace voxmelt::cpu
