// AVX-512 works here without such a processor, for house.avx512. The intrinsics that
// kernel/engine/cpu/lanes_avx512.h and xsimd call for it are plain loops over 64-byte vectors of g++.
//
// The header comes before everything else (-include) when g++ compiles for AVX2. xsimd then takes the AVX-512
// path, and every name below stands for one of its intrinsics. An intrinsic that is missing here stays g++'s
// own, and using it is an error ("target specific option mismatch"): add it.
#pragma once
#pragma GCC system_header
#ifdef __AVX512F__
#error "compile without AVX-512: -march=x86-64-v3"
#endif

#include <immintrin.h>  // before the macros below, which change what it holds

#include <cstdint>
#include <cstring>
#include <type_traits>

#define __AVX512F__ 1
#define __AVX512CD__ 1
#define __AVX512DQ__ 1
#define __AVX512BW__ 1
#define __AVX512VL__ 1

namespace emulated {

typedef std::uint8_t U8 __attribute__((vector_size(64)));
typedef std::uint16_t U16 __attribute__((vector_size(64)));
typedef std::int16_t I16 __attribute__((vector_size(64)));
typedef std::uint32_t U32 __attribute__((vector_size(64)));
typedef std::int32_t I32 __attribute__((vector_size(64)));
typedef std::uint64_t U64 __attribute__((vector_size(64)));

// V, below, is one of these. kBlock counts the lanes in 128 bits. Most instructions that move lanes do so
// only within such a block.
template <class V>
constexpr int kLanes = sizeof(V) / sizeof(V{}[0]);
template <class V>
constexpr int kBlock = kLanes<V> / 4;

// Sets lane i of the result to f(i).
template <class V, class F>
inline __m512i lanes(const F& f) {
  V v;
  for (int i = 0; i < kLanes<V>; ++i) v[i] = f(i);
  return (__m512i)v;
}

// These access memory. An access that must be aligned faults if it is not, as on the processor.
inline __m512i loadu(const void* at) {
  __m512i v;
  std::memcpy(&v, at, sizeof v);
  return v;
}
inline void storeu(void* at, __m512i v) { std::memcpy(at, &v, sizeof v); }
inline void must_be_aligned(const void* at) {
  if (reinterpret_cast<std::uintptr_t>(at) % 64 != 0) __builtin_trap();
}
inline __m512i load(const void* at) {
  must_be_aligned(at);
  return loadu(at);
}
inline void store(void* at, __m512i v) {
  must_be_aligned(at);
  storeu(at, v);
}

// These set the same in every lane, or block, or take lanes from arguments, the last first.
inline __m512i zero() { return __m512i{}; }
template <class V>
inline __m512i set1(decltype(V{}[0] + 0) value) {
  return (__m512i)(V{} + static_cast<std::remove_reference_t<decltype(V{}[0])>>(value));
}
inline __m512 set1_ps(float value) { return __m512{} + value; }
inline __m512i broadcast(__m128i block) {
  return lanes<U64>([=](int i) { return block[i % 2]; });
}
template <class... Last>
inline __m512i set_last_first(Last... last) {
  static_assert(sizeof...(last) == kLanes<I32>);
  const std::int32_t reversed[] = {last...};
  return lanes<I32>([&](int i) { return reversed[kLanes<I32> - 1 - i]; });
}

// These work lane by lane.
template <class V>
inline __m512i add(__m512i a, __m512i b) {
  return (__m512i)((V)a + (V)b);
}
template <class V>
inline __m512i sub(__m512i a, __m512i b) {
  return (__m512i)((V)a - (V)b);
}
template <class V>
inline __m512i mullo(__m512i a, __m512i b) {
  return (__m512i)((V)a * (V)b);
}
template <class V>
inline __m512i min(__m512i a, __m512i b) {
  return (__m512i)((V)a < (V)b ? (V)a : (V)b);
}
template <class V>
inline __m512i max(__m512i a, __m512i b) {
  return (__m512i)((V)a > (V)b ? (V)a : (V)b);
}
inline __m512i adds_epu16(__m512i a, __m512i b) {
  return lanes<U16>([x = (U16)a, y = (U16)b](int i) { return x[i] + y[i] > 65535 ? 65535 : x[i] + y[i]; });
}
inline __m512i subs_epu16(__m512i a, __m512i b) {
  return lanes<U16>([x = (U16)a, y = (U16)b](int i) { return x[i] < y[i] ? 0 : x[i] - y[i]; });
}
inline __m512i abs_epi32(__m512i a) {
  return lanes<U32>([x = (I32)a, y = (U32)a](int i) { return x[i] < 0 ? 0 - y[i] : y[i]; });
}
inline __m512i avg_epu16(__m512i a, __m512i b) {
  return lanes<U16>([x = (U16)a, y = (U16)b](int i) { return (x[i] + y[i] + 1) >> 1; });
}
inline __m512i mulhi_epu16(__m512i a, __m512i b) {
  return lanes<U16>([x = (U16)a, y = (U16)b](int i) { return std::uint32_t{x[i]} * y[i] >> 16; });
}
inline __m512i bitwise_and(__m512i a, __m512i b) { return a & b; }
inline __m512i andnot(__m512i a, __m512i b) { return ~a & b; }
inline __m512i bitwise_or(__m512i a, __m512i b) { return a | b; }
inline __m512i bitwise_xor(__m512i a, __m512i b) { return a ^ b; }
inline __m512 add_ps(__m512 a, __m512 b) { return a + b; }
inline __m512 mul_ps(__m512 a, __m512 b) { return a * b; }
inline __m512 div_ps(__m512 a, __m512 b) { return a / b; }

// Shifts by more than a lane has bits leave nothing, or the sign.
template <class V>
constexpr unsigned kBits = 512 / kLanes<V>;
template <class V>
inline __m512i slli(__m512i a, unsigned n) {
  return n < kBits<V> ? (__m512i)((V)a << n) : zero();
}
template <class V>
inline __m512i srli(__m512i a, unsigned n) {
  return n < kBits<V> ? (__m512i)((V)a >> n) : zero();
}
inline __m512i srai_epi32(__m512i a, unsigned n) { return (__m512i)((I32)a >> (n < 32 ? n : 31)); }
inline __m512i rol_epi32(__m512i a, unsigned n) { return slli<U32>(a, n % 32) | srli<U32>(a, 32 - n % 32); }
inline __m512i ror_epi32(__m512i a, unsigned n) { return rol_epi32(a, 32 - n % 32); }

// These convert from one width to another.
inline __m512i cvtepu8_epi16(__m256i bytes) {
  std::uint8_t from[32];
  std::memcpy(from, &bytes, sizeof from);
  return lanes<U16>([&](int i) { return from[i]; });
}
inline __m512 cvtepi32_ps(__m512i a) { return __builtin_convertvector((I32)a, __m512); }
inline __m512i cvttps_epi32(__m512 a) { return (__m512i)(__builtin_convertvector(a, I32)); }
inline __m512i madd_epi16(__m512i a, __m512i b) {  // modulo 2^32: twice (-32768)^2 is too much for an int
  return lanes<U32>([x = (I16)a, y = (I16)b](int i) {
    return static_cast<std::uint32_t>(x[2 * i] * y[2 * i]) +
           static_cast<std::uint32_t>(x[2 * i + 1] * y[2 * i + 1]);
  });
}
inline __m512i packus_epi32(__m512i a, __m512i b) {
  return lanes<U16>([x = (I32)a, y = (I32)b](int i) {
    const int from = i / 8 * 4 + i % 4, value = i % 8 < 4 ? x[from] : y[from];
    return value < 0 ? 0 : value > 65535 ? 65535 : value;
  });
}

// These move lanes.
template <class V>
inline __m512i unpack(int half, __m512i a, __m512i b) {
  return lanes<V>([x = (V)a, y = (V)b, half](int i) {
    const int from = i / kBlock<V> * kBlock<V> + half * kBlock<V> / 2 + i % kBlock<V> / 2;
    return i % 2 == 0 ? x[from] : y[from];
  });
}
inline __m512i alignr_epi8(__m512i high, __m512i low, int n) {
  return lanes<U8>([h = (U8)high, l = (U8)low, n](int i) {
    const int block = i / 16 * 16, from = i % 16 + n;
    return from < 16 ? l[block + from] : from < 32 ? h[block + from - 16] : 0;
  });
}
inline __m512i alignr_epi64(__m512i high, __m512i low, int n) {
  return lanes<U64>([h = (U64)high, l = (U64)low, n](int i) {
    const int from = i + n % 8;
    return from < 8 ? l[from] : h[from - 8];
  });
}
inline __m512i shuffle_epi8(__m512i a, __m512i which) {
  return lanes<U8>([x = (U8)a, w = (U8)which](int i) { return w[i] > 127 ? 0 : x[i / 16 * 16 + w[i] % 16]; });
}
inline __m512i permutexvar_epi16(__m512i which, __m512i a) {
  return lanes<U16>([x = (U16)a, w = (U16)which](int i) { return x[w[i] % 32]; });
}
inline __m512i permutex2var_epi16(__m512i a, __m512i which, __m512i b) {
  return lanes<U16>([x = (U16)a, y = (U16)b, w = (U16)which](int i) {
    return w[i] % 64 < 32 ? x[w[i] % 32] : y[w[i] % 32];
  });
}

// Masks have bit i for lane i.
template <class V>
using Mask = std::conditional_t<
    kLanes<V> == 64, __mmask64,
    std::conditional_t<kLanes<V> == 32, __mmask32, std::conditional_t<kLanes<V> == 16, __mmask16, __mmask8>>>;
template <class V, class Truth>
inline Mask<V> mask(Truth lanes) {
  std::uint64_t bits = 0;
  for (int i = 0; i < kLanes<V>; ++i) bits |= std::uint64_t{lanes[i] != 0} << i;
  return static_cast<Mask<V>>(bits);
}
template <class V>
inline Mask<V> compare(__m512i a, __m512i b, int how) {
  switch (how) {
    case _MM_CMPINT_EQ:
      return mask<V>((V)a == (V)b);
    case _MM_CMPINT_LT:
      return mask<V>((V)a < (V)b);
    case _MM_CMPINT_LE:
      return mask<V>((V)a <= (V)b);
    case _MM_CMPINT_NE:
      return mask<V>((V)a != (V)b);
    case _MM_CMPINT_NLT:
      return mask<V>((V)a >= (V)b);
    case _MM_CMPINT_NLE:
      return mask<V>((V)a > (V)b);
  }
  __builtin_trap();
}
template <class V>
inline Mask<V> test(__m512i a, __m512i b) {
  return mask<V>((V)(a & b));
}
inline __mmask64 kunpackd(__mmask64 high, __mmask64 low) { return high << 32 | (low & 0xFFFFFFFF); }
template <class V>
inline __m512i blend(Mask<V> k, __m512i no, __m512i yes) {
  return lanes<V>([x = (V)no, y = (V)yes, k](int i) { return k >> i & 1 ? y[i] : x[i]; });
}

}  // namespace emulated

#define _mm512_abs_epi32 emulated::abs_epi32
#define _mm512_add_epi16 emulated::add<emulated::U16>
#define _mm512_add_epi32 emulated::add<emulated::U32>
#define _mm512_add_epi64 emulated::add<emulated::U64>
#define _mm512_add_ps emulated::add_ps
#define _mm512_adds_epu16 emulated::adds_epu16
#define _mm512_avg_epu16 emulated::avg_epu16
#define _mm512_alignr_epi64 emulated::alignr_epi64
#define _mm512_alignr_epi8 emulated::alignr_epi8
#define _mm512_and_si512 emulated::bitwise_and
#define _mm512_andnot_si512 emulated::andnot
#define _mm512_broadcast_i32x4 emulated::broadcast
#define _mm512_cmp_epi32_mask emulated::compare<emulated::I32>
#define _mm512_cmp_epu16_mask emulated::compare<emulated::U16>
#define _mm512_cmpge_epu16_mask(a, b) emulated::compare<emulated::U16>(a, b, _MM_CMPINT_NLT)
#define _mm512_cmplt_epu16_mask(a, b) emulated::compare<emulated::U16>(a, b, _MM_CMPINT_LT)
#define _mm512_cvtepi32_ps emulated::cvtepi32_ps
#define _mm512_cvtepu8_epi16 emulated::cvtepu8_epi16
#define _mm512_cvttps_epi32 emulated::cvttps_epi32
#define _mm512_div_ps emulated::div_ps
#define _mm512_kunpackd emulated::kunpackd
#define _mm512_load_si512 emulated::load
#define _mm512_loadu_si512 emulated::loadu
#define _mm512_madd_epi16 emulated::madd_epi16
#define _mm512_mask_add_epi16(no, k, a, b) \
  emulated::blend<emulated::U16>(k, no, emulated::add<emulated::U16>(a, b))
#define _mm512_mask_add_epi8(no, k, a, b) \
  emulated::blend<emulated::U8>(k, no, emulated::add<emulated::U8>(a, b))
#define _mm512_mask_blend_epi16 emulated::blend<emulated::U16>
#define _mm512_mask_blend_epi32 emulated::blend<emulated::U32>
#define _mm512_mask_mov_epi8(no, k, yes) emulated::blend<emulated::U8>(k, no, yes)
#define _mm512_mask_set1_epi32(no, k, value) \
  emulated::blend<emulated::U32>(k, no, emulated::set1<emulated::U32>(value))
#define _mm512_mask_sub_epi16(no, k, a, b) \
  emulated::blend<emulated::U16>(k, no, emulated::sub<emulated::U16>(a, b))
#define _mm512_maskz_mov_epi16(k, yes) emulated::blend<emulated::U16>(k, emulated::zero(), yes)
#define _mm512_max_epi16 emulated::max<emulated::I16>
#define _mm512_max_epi32 emulated::max<emulated::I32>
#define _mm512_max_epu16 emulated::max<emulated::U16>
#define _mm512_min_epi32 emulated::min<emulated::I32>
#define _mm512_min_epu16 emulated::min<emulated::U16>
#define _mm512_mul_ps emulated::mul_ps
#define _mm512_mulhi_epu16 emulated::mulhi_epu16
#define _mm512_mullo_epi16 emulated::mullo<emulated::U16>
#define _mm512_mullo_epi32 emulated::mullo<emulated::U32>
#define _mm512_or_si512 emulated::bitwise_or
#define _mm512_packus_epi32 emulated::packus_epi32
#define _mm512_permutex2var_epi16 emulated::permutex2var_epi16
#define _mm512_permutexvar_epi16 emulated::permutexvar_epi16
#define _mm512_rol_epi32 emulated::rol_epi32
#define _mm512_ror_epi32 emulated::ror_epi32
#define _mm512_set1_epi16 emulated::set1<emulated::U16>
#define _mm512_set1_epi32 emulated::set1<emulated::U32>
#define _mm512_set1_epi64 emulated::set1<emulated::U64>
#define _mm512_set1_epi8 emulated::set1<emulated::U8>
#define _mm512_set1_ps emulated::set1_ps
#define _mm512_set_epi32 emulated::set_last_first
#define _mm512_setzero_si512 emulated::zero
#define _mm512_shuffle_epi8 emulated::shuffle_epi8
#define _mm512_slli_epi16 emulated::slli<emulated::U16>
#define _mm512_slli_epi32 emulated::slli<emulated::U32>
#define _mm512_srai_epi32 emulated::srai_epi32
#define _mm512_srli_epi16 emulated::srli<emulated::U16>
#define _mm512_srli_epi32 emulated::srli<emulated::U32>
#define _mm512_srli_epi64 emulated::srli<emulated::U64>
#define _mm512_store_si512 emulated::store
#define _mm512_storeu_si512 emulated::storeu
#define _mm512_sub_epi16 emulated::sub<emulated::U16>
#define _mm512_sub_epi32 emulated::sub<emulated::U32>
#define _mm512_subs_epu16 emulated::subs_epu16
#define _mm512_test_epi16_mask emulated::test<emulated::U16>
#define _mm512_test_epi64_mask emulated::test<emulated::U64>
#define _mm512_test_epi8_mask emulated::test<emulated::U8>
#define _mm512_unpackhi_epi16(a, b) emulated::unpack<emulated::U16>(1, a, b)
#define _mm512_unpackhi_epi32(a, b) emulated::unpack<emulated::U32>(1, a, b)
#define _mm512_unpacklo_epi16(a, b) emulated::unpack<emulated::U16>(0, a, b)
#define _mm512_unpacklo_epi32(a, b) emulated::unpack<emulated::U32>(0, a, b)
#define _mm512_xor_si512 emulated::bitwise_xor
