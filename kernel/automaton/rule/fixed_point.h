// The automaton computes with these number formats and roundings (docs/automaton.md, sections 1 and 2).
#pragma once

#include <cstdint>

// Rule functions are always inlined. Otherwise the linker might take the copy that was compiled for one
// instruction set in place of another's.
#define VOXMELT_RULE [[gnu::always_inline]] inline constexpr

namespace voxmelt::rule {

using Amount = std::uint16_t;       // UQ4.12, 1.0 = kOne; the headroom above 1.0 holds the excess
using Energy = std::uint16_t;       // UQ4.12, never more than the amount of its cell
using Temperature = std::uint16_t;  // 0..65535 spans the scene's range 0..1

inline constexpr std::int32_t kOne = 4096;  // a full cell
inline constexpr std::int32_t kAmountMax = 65535;
inline constexpr std::int32_t kTemperatureMax = 65535;
inline constexpr std::int32_t kBedHalf = 2048;  // amount of an inert cell whose top is its own upper face

// Returns floor((a x fraction + dither) / 65536). a may be negative: the shift rounds towards minus infinity.
VOXMELT_RULE std::int32_t scaled(std::int32_t a, std::int32_t fraction, std::int32_t dither = 0) {
  return static_cast<std::int32_t>((static_cast<std::int64_t>(a) * fraction + dither) >> 16);
}

// Returns the dither of a step: its low 16 bits in reverse order, shifted by `part` of `parts` of the period.
// Any run of steps then samples 0..65535 evenly, and no state is needed.
VOXMELT_RULE std::int32_t dither(std::uint32_t step, int part = 0, int parts = 1) {
  std::uint32_t r = step & 0xFFFFu;
  r = ((r & 0x5555u) << 1) | ((r >> 1) & 0x5555u);
  r = ((r & 0x3333u) << 2) | ((r >> 2) & 0x3333u);
  r = ((r & 0x0F0Fu) << 4) | ((r >> 4) & 0x0F0Fu);
  r = ((r & 0x00FFu) << 8) | ((r >> 8) & 0x00FFu);
  return (r + 65536u * part / parts) & 0xFFFFu;
}

}  // namespace voxmelt::rule
