// Number formats of the automaton (docs/automaton.md, "State and formats").
#pragma once

#include <cstdint>

namespace voxmelt::rule {

using Amount = std::uint16_t;       // UQ4.12, 1.0 = kOne; the headroom above 1.0 holds the excess
using Energy = std::uint16_t;       // UQ4.12, never more than the amount of its cell
using Temperature = std::uint16_t;  // 0..65535 spans the scene's range 0..1

inline constexpr std::int32_t kOne = 4096;            // a full cell
inline constexpr std::int32_t kAmountMax = 65535;     // AMAX
inline constexpr std::int32_t kTemperatureMax = 65535;
inline constexpr std::int32_t kBedHalf = 2048;        // amount of an inert cell whose top is its own upper face

}  // namespace voxmelt::rule
