// Lanes<avx512bw> has 32 lanes. Masks are in mask registers.
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "kernel/engine/cpu/lanes.h"

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
  VOXMELT_LANES V mean(V a, V b) { return V(_mm512_avg_epu16(a, b)); }
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

  using Bytes = __m512i;
  using Twin = std::uint64_t;
  VOXMELT_LANES Bytes load_bytes(const std::uint8_t* at) { return _mm512_loadu_si512(at); }
  VOXMELT_LANES void store_bytes(std::uint8_t* at, Bytes b) { _mm512_storeu_si512(at, b); }
  VOXMELT_LANES Bytes none() { return _mm512_setzero_si512(); }
  VOXMELT_LANES Bytes bytes(int value) { return _mm512_set1_epi8(static_cast<char>(value)); }
  using Where = __mmask64;
  VOXMELT_LANES Where not_less(V a0, V b0, V a1, V b1) {
    return _mm512_kunpackd(_mm512_cmpge_epu16_mask(a1, b1), _mm512_cmpge_epu16_mask(a0, b0));
  }
  VOXMELT_LANES Where where(Twin bits) { return bits; }
  VOXMELT_LANES Bytes push(Bytes b, Where where, int bit) {
    return _mm512_mask_add_epi8(b, where, b, bytes(1 << bit));
  }
  VOXMELT_LANES Bytes fill(Bytes b, Where where) { return _mm512_mask_mov_epi8(b, where, bytes(0xFF)); }
  VOXMELT_LANES Bytes in_order(Bytes b) { return b; }
  VOXMELT_LANES Bytes both(Bytes a, Bytes b) { return _mm512_and_si512(a, b); }
  VOXMELT_LANES Bytes without(Bytes a, Bytes b) { return _mm512_andnot_si512(b, a); }
  VOXMELT_LANES Twin nonzero_bytes(Bytes b) { return _mm512_test_epi8_mask(b, b); }
  VOXMELT_LANES Twin filled(V a, V b) {
    return Twin{_mm512_test_epi16_mask(b, b)} << 32 | _mm512_test_epi16_mask(a, a);
  }
  VOXMELT_LANES V widen_bytes(const std::uint8_t* at) {
    return V(_mm512_cvtepu8_epi16(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(at))));
  }
  // Beside a whole line of the cache, every vector lies across two lines. So aligned vectors are put
  // together.
  template <int dx>
  VOXMELT_LANES V load_beside(const std::uint16_t* at) {
    if constexpr (dx == 0) return load(at);
    // Lane i comes from lane i + dx. Indices from 32 on mean lanes of the other vector.
    const __m512i right = _mm512_setr_epi32(
        0x00020001, 0x00040003, 0x00060005, 0x00080007, 0x000A0009, 0x000C000B, 0x000E000D, 0x0010000F,
        0x00120011, 0x00140013, 0x00160015, 0x00180017, 0x001A0019, 0x001C001B, 0x001E001D, 0x0020001F);
    const __m512i left = _mm512_setr_epi32(
        0x0000003F, 0x00020001, 0x00040003, 0x00060005, 0x00080007, 0x000A0009, 0x000C000B, 0x000E000D,
        0x0010000F, 0x00120011, 0x00140013, 0x00160015, 0x00180017, 0x001A0019, 0x001C001B, 0x001E001D);
    return V(_mm512_permutex2var_epi16(load(at), dx > 0 ? right : left, load(at + 32 * dx)));
  }
  template <int dx>
  VOXMELT_LANES V widen_beside(const std::uint8_t* at) {
    const auto half = [](const std::uint8_t* from) VOXMELT_LAMBDA {
      return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
    };
    const __m256i own = half(at);
    if constexpr (dx == 0) return V(_mm512_cvtepu8_epi16(own));
    const __m256i other = half(at + 32 * dx);
    const __m256i middle =
        dx > 0 ? _mm256_permute2x128_si256(own, other, 0x21) : _mm256_permute2x128_si256(other, own, 0x21);
    return V(_mm512_cvtepu8_epi16(dx > 0 ? _mm256_alignr_epi8(middle, own, 1)
                                         : _mm256_alignr_epi8(own, middle, 15)));
  }
  VOXMELT_LANES M has(V v, int bits) {
    return M(_mm512_test_epi16_mask(v, _mm512_set1_epi16(static_cast<short>(bits))));
  }
  VOXMELT_LANES V count_four(V v) {
    const __m512i counts =
        _mm512_broadcast_i32x4(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
    return V(_mm512_shuffle_epi8(counts, _mm512_and_si512(v, _mm512_set1_epi16(15))));
  }
  VOXMELT_LANES void dice(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
                          Bytes* dice) {
    // The blocks are in the order in which unpacking leaves the bytes of a pair in one vector.
    const __m512i first = _mm512_mask_set1_epi32(_mm512_set1_epi32(static_cast<int>(blocks[0])), 0xCCCC,
                                                 static_cast<int>(blocks[1]));
    __m512i y = _mm512_add_epi32(first, _mm512_setr_epi32(0, 1, 0, 1, 2, 3, 2, 3, 4, 5, 4, 5, 6, 7, 6, 7));
    __m512i x = _mm512_set1_epi32(static_cast<int>(step));
    for (int i = 0; i < 10; ++i) {
      x = _mm512_xor_si512(_mm512_add_epi32(_mm512_ror_epi32(x, 8), y),
                           _mm512_set1_epi32(static_cast<int>(keys[i])));
      y = _mm512_xor_si512(_mm512_rol_epi32(y, 3), x);
    }
    dice[0] = _mm512_unpacklo_epi32(y, x);
    dice[1] = _mm512_unpackhi_epi32(y, x);
  }

  using Table = __m512i;
  VOXMELT_LANES Table table(const std::uint16_t* entries) { return _mm512_loadu_si512(entries); }
  VOXMELT_LANES V lookup(const Table& table, V index) {
    return V(_mm512_permutexvar_epi16(shift_right<11>(index), table));
  }

 private:
  VOXMELT_LANES __mmask32 bits(M m) { return static_cast<__mmask32>(m); }
};

}  // namespace voxmelt::cpu
