// Lanes<avx2>: 16 lanes, a mask is a vector of ones and zeros.
#pragma once

#include <immintrin.h>

#include "kernel/cpu/lanes.h"

namespace voxmelt::cpu {

template <>
struct Lanes<xsimd::avx2> : LanesOf<xsimd::avx2> {
  VOXMELT_LANES V high(V a, V b) { return V(_mm256_mulhi_epu16(a, b)); }
  template <int n>
  VOXMELT_LANES V shift_right(V a) {
    return V(_mm256_srli_epi16(a, n));
  }
  template <int n>
  VOXMELT_LANES V shift_left(V a) {
    return V(_mm256_slli_epi16(a, n));
  }

  // a < b where b is more than a by something.
  VOXMELT_LANES M less(V a, V b) {
    const __m256i none = _mm256_cmpeq_epi16(_mm256_subs_epu16(b, a), _mm256_setzero_si256());
    return M(_mm256_xor_si256(none, _mm256_set1_epi16(-1)));
  }
  VOXMELT_LANES M from_bits(std::uint64_t word, int part) {
    const __m256i bit = _mm256_setr_epi16(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192,
                                          16384, static_cast<short>(0x8000));
    const __m256i all = _mm256_set1_epi16(static_cast<short>(word >> (16 * part)));
    return M(_mm256_cmpeq_epi16(_mm256_and_si256(all, bit), bit));
  }
  VOXMELT_LANES std::uint64_t to_bits(M m) {
    const __m256i v = m;
    const __m128i bytes = _mm_packs_epi16(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
    return static_cast<std::uint32_t>(_mm_movemask_epi8(bytes));
  }
  VOXMELT_LANES bool nonzero(V v) { return _mm256_testz_si256(v, v) == 0; }
  VOXMELT_LANES V keep(M m, V v) { return V(_mm256_and_si256(m, v)); }
  VOXMELT_LANES V add_if(M m, V a, V b) { return a + keep(m, b); }
  VOXMELT_LANES V sub_if(M m, V a, V b) { return a - keep(m, b); }
  VOXMELT_LANES V carry(V a, V low, V most) { return a + min(sub_saturated(low, most), set(1)); }

  VOXMELT_LANES Wide unpack(V low, V high) {
    return {W(_mm256_unpacklo_epi16(low, high)), W(_mm256_unpackhi_epi16(low, high))};
  }
  VOXMELT_LANES V narrow(Wide w) { return V(_mm256_packus_epi32(w.low, w.high)); }
  VOXMELT_LANES Wide pair_product(V f0, V h0, V f1, V h1) {
    return {W(_mm256_madd_epi16(_mm256_unpacklo_epi16(f0, f1), _mm256_unpacklo_epi16(h0, h1))),
            W(_mm256_madd_epi16(_mm256_unpackhi_epi16(f0, f1), _mm256_unpackhi_epi16(h0, h1)))};
  }
  VOXMELT_LANES V after(V previous, V current) {
    const __m256i middle = _mm256_permute2x128_si256(previous, current, 0x21);
    return V(_mm256_alignr_epi8(current, middle, 14));
  }
  VOXMELT_LANES W pair_sums(V a, V b) { return W(_mm256_madd_epi16(a, b)); }

  using Bytes = __m256i;
  using Twin = std::uint32_t;
  VOXMELT_LANES Bytes load_bytes(const std::uint8_t* at) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at));
  }
  VOXMELT_LANES void store_bytes(std::uint8_t* at, Bytes b) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(at), b);
  }
  VOXMELT_LANES Bytes none() { return _mm256_setzero_si256(); }
  VOXMELT_LANES Bytes every() { return _mm256_set1_epi8(-1); }
  VOXMELT_LANES Bytes put(Bytes b, M low, M high, int bit) {
    const __m256i where = _mm256_packs_epi16(low, high);
    return _mm256_or_si256(b, _mm256_and_si256(where, _mm256_set1_epi8(static_cast<char>(bit))));
  }
  VOXMELT_LANES Bytes in_order(Bytes b) { return _mm256_permute4x64_epi64(b, 0xD8); }
  VOXMELT_LANES Bytes put(Bytes b, Twin where, int bit) {
    const __m256i eighth = _mm256_setr_epi64x(0, 0x0101010101010101, 0x0202020202020202, 0x0303030303030303);
    const __m256i one = _mm256_set1_epi64x(static_cast<long long>(0x8040201008040201u));
    const __m256i all = _mm256_shuffle_epi8(_mm256_set1_epi32(static_cast<int>(where)), eighth);
    const __m256i set = _mm256_cmpeq_epi8(_mm256_and_si256(all, one), one);
    return _mm256_or_si256(b, _mm256_and_si256(set, _mm256_set1_epi8(static_cast<char>(bit))));
  }
  VOXMELT_LANES Bytes both(Bytes a, Bytes b) { return _mm256_and_si256(a, b); }
  VOXMELT_LANES Twin nonzero_bytes(Bytes b) {
    return ~static_cast<Twin>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(b, none())));
  }
  VOXMELT_LANES V widen_bytes(const std::uint8_t* at) {
    return V(_mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at))));
  }
  VOXMELT_LANES M has(V v, int bit) {  // one bit
    const __m256i one = _mm256_set1_epi16(static_cast<short>(bit));
    return M(_mm256_cmpeq_epi16(_mm256_and_si256(v, one), one));
  }
  VOXMELT_LANES V count_four(V v) {
    const __m256i counts =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
    return V(_mm256_shuffle_epi8(counts, _mm256_and_si256(v, _mm256_set1_epi16(15))));
  }
  VOXMELT_LANES void dice(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
                          Bytes* dice) {
    // Blocks in the order in which unpacking leaves the bytes of a pair in one vector.
    const int a = static_cast<int>(blocks[0]), b = static_cast<int>(blocks[1]);
    __m256i y = _mm256_add_epi32(_mm256_setr_epi32(a, a, b, b, a, a, b, b),
                                 _mm256_setr_epi32(0, 1, 0, 1, 2, 3, 2, 3));
    __m256i x = _mm256_set1_epi32(static_cast<int>(step));
    const __m256i ror8 = _mm256_setr_epi8(1, 2, 3, 0, 5, 6, 7, 4, 9, 10, 11, 8, 13, 14, 15, 12, 1, 2, 3, 0, 5,
                                          6, 7, 4, 9, 10, 11, 8, 13, 14, 15, 12);
    for (int i = 0; i < 10; ++i) {
      x = _mm256_xor_si256(_mm256_add_epi32(_mm256_shuffle_epi8(x, ror8), y),
                           _mm256_set1_epi32(static_cast<int>(keys[i])));
      y = _mm256_xor_si256(_mm256_or_si256(_mm256_slli_epi32(y, 3), _mm256_srli_epi32(y, 29)), x);
    }
    dice[0] = _mm256_unpacklo_epi32(y, x);
    dice[1] = _mm256_unpackhi_epi32(y, x);
  }

  // table[index >> 11]: 32 entries.
  VOXMELT_LANES V lookup(const std::uint16_t* table, V index) {
    alignas(64) std::uint16_t found[kCount];
    store(found, index);
    for (std::uint16_t& entry : found) entry = table[entry >> 11];
    return load(found);
  }
};

}  // namespace voxmelt::cpu
