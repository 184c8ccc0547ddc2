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
  VOXMELT_LANES V keep(M m, V v) { return V(_mm512_maskz_mov_epi16(bits(m), v)); }
  VOXMELT_LANES V add_if(M m, V a, V b) { return V(_mm512_mask_add_epi16(a, bits(m), a, b)); }

  VOXMELT_LANES Wide unpack(V low, V high) {
    return {W(_mm512_unpacklo_epi16(low, high)), W(_mm512_unpackhi_epi16(low, high))};
  }
  VOXMELT_LANES V narrow(Wide w) { return V(_mm512_packus_epi32(w.low, w.high)); }
  VOXMELT_LANES Wide pair_product(V f0, V h0, V f1, V h1) {
    return {W(_mm512_madd_epi16(_mm512_unpacklo_epi16(f0, f1), _mm512_unpacklo_epi16(h0, h1))),
            W(_mm512_madd_epi16(_mm512_unpackhi_epi16(f0, f1), _mm512_unpackhi_epi16(h0, h1)))};
  }

  VOXMELT_LANES void random_planes(const std::uint32_t* keys, std::uint32_t step, std::uint32_t block,
                                   std::uint64_t* planes) {
    // Lanes in the order in which unpacking puts them back along x.
    __m256i y = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(block)),
                                 _mm256_setr_epi32(0, 1, 4, 5, 2, 3, 6, 7));
    __m256i x = _mm256_set1_epi32(static_cast<int>(step));
    for (int i = 0; i < 10; ++i) {
      x = _mm256_xor_si256(_mm256_add_epi32(_mm256_ror_epi32(x, 8), y),
                           _mm256_set1_epi32(static_cast<int>(keys[i])));
      y = _mm256_xor_si256(_mm256_rol_epi32(y, 3), x);
    }
    const __m512i bytes = _mm512_inserti64x4(_mm512_castsi256_si512(_mm256_unpacklo_epi32(y, x)),
                                             _mm256_unpackhi_epi32(y, x), 1);
    for (int b = 0; b < 8; ++b)
      planes[b] = _mm512_test_epi8_mask(bytes, _mm512_set1_epi8(static_cast<char>(1 << b)));
  }

 private:
  VOXMELT_LANES __mmask32 bits(M m) { return static_cast<__mmask32>(m); }
};

}  // namespace voxmelt::cpu
