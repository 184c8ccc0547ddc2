// 32-bit lanes use the vector types that g++ and clang have for any processor. Only gathers and a few
// products differ between instruction sets.
//
// Everything is a template over the architecture and always inlined. So the linker cannot take code of one
// instruction set for another's.
#pragma once

#include <cstdint>
#include <cstring>

#include "kernel/engine/cpu/instruction_set_table.h"

#if defined(__AVX2__) || defined(__SSE4_2__)
#include <immintrin.h>
#endif

#define VOXMELT_WORDS [[gnu::always_inline]] static inline

namespace voxmelt::cpu {

template <int kCount>
struct WordVectors;
template <>
struct WordVectors<4> {
  using V [[gnu::vector_size(16)]] = std::int32_t;
  using U [[gnu::vector_size(16)]] = std::uint32_t;
  using F [[gnu::vector_size(16)]] = float;
  using D [[gnu::vector_size(16)]] = double;
  using Q [[gnu::vector_size(16)]] = std::uint64_t;
  using HalfV [[gnu::vector_size(8)]] = std::int32_t;
  using HalfF [[gnu::vector_size(8)]] = float;
  using H [[gnu::vector_size(8)]] = std::uint16_t;
};
template <>
struct WordVectors<8> {
  using V [[gnu::vector_size(32)]] = std::int32_t;
  using U [[gnu::vector_size(32)]] = std::uint32_t;
  using F [[gnu::vector_size(32)]] = float;
  using D [[gnu::vector_size(32)]] = double;
  using Q [[gnu::vector_size(32)]] = std::uint64_t;
  using HalfV [[gnu::vector_size(16)]] = std::int32_t;
  using HalfF [[gnu::vector_size(16)]] = float;
  using H [[gnu::vector_size(16)]] = std::uint16_t;
};
template <>
struct WordVectors<16> {
  using V [[gnu::vector_size(64)]] = std::int32_t;
  using U [[gnu::vector_size(64)]] = std::uint32_t;
  using F [[gnu::vector_size(64)]] = float;
  using D [[gnu::vector_size(64)]] = double;
  using Q [[gnu::vector_size(64)]] = std::uint64_t;
  using HalfV [[gnu::vector_size(32)]] = std::int32_t;
  using HalfF [[gnu::vector_size(32)]] = float;
  using H [[gnu::vector_size(32)]] = std::uint16_t;
};

template <class Arch>
inline constexpr int kWordLanes = 4;
#if !defined(__aarch64__)
template <>
inline constexpr int kWordLanes<xsimd::avx2> = 8;
template <>
inline constexpr int kWordLanes<xsimd::avx512bw> = 16;
#endif

template <class Arch>
struct WordLanes {
  static constexpr int kCount = kWordLanes<Arch>;
  using V = typename WordVectors<kCount>::V;  // masks, too: a lane is 0 or -1
  using U = typename WordVectors<kCount>::U;
  using F = typename WordVectors<kCount>::F;
  using D = typename WordVectors<kCount>::D;  // doubles of half of the lanes, to keep the vector's width
  using Q = typename WordVectors<kCount>::Q;  // 64 bits a lane, for half of the lanes, like D
  using HalfV = typename WordVectors<kCount>::HalfV;
  using HalfF = typename WordVectors<kCount>::HalfF;
  using H = typename WordVectors<kCount>::H;  // 16 bits a lane

  VOXMELT_WORDS V set(std::int32_t value) { return V{} + value; }
  VOXMELT_WORDS F set_float(float value) { return F{} + value; }
  VOXMELT_WORDS V indices() {
    V vector{};
    for (int i = 0; i < kCount; ++i) vector[i] = i;
    return vector;
  }
  VOXMELT_WORDS V load(const std::int32_t* from) {
    V vector;
    std::memcpy(&vector, from, sizeof vector);
    return vector;
  }
  // Halves are taken by shuffles. Through memory, the processor would wait for the stores.
  template <int kWhich>
  VOXMELT_WORDS HalfV half(V a) {
    constexpr int k = kWhich * kCount / 2;
    if constexpr (kCount == 4)
      return __builtin_shufflevector(a, a, k, k + 1);
    else if constexpr (kCount == 8)
      return __builtin_shufflevector(a, a, k, k + 1, k + 2, k + 3);
    else
      return __builtin_shufflevector(a, a, k, k + 1, k + 2, k + 3, k + 4, k + 5, k + 6, k + 7);
  }
  template <class Half>
  VOXMELT_WORDS auto joined(Half low, Half high) {
    if constexpr (kCount == 4)
      return __builtin_shufflevector(low, high, 0, 1, 2, 3);
    else if constexpr (kCount == 8)
      return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    else
      return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  }
  // Stores lanes of 16 bits.
  VOXMELT_WORDS void store_halves(V a, std::uint16_t* to) {
    const H halves = __builtin_convertvector(a, H);
    std::memcpy(to, &halves, sizeof halves);
  }
  VOXMELT_WORDS V min(V a, V b) { return a < b ? a : b; }
  VOXMELT_WORDS V max(V a, V b) { return a > b ? a : b; }
  VOXMELT_WORDS V clamp(V a, std::int32_t low, std::int32_t high) { return min(max(a, set(low)), set(high)); }
  VOXMELT_WORDS F min(F a, F b) { return a < b ? a : b; }
  VOXMELT_WORDS F max(F a, F b) { return a > b ? a : b; }
  VOXMELT_WORDS F to_float(V a) { return __builtin_convertvector(a, F); }
  VOXMELT_WORDS V to_int(F a) { return __builtin_convertvector(a, V); }  // towards 0
  VOXMELT_WORDS V bits_of_float(F a) {
    V vector;
    std::memcpy(&vector, &a, sizeof vector);
    return vector;
  }
  VOXMELT_WORDS F float_of_bits(V a) {
    F f;
    std::memcpy(&f, &a, sizeof f);
    return f;
  }
  VOXMELT_WORDS U as_unsigned(V a) { return reinterpret_cast<U>(a); }
  VOXMELT_WORDS V as_signed(U a) { return reinterpret_cast<V>(a); }

  VOXMELT_WORDS bool any(V mask) {
#if defined(__AVX512F__)
    if constexpr (kCount == 16) return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
#endif
#if defined(__AVX2__)
    if constexpr (kCount == 8) return _mm256_testz_si256((__m256i)mask, (__m256i)mask) == 0;
#endif
#if defined(__SSE4_2__)
    if constexpr (kCount == 4) return _mm_testz_si128((__m128i)mask, (__m128i)mask) == 0;
#endif
    std::int32_t sum = 0;
    for (int i = 0; i < kCount; ++i) sum |= mask[i];
    return sum != 0;
  }

#if defined(__AVX2__)
  // Plain loads gather here, because several processors are slower at the instruction that gathers.
  template <int kScale>
  VOXMELT_WORDS V gather_eight(const void* from, __m256i index) {
    const auto at = [&](std::int64_t i) {
      std::int32_t one;
      std::memcpy(&one, static_cast<const char*>(from) + i * kScale, sizeof one);
      return one;
    };
    const auto two = [&](std::int64_t i) {
      return _mm_insert_epi32(_mm_cvtsi32_si128(at(static_cast<std::int32_t>(i))), at(i >> 32), 1);
    };
    const auto four = [&](__m128i i) {
      return _mm_unpacklo_epi64(two(_mm_cvtsi128_si64(i)), two(_mm_extract_epi64(i, 1)));
    };
    return (V)_mm256_set_m128i(four(_mm256_extracti128_si256(index, 1)), four(_mm256_castsi256_si128(index)));
  }
#endif

  // Loads the 32 bits at `from` + kScale index bytes.
  template <int kScale>
  VOXMELT_WORDS V gather(const void* from, V index) {
#if defined(__AVX512F__)
    if constexpr (kCount == 16) return (V)_mm512_i32gather_epi32((__m512i)index, from, kScale);
#endif
#if defined(__AVX2__)
    if constexpr (kCount == 8) return gather_eight<kScale>(from, (__m256i)index);
#endif
    V vector{};
    for (int i = 0; i < kCount; ++i) {
      std::int32_t one;
      std::memcpy(&one, static_cast<const char*>(from) + std::int64_t{index[i]} * kScale, 4);
      vector[i] = one;
    }
    return vector;
  }

  // Multiplies both 16-bit halves of the lanes, signed, and adds their two products.
  VOXMELT_WORDS V pair_products(V a, V b) {
#if defined(__AVX512F__)
    if constexpr (kCount == 16) return (V)_mm512_madd_epi16((__m512i)a, (__m512i)b);
#endif
#if defined(__AVX2__)
    if constexpr (kCount == 8) return (V)_mm256_madd_epi16((__m256i)a, (__m256i)b);
#endif
#if defined(__SSE4_2__)
    if constexpr (kCount == 4) return (V)_mm_madd_epi16((__m128i)a, (__m128i)b);
#endif
    return ((a << 16) >> 16) * ((b << 16) >> 16) + (a >> 16) * (b >> 16);
  }

  // Returns 2^n for n 0 .. 30. Not every processor shifts lanes by different counts.
  VOXMELT_WORDS V power_of_two(V n) { return to_int(float_of_bits((n + 127) << 23)); }
  // Returns how many bits a lane takes, 0 <= a < 2^24: the least n with a < 2^n.
  VOXMELT_WORDS V bits_of(V a) { return a == 0 ? V{} : (bits_of_float(to_float(a)) >> 23) - 126; }
};

}  // namespace voxmelt::cpu
