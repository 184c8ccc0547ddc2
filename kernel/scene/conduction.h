// Conductivities of a scene file become weights of pairs of cells (Eq. 1).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace voxmelt::scene {

inline constexpr double kLargestGamma =
    0.5236;                             // pi / 6: weight_face <= 10922, and conduction cannot overshoot
inline constexpr double kGamma = 0.15;  // unless the scene says it

// Returns the weight of Eq. 1, gamma / (pi l^2), for a neighbour at distance l.
inline std::uint16_t conduction_weight(double gamma, double squared_distance) {
  return static_cast<std::uint16_t>(std::floor(65536 * gamma / (std::numbers::pi * squared_distance)));
}

// Returns what conducts through half a cell, from its surface to its centre. On a plane, four edges and four
// corners lead through each face.
inline double half_cell(std::uint16_t face, std::uint16_t edge, std::uint16_t corner) {
  return 2 * (face + 4 * (edge + corner)) / 65536.0;
}

// Returns an exchange and half a cell one behind the other. If nothing conducts, a cell has one temperature.
inline double behind_half_cell(double exchange, double half) {
  return half > 0 ? exchange / (1 + exchange / half) : exchange;
}

}  // namespace voxmelt::scene
