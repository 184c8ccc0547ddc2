// Lanes<sse4_2> has 8 lanes, and a mask is a vector of ones and zeros. It runs on every x86-64-v2 processor.
#pragma once

#include <nmmintrin.h>

#include <cstdint>

#include "kernel/engine/cpu/lanes.h"

namespace voxmelt::cpu {

template <>
struct Lanes<xsimd::sse4_2> : LanesOf<xsimd::sse4_2> {
  VOXMELT_LANES V high(V a, V b) { return V(_mm_mulhi_epu16(a, b)); }
  template <int n>
  VOXMELT_LANES V shift_right(V a) {
    return V(_mm_srli_epi16(a, n));
  }
  template <int n>
  VOXMELT_LANES V shift_left(V a) {
    return V(_mm_slli_epi16(a, n));
  }

  // a < b holds where the saturated difference b - a is not 0.
  VOXMELT_LANES M less(V a, V b) {
    const __m128i none = _mm_cmpeq_epi16(_mm_subs_epu16(b, a), _mm_setzero_si128());
    return M(_mm_xor_si128(none, _mm_set1_epi16(-1)));
  }
  VOXMELT_LANES M from_bits(std::uint64_t word, int part) {
    const __m128i bit = _mm_setr_epi16(1, 2, 4, 8, 16, 32, 64, 128);
    const __m128i all = _mm_set1_epi16(static_cast<short>(word >> (8 * part)));
    return M(_mm_cmpeq_epi16(_mm_and_si128(all, bit), bit));
  }
  VOXMELT_LANES std::uint64_t to_bits(M m) {
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(m, _mm_setzero_si128())));
  }
  VOXMELT_LANES bool nonzero(V v) { return _mm_testz_si128(v, v) == 0; }
  VOXMELT_LANES V mean(V a, V b) { return V(_mm_avg_epu16(a, b)); }
  VOXMELT_LANES V keep(M m, V v) { return V(_mm_and_si128(m, v)); }
  VOXMELT_LANES V add_if(M m, V a, V b) { return a + keep(m, b); }
  VOXMELT_LANES V sub_if(M m, V a, V b) { return a - keep(m, b); }
  VOXMELT_LANES V carry(V a, V low, V most) { return a + min(sub_saturated(low, most), set(1)); }

  VOXMELT_LANES Wide unpack(V low, V high) {
    return {W(_mm_unpacklo_epi16(low, high)), W(_mm_unpackhi_epi16(low, high))};
  }
  VOXMELT_LANES V narrow(Wide w) { return V(_mm_packus_epi32(w.low, w.high)); }
  VOXMELT_LANES Wide pair_product(V f0, V h0, V f1, V h1) {
    return {W(_mm_madd_epi16(_mm_unpacklo_epi16(f0, f1), _mm_unpacklo_epi16(h0, h1))),
            W(_mm_madd_epi16(_mm_unpackhi_epi16(f0, f1), _mm_unpackhi_epi16(h0, h1)))};
  }
  VOXMELT_LANES V after(V previous, V current) { return V(_mm_alignr_epi8(current, previous, 14)); }
  VOXMELT_LANES W pair_sums(V a, V b) { return W(_mm_madd_epi16(a, b)); }

  using Bytes = __m128i;
  using Twin = std::uint16_t;
  VOXMELT_LANES Bytes load_bytes(const std::uint8_t* at) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
  }
  VOXMELT_LANES void store_bytes(std::uint8_t* at, Bytes b) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(at), b);
  }
  VOXMELT_LANES Bytes none() { return _mm_setzero_si128(); }
  VOXMELT_LANES Bytes bytes(int value) { return _mm_set1_epi8(static_cast<char>(value)); }
  using Where = __m128i;
  // The difference tells by how much b exceeds a. Packing keeps every difference but 0 (from 32768 on it
  // counts as negative).
  VOXMELT_LANES Where not_less(V a0, V b0, V a1, V b1) {
    return _mm_cmpeq_epi8(_mm_packs_epi16(_mm_subs_epu16(b0, a0), _mm_subs_epu16(b1, a1)), none());
  }
  VOXMELT_LANES Bytes push(Bytes b, Where where, int /*bit*/) {
    return _mm_sub_epi8(_mm_add_epi8(b, b), where);
  }
  VOXMELT_LANES Bytes fill(Bytes b, Where where) { return _mm_or_si128(b, where); }
  VOXMELT_LANES Bytes in_order(Bytes b) { return b; }
  VOXMELT_LANES Where where(Twin bits) {
    const __m128i eighth = _mm_setr_epi8(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1);
    const __m128i one = _mm_set1_epi64x(static_cast<long long>(0x8040201008040201u));
    const __m128i all = _mm_shuffle_epi8(_mm_cvtsi32_si128(bits), eighth);
    return _mm_cmpeq_epi8(_mm_and_si128(all, one), one);
  }
  VOXMELT_LANES Bytes both(Bytes a, Bytes b) { return _mm_and_si128(a, b); }
  VOXMELT_LANES Bytes without(Bytes a, Bytes b) { return _mm_andnot_si128(b, a); }
  VOXMELT_LANES Twin nonzero_bytes(Bytes b) {
    return static_cast<Twin>(~_mm_movemask_epi8(_mm_cmpeq_epi8(b, none())));
  }
  VOXMELT_LANES Twin filled(V a, V b) {
    const __m128i empty = _mm_packs_epi16(_mm_cmpeq_epi16(a, none()), _mm_cmpeq_epi16(b, none()));
    return static_cast<Twin>(~_mm_movemask_epi8(empty));
  }
  VOXMELT_LANES V widen_bytes(const std::uint8_t* at) {
    return V(_mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at))));
  }
  VOXMELT_LANES M has(V v, int bit) {  // one of the lowest 15
    return M(_mm_cmpgt_epi16(_mm_and_si128(v, set(bit)), _mm_setzero_si128()));
  }
  VOXMELT_LANES V count_four(V v) {
    const __m128i counts = _mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
    return V(_mm_shuffle_epi8(counts, _mm_and_si128(v, _mm_set1_epi16(15))));
  }
  VOXMELT_LANES void dice(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
                          Bytes* dice) {
    const int a = static_cast<int>(blocks[0]), b = static_cast<int>(blocks[1]);
    __m128i y = _mm_add_epi32(_mm_setr_epi32(a, a, b, b), _mm_setr_epi32(0, 1, 0, 1));
    __m128i x = _mm_set1_epi32(static_cast<int>(step));
    const __m128i ror8 = _mm_setr_epi8(1, 2, 3, 0, 5, 6, 7, 4, 9, 10, 11, 8, 13, 14, 15, 12);
    for (int i = 0; i < 10; ++i) {
      x = _mm_xor_si128(_mm_add_epi32(_mm_shuffle_epi8(x, ror8), y),
                        _mm_set1_epi32(static_cast<int>(keys[i])));
      y = _mm_xor_si128(_mm_or_si128(_mm_slli_epi32(y, 3), _mm_srli_epi32(y, 29)), x);
    }
    dice[0] = _mm_unpacklo_epi32(y, x);
    dice[1] = _mm_unpackhi_epi32(y, x);
  }

  // Holds the low and high bytes of the first and of the last 16 of 32 entries.
  struct Table {
    __m128i low[2], high[2];
  };
  VOXMELT_LANES Table table(const std::uint16_t* entries) {
    Table table;
    for (int half = 0; half < 2; ++half) {
      const auto* from = reinterpret_cast<const __m128i*>(entries + 16 * half);
      const __m128i a = _mm_loadu_si128(from), b = _mm_loadu_si128(from + 1), byte = _mm_set1_epi16(0xFF);
      table.low[half] = _mm_packus_epi16(_mm_and_si128(a, byte), _mm_and_si128(b, byte));
      table.high[half] = _mm_packus_epi16(_mm_srli_epi16(a, 8), _mm_srli_epi16(b, 8));
    }
    return table;
  }
  VOXMELT_LANES V lookup(const Table& table, V index) {
    const __m128i at = shift_right<11>(index), last = _mm_cmpgt_epi16(at, _mm_set1_epi16(15));
    // The upper byte of a lane looks up entry 0, which is masked or shifted out.
    const __m128i low =
        _mm_blendv_epi8(_mm_shuffle_epi8(table.low[0], at), _mm_shuffle_epi8(table.low[1], at), last);
    const __m128i high =
        _mm_blendv_epi8(_mm_shuffle_epi8(table.high[0], at), _mm_shuffle_epi8(table.high[1], at), last);
    return V(_mm_or_si128(_mm_and_si128(low, _mm_set1_epi16(0xFF)), _mm_slli_epi16(high, 8)));
  }
};

}  // namespace voxmelt::cpu
