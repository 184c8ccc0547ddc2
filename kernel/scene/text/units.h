// The units of a scene file become those of the automaton. The readers have checked the ranges before.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/scene/text/range.h"

namespace voxmelt::scene {

inline constexpr double kLargestAmount = 15;         // a cell's excess must fit UQ4.12
inline constexpr double kLargestCoordinate = 65536;  // for sources, vents and shapes, in cells
inline constexpr double kFullTurn = 360;             // degrees

inline Range coordinate() { return within(kLargestCoordinate); }
inline Range fraction() { return at_most(1); }  // for a temperature range, an amount or a colour

inline rule::Temperature to_temperature(double t) {
  return static_cast<rule::Temperature>(std::lround(t * rule::kTemperatureMax));
}
// Tells if a sum of temperatures exceeds the range by half a unit, which its decimals do not.
inline bool exceeds_range(double t) { return t > 1 + 0.5 / rule::kTemperatureMax; }
inline rule::Amount to_amount(double a) { return static_cast<rule::Amount>(std::lround(a * rule::kOne)); }

// Converts factors 0..1 to 1/65536. 1 itself is one unit less if 16 bits must hold it.
inline std::uint16_t to_factor16(double f) {
  return static_cast<std::uint16_t>(std::min<long>(65535, std::lround(f * 65536)));
}
inline std::uint32_t to_factor32(double f) { return static_cast<std::uint32_t>(std::llround(f * 65536)); }

// Is the automaton's unit of power. Scenes have temperature per step times squared cells. Inside it is 1/16
// temperature unit x (1/16 cell)^2.
inline constexpr double kPowerUnit = 65536.0 * 16 * 256;
inline std::uint64_t to_power(double value) { return std::llround(value * kPowerUnit); }
inline double from_power(std::uint64_t power) { return static_cast<double>(power) / kPowerUnit; }

inline std::int64_t to_position(double cells) { return std::llround(cells * rule::kPositionUnit); }
inline rule::Position to_position(const std::array<double, 3>& at) {
  return {to_position(at[0]), to_position(at[1]), to_position(at[2])};
}

// Converts a direction of any length but 0. Its longest component becomes 32768, so a direction that was
// rounded stays as it is.
inline constexpr double kDirectionUnit = 32768;
inline rule::Position to_direction(const std::array<double, 3>& d) {
  const double longest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  const auto part = [&](double v) { return std::llround(v / longest * kDirectionUnit); };
  return {part(d[0]), part(d[1]), part(d[2])};
}

}  // namespace voxmelt::scene
