// The twin computes in these number formats and roundings. Each is a set of functions that the rules call in
// place of operators, so that there is one text of the rules for all.
//
// A whole format of b bits holds what the state of 16 bits holds, cut at another bit. A full cell is 2^(b-4),
// and the top of the range of heat is 2^b - 1. A real format counts in units of the 16-bit state, and rounds
// nothing but what its own arithmetic rounds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace voxmelt::accuracy::front {

// A rounding takes the place of each dither in docs/automaton.md.
enum class Rounding { truncate, nearest, dithered };

template <class Stored, Rounding kRounding>
struct Whole {
  __extension__ using Widest = unsigned __int128;
  using Value = Stored;
  using Wide = std::int64_t;                                                       // sums and differences
  using Product = std::conditional_t<sizeof(Stored) == 4, Widest, std::uint64_t>;  // sums of amount x heat

  static constexpr int kBits = 8 * sizeof(Stored);
  static constexpr Wide kMost = std::numeric_limits<Stored>::max();
  static constexpr Wide kOne = Wide{1} << (kBits - 4);

  // Converts a number of the 16-bit state to the nearest of this format. A number above 0 stays at least one
  // unit.
  static Wide of(std::int64_t units) {
    if constexpr (kBits >= 16) {
      return units << (kBits - 16);
    } else {
      const Wide nearest = (units + (std::int64_t{1} << (15 - kBits))) >> (16 - kBits);
      return std::clamp<Wide>(nearest, units > 0 ? 1 : 0, kMost);
    }
  }
  static double in_units(Wide value) {
    constexpr double kUnit = static_cast<double>(std::uint64_t{1} << kBits) / 65536;
    return static_cast<double>(value) / kUnit;
  }

  static std::int64_t offset(std::int64_t dither) {
    return kRounding == Rounding::truncate ? 0 : kRounding == Rounding::nearest ? 32768 : dither;
  }
  // Gives a x fraction / 65536, rounded down or as the format rounds. If truncated, it is rounded towards 0:
  // rounded down, a cell would lose by every face at once.
  static Wide part(Wide a, std::int64_t fraction) { return (a * fraction) >> 16; }
  static Wide part(Wide a, std::int64_t fraction, std::int64_t dither) {
    if (kRounding == Rounding::truncate && a < 0) return -((-a * fraction) >> 16);
    return (a * fraction + offset(dither)) >> 16;
  }
  // Converts an irradiance, which counts in 1/16 unit of the 16-bit state.
  static Wide radiated(std::int64_t irradiance, std::int64_t dither) {
    constexpr int down = 20 - kBits;  // right shift from that unit to this format's, below 0 for 32 bits
    if constexpr (down <= 0)
      return irradiance << -down;
    else
      return ((irradiance << (16 - down)) + offset(dither)) >> 16;
  }
  static Wide quarter(Wide a) { return a >> 2; }
  static Wide nine_eighths(Wide a) { return (9 * a) >> 3; }
  static Wide times(Wide flow, Wide energy) {  // `energy` is per full cell
    return (flow * energy) >> (kBits - 4);
  }
  static Wide mixed(Product content, Wide amount, std::int64_t dither) {
    const auto whole = static_cast<Product>(amount);
    return static_cast<Wide>((content + ((whole * static_cast<Product>(offset(dither))) >> 16)) / whole);
  }
  static std::size_t band(Wide heat) { return heat >> (kBits - 5); }  // 0..31
};

template <class Number>
struct Real {
  using Value = Number;
  using Wide = Number;
  using Product = Number;

  static constexpr int kBits = 8 * sizeof(Number);
  static constexpr Wide kMost = 65535;
  static constexpr Wide kOne = 4096;

  static Wide of(std::int64_t units) { return static_cast<Wide>(units); }
  static double in_units(Wide value) { return value; }

  static Wide part(Wide a, std::int64_t fraction, std::int64_t /*dither*/ = 0) {
    return a * (static_cast<Wide>(fraction) / 65536);
  }
  static Wide radiated(std::int64_t irradiance, std::int64_t /*dither*/) {
    return static_cast<Wide>(irradiance) / 16;
  }
  static Wide quarter(Wide a) { return a / 4; }
  static Wide nine_eighths(Wide a) { return 9 * a / 8; }
  static Wide times(Wide flow, Wide energy) { return flow * energy / kOne; }
  static Wide mixed(Product content, Wide amount, std::int64_t /*dither*/) { return content / amount; }
  static std::size_t band(Wide heat) {
    return static_cast<std::size_t>(std::clamp(heat / 2048, Wide{0}, Wide{31}));
  }
};

}  // namespace voxmelt::accuracy::front
