// Lanes<avx2> has 16 lanes. A mask is a vector of ones and zeros.
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "kernel/engine/cpu/lanes.h"

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

  // a < b holds where the saturated difference b - a is not 0.
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
  VOXMELT_LANES V mean(V a, V b) { return V(_mm256_avg_epu16(a, b)); }
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
  VOXMELT_LANES Bytes bytes(int value) { return _mm256_set1_epi8(static_cast<char>(value)); }
  using Where = __m256i;
  // The difference tells by how much b exceeds a. Packing keeps every difference but 0 (from 32768 on it
  // counts as negative).
  VOXMELT_LANES Where not_less(V a0, V b0, V a1, V b1) {
    return _mm256_cmpeq_epi8(_mm256_packs_epi16(_mm256_subs_epu16(b0, a0), _mm256_subs_epu16(b1, a1)),
                             none());
  }
  VOXMELT_LANES Bytes push(Bytes b, Where where, int /*bit*/) {
    return _mm256_sub_epi8(_mm256_add_epi8(b, b), where);
  }
  VOXMELT_LANES Bytes fill(Bytes b, Where where) { return _mm256_or_si256(b, where); }
  VOXMELT_LANES Bytes in_order(Bytes b) { return _mm256_permute4x64_epi64(b, 0xD8); }
  VOXMELT_LANES Where where(Twin bits) {
    const __m256i eighth = _mm256_setr_epi64x(0, 0x0101010101010101, 0x0202020202020202, 0x0303030303030303);
    const __m256i one = _mm256_set1_epi64x(static_cast<long long>(0x8040201008040201u));
    const __m256i all = _mm256_shuffle_epi8(_mm256_set1_epi32(static_cast<int>(bits)), eighth);
    return _mm256_cmpeq_epi8(_mm256_and_si256(all, one), one);
  }
  VOXMELT_LANES Bytes both(Bytes a, Bytes b) { return _mm256_and_si256(a, b); }
  VOXMELT_LANES Bytes without(Bytes a, Bytes b) { return _mm256_andnot_si256(b, a); }
  VOXMELT_LANES Twin nonzero_bytes(Bytes b) {
    return ~static_cast<Twin>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(b, none())));
  }
  VOXMELT_LANES Twin filled(V a, V b) {
    const __m256i empty = _mm256_packs_epi16(_mm256_cmpeq_epi16(a, none()), _mm256_cmpeq_epi16(b, none()));
    return ~static_cast<Twin>(_mm256_movemask_epi8(in_order(empty)));
  }
  VOXMELT_LANES V widen_bytes(const std::uint8_t* at) {
    return V(_mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at))));
  }
  VOXMELT_LANES M has(V v, int bit) {  // one of the lowest 15
    return M(_mm256_cmpgt_epi16(_mm256_and_si256(v, set(bit)), _mm256_setzero_si256()));
  }
  VOXMELT_LANES V count_four(V v) {
    const __m256i counts =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
    return V(_mm256_shuffle_epi8(counts, _mm256_and_si256(v, _mm256_set1_epi16(15))));
  }
  VOXMELT_LANES void dice(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
                          Bytes* dice) {
    // The blocks are in the order in which unpacking leaves the bytes of a pair in one vector.
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

  // Holds the low and high bytes of the first and of the last 16 of 32 entries, twice each.
  struct Table {
    __m256i low[2], high[2];
  };
  VOXMELT_LANES Table table(const std::uint16_t* entries) {
    Table table;
    for (int half = 0; half < 2; ++half) {
      const auto* from = reinterpret_cast<const __m128i*>(entries + 16 * half);
      const __m128i a = _mm_loadu_si128(from), b = _mm_loadu_si128(from + 1), byte = _mm_set1_epi16(0xFF);
      const __m128i low = _mm_packus_epi16(_mm_and_si128(a, byte), _mm_and_si128(b, byte));
      const __m128i high = _mm_packus_epi16(_mm_srli_epi16(a, 8), _mm_srli_epi16(b, 8));
      table.low[half] = _mm256_broadcastsi128_si256(low);
      table.high[half] = _mm256_broadcastsi128_si256(high);
    }
    return table;
  }
  VOXMELT_LANES V lookup(const Table& table, V index) {
    const __m256i at = shift_right<11>(index), last = _mm256_cmpgt_epi16(at, _mm256_set1_epi16(15));
    // The upper byte of a lane looks up entry 0, which is masked or shifted out.
    const __m256i low = _mm256_blendv_epi8(_mm256_shuffle_epi8(table.low[0], at),
                                           _mm256_shuffle_epi8(table.low[1], at), last);
    const __m256i high = _mm256_blendv_epi8(_mm256_shuffle_epi8(table.high[0], at),
                                            _mm256_shuffle_epi8(table.high[1], at), last);
    return V(_mm256_or_si256(_mm256_and_si256(low, _mm256_set1_epi16(0xFF)), _mm256_slli_epi16(high, 8)));
  }
};

}  // namespace voxmelt::cpu
