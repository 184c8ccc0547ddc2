// Lanes<neon64> has 8 lanes, and a mask is a vector of ones and zeros. It runs on every 64-bit ARM processor.
#pragma once

#include <arm_neon.h>

#include <cstdint>

#include "kernel/engine/cpu/lanes.h"

namespace voxmelt::cpu {

template <>
struct Lanes<xsimd::neon64> : LanesOf<xsimd::neon64> {
  VOXMELT_LANES V high(V a, V b) {
    const uint32x4_t front = vmull_u16(vget_low_u16(a), vget_low_u16(b)), back = vmull_high_u16(a, b);
    return V(vuzp2q_u16(vreinterpretq_u16_u32(front), vreinterpretq_u16_u32(back)));
  }
  template <int n>
  VOXMELT_LANES V shift_right(V a) {
    return V(vshrq_n_u16(a, n));
  }
  template <int n>
  VOXMELT_LANES V shift_left(V a) {
    return V(vshlq_n_u16(a, n));
  }

  VOXMELT_LANES M less(V a, V b) { return M(vcltq_u16(a, b)); }
  VOXMELT_LANES M from_bits(std::uint64_t word, int part) {
    return M(vtstq_u16(vdupq_n_u16(static_cast<std::uint16_t>(word >> (8 * part))), bit_of_lane()));
  }
  VOXMELT_LANES std::uint64_t to_bits(M m) { return vaddvq_u16(vandq_u16(m, bit_of_lane())); }
  VOXMELT_LANES bool nonzero(V v) { return vmaxvq_u32(vreinterpretq_u32_u16(v)) != 0; }
  VOXMELT_LANES V mean(V a, V b) { return V(vrhaddq_u16(a, b)); }
  VOXMELT_LANES V keep(M m, V v) { return V(vandq_u16(m, v)); }
  VOXMELT_LANES V add_if(M m, V a, V b) { return a + keep(m, b); }
  VOXMELT_LANES V sub_if(M m, V a, V b) { return a - keep(m, b); }
  VOXMELT_LANES V carry(V a, V low, V most) { return V(vsubq_u16(a, vcgtq_u16(low, most))); }

  // The low half has the first four lanes, the high half the last four.
  VOXMELT_LANES Wide unpack(V low, V high) {
    return {wide(vreinterpretq_s32_u16(vzip1q_u16(low, high))),
            wide(vreinterpretq_s32_u16(vzip2q_u16(low, high)))};
  }
  VOXMELT_LANES V narrow(Wide w) { return V(vqmovun_high_s32(vqmovun_s32(w.low), w.high)); }
  VOXMELT_LANES Wide pair_product(V f0, V h0, V f1, V h1) {
    const int16x8_t a = number(f0), b = number(h0), c = number(f1), d = number(h1);
    return {wide(vmlal_s16(vmull_s16(vget_low_s16(a), vget_low_s16(b)), vget_low_s16(c), vget_low_s16(d))),
            wide(vmlal_high_s16(vmull_high_s16(a, b), c, d))};
  }
  VOXMELT_LANES V after(V previous, V current) { return V(vextq_u16(previous, current, 7)); }
  VOXMELT_LANES W pair_sums(V a, V b) {
    const int16x8_t x = number(a), y = number(b);
    return wide(vpaddq_s32(vmull_s16(vget_low_s16(x), vget_low_s16(y)), vmull_high_s16(x, y)));
  }

  using Bytes = uint8x16_t;
  using Twin = std::uint16_t;
  VOXMELT_LANES Bytes load_bytes(const std::uint8_t* at) { return vld1q_u8(at); }
  VOXMELT_LANES void store_bytes(std::uint8_t* at, Bytes b) { vst1q_u8(at, b); }
  VOXMELT_LANES Bytes none() { return vdupq_n_u8(0); }
  VOXMELT_LANES Bytes bytes(int value) { return vdupq_n_u8(static_cast<std::uint8_t>(value)); }
  using Where = uint8x16_t;
  VOXMELT_LANES Where not_less(V a0, V b0, V a1, V b1) {
    return vcombine_u8(vmovn_u16(vcgeq_u16(a0, b0)), vmovn_u16(vcgeq_u16(a1, b1)));
  }
  VOXMELT_LANES Bytes push(Bytes b, Where where, int /*bit*/) { return vsubq_u8(vaddq_u8(b, b), where); }
  VOXMELT_LANES Bytes fill(Bytes b, Where where) { return vorrq_u8(b, where); }
  VOXMELT_LANES Bytes in_order(Bytes b) { return b; }
  VOXMELT_LANES Where where(Twin bits) {
    return vtstq_u8(vcombine_u8(vdup_n_u8(static_cast<std::uint8_t>(bits)),
                                vdup_n_u8(static_cast<std::uint8_t>(bits >> 8))),
                    bit_of_byte());
  }
  VOXMELT_LANES Bytes both(Bytes a, Bytes b) { return vandq_u8(a, b); }
  VOXMELT_LANES Bytes without(Bytes a, Bytes b) { return vbicq_u8(a, b); }
  VOXMELT_LANES Twin nonzero_bytes(Bytes b) {
    const uint8x16_t set = vandq_u8(vtstq_u8(b, b), bit_of_byte());
    return static_cast<Twin>(vaddv_u8(vget_low_u8(set)) | vaddv_u8(vget_high_u8(set)) << 8);
  }
  VOXMELT_LANES Twin filled(V a, V b) {
    return nonzero_bytes(vcombine_u8(vmovn_u16(vtstq_u16(a, a)), vmovn_u16(vtstq_u16(b, b))));
  }
  VOXMELT_LANES V widen_bytes(const std::uint8_t* at) { return V(vmovl_u8(vld1_u8(at))); }
  VOXMELT_LANES M has(V v, int bits) {
    return M(vtstq_u16(v, vdupq_n_u16(static_cast<std::uint16_t>(bits))));
  }
  VOXMELT_LANES V count_four(V v) {
    return V(vreinterpretq_u16_u8(vcntq_u8(vreinterpretq_u8_u16(vandq_u16(v, vdupq_n_u16(15))))));
  }
  VOXMELT_LANES void dice(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
                          Bytes* dice) {
    uint32x4_t y{blocks[0], blocks[0] + 1, blocks[1], blocks[1] + 1}, x = vdupq_n_u32(step);
    for (int i = 0; i < 10; ++i) {
      const uint32x4_t right8 = vsriq_n_u32(vshlq_n_u32(x, 24), x, 8);
      x = veorq_u32(vaddq_u32(right8, y), vdupq_n_u32(keys[i]));
      y = veorq_u32(vsriq_n_u32(vshlq_n_u32(y, 3), y, 29), x);
    }
    dice[0] = vreinterpretq_u8_u32(vzip1q_u32(y, x));
    dice[1] = vreinterpretq_u8_u32(vzip2q_u32(y, x));
  }

  using Table = uint8x16x4_t;  // 32 entries, 64 bytes
  VOXMELT_LANES Table table(const std::uint16_t* entries) {
    return vld1q_u8_x4(reinterpret_cast<const std::uint8_t*>(entries));
  }
  VOXMELT_LANES V lookup(const Table& table, V index) {
    const uint16x8_t both = vmlaq_n_u16(vdupq_n_u16(0x0100), shift_right<11>(index), 0x0202);
    return V(vreinterpretq_u16_u8(vqtbl4q_u8(table, vreinterpretq_u8_u16(both))));
  }

 private:
  VOXMELT_LANES uint8x16_t bit_of_byte() { return vreinterpretq_u8_u64(vdupq_n_u64(0x8040201008040201u)); }
  VOXMELT_LANES uint16x8_t bit_of_lane() { return uint16x8_t{1, 2, 4, 8, 16, 32, 64, 128}; }
  VOXMELT_LANES int16x8_t number(V v) { return vreinterpretq_s16_u16(v); }
  VOXMELT_LANES W wide(int32x4_t lanes) { return W(lanes); }
};

}  // namespace voxmelt::cpu
