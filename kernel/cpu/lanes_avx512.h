// Lanes<avx512bw>: 32 lanes, masks in mask registers.
#pragma once

#include <immintrin.h>

#include "kernel/cpu/lanes.h"

namespace voxmelt::cpu {

template <>
struct Lanes<xsimd::avx512bw> : LanesOf<xsimd::avx512bw> {
  VOXMELT_LANES V high(V a, V b) { return V(_mm512_mulhi_epu16(a, b)); }
  template <int n>
  VOXMELT_LANES V shift_right(V a) {
    return V(_mm512_srli_epi16(a, n));
  }
  template <int n>
  VOXMELT_LANES V shift_left(V a) {
    return V(_mm512_slli_epi16(a, n));
  }

  VOXMELT_LANES M less(V a, V b) { return M(_mm512_cmplt_epu16_mask(a, b)); }
  VOXMELT_LANES M from_bits(std::uint64_t word, int part) {
    return M(static_cast<__mmask32>(word >> (32 * part)));
  }
  VOXMELT_LANES std::uint64_t to_bits(M m) { return bits(m); }
  VOXMELT_LANES bool nonzero(V v) { return _mm512_test_epi64_mask(v, v) != 0; }
  VOXMELT_LANES V keep(M m, V v) { return V(_mm512_maskz_mov_epi16(bits(m), v)); }
  VOXMELT_LANES V add_if(M m, V a, V b) { return V(_mm512_mask_add_epi16(a, bits(m), a, b)); }
  VOXMELT_LANES V sub_if(M m, V a, V b) { return V(_mm512_mask_sub_epi16(a, bits(m), a, b)); }
  VOXMELT_LANES V carry(V a, V low, V most) { return add_if(less(most, low), a, set(1)); }

  VOXMELT_LANES Wide unpack(V low, V high) {
    return {W(_mm512_unpacklo_epi16(low, high)), W(_mm512_unpackhi_epi16(low, high))};
  }
  VOXMELT_LANES V narrow(Wide w) { return V(_mm512_packus_epi32(w.low, w.high)); }
  VOXMELT_LANES Wide pair_product(V f0, V h0, V f1, V h1) {
    return {W(_mm512_madd_epi16(_mm512_unpacklo_epi16(f0, f1), _mm512_unpacklo_epi16(h0, h1))),
            W(_mm512_madd_epi16(_mm512_unpackhi_epi16(f0, f1), _mm512_unpackhi_epi16(h0, h1)))};
  }
  VOXMELT_LANES V after(V previous, V current) {
    const __m512i middle = _mm512_alignr_epi64(current, previous, 6);
    return V(_mm512_alignr_epi8(current, middle, 14));
  }
  VOXMELT_LANES W pair_sums(V a, V b) { return W(_mm512_madd_epi16(a, b)); }

  using Bits = std::uint32_t;
  VOXMELT_LANES void dice(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
                          Bits (*planes)[4]) {
    __m512i y = _mm512_add_epi32(
        _mm512_permutexvar_epi32(
            _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3),
            _mm512_castsi128_si512(_mm_loadu_si128(reinterpret_cast<const __m128i*>(blocks)))),
        _mm512_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3));
    __m512i x = _mm512_set1_epi32(static_cast<int>(step));
    for (int i = 0; i < 10; ++i) {
      x = _mm512_xor_si512(_mm512_add_epi32(_mm512_ror_epi32(x, 8), y),
                           _mm512_set1_epi32(static_cast<int>(keys[i])));
      y = _mm512_xor_si512(_mm512_rol_epi32(y, 3), x);
    }
    // Bytes of cells 0..15 of each item, and of cells 16..31; then of items 0 and 1, and of items 2 and 3.
    const __m512i first = _mm512_unpacklo_epi32(y, x), second = _mm512_unpackhi_epi32(y, x);
    const __m512i front =
        _mm512_permutex2var_epi64(first, _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11), second);
    const __m512i back =
        _mm512_permutex2var_epi64(first, _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15), second);
    for (int b = 0; b < 8; ++b) {
      const __m512i bit = _mm512_set1_epi8(static_cast<char>(1 << b));
      const std::uint64_t pairs[2] = {_mm512_test_epi8_mask(front, bit), _mm512_test_epi8_mask(back, bit)};
      __builtin_memcpy(planes[b], pairs, sizeof pairs);
    }
  }

  // table[index >> 11]: 32 entries.
  VOXMELT_LANES V lookup(const std::uint16_t* table, V index) {
    return V(_mm512_permutexvar_epi16(shift_right<11>(index), _mm512_loadu_si512(table)));
  }

 private:
  VOXMELT_LANES __mmask32 bits(M m) { return static_cast<__mmask32>(m); }
};

}  // namespace voxmelt::cpu
