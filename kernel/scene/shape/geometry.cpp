#include "kernel/scene/shape/geometry.h"

#include <numbers>

namespace voxmelt::scene {
namespace {

// Returns cos and sin with exact quarter turns. So a box turned by 90 degrees is still a box of whole cells.
std::array<double, 2> cos_sin(double degrees) {
  const double quarter = degrees / 90;
  if (quarter == std::floor(quarter)) {
    const int turn = static_cast<int>(std::fmod(std::fmod(quarter, 4) + 4, 4));
    constexpr std::array<std::array<double, 2>, 4> exact{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    return exact[turn];
  }
  const double radians = degrees * std::numbers::pi / 180;
  return {std::cos(radians), std::sin(radians)};
}

}  // namespace

Rotation::Rotation(const std::array<double, 3>& degrees) {
  const auto [cx, sx] = cos_sin(degrees[0]);
  const auto [cy, sy] = cos_sin(degrees[1]);
  const auto [cz, sz] = cos_sin(degrees[2]);
  rows_[0] = {cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx};
  rows_[1] = {sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx};
  rows_[2] = {-sy, cy * sx, cy * cx};
}

}  // namespace voxmelt::scene
