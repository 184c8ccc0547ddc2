// The surface has a unit normal (docs/picture/definition.md, section 8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/sample.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

inline constexpr int kNormalBits = 14;  // fraction bits of a normal
inline constexpr std::int32_t kLength = 1 << kNormalBits;

// Returns floor(sqrt(a)), where a < 2^40.
VOXMELT_RULE std::int64_t square_root(std::int64_t a) {
  std::int64_t root = 0;
  for (std::int64_t bit = std::int64_t{1} << 19; bit > 0; bit >>= 1)
    if ((root + bit) * (root + bit) <= a) root += bit;
  return root;
}

// The table holds 2^15 / sqrt(i / 128) to the nearest integer, for i = 128 .. 512.
inline constexpr int kRootFirst = 128;
inline constexpr auto kInverseRoot = [] {
  std::array<std::int32_t, 385> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto divisor = static_cast<std::int64_t>(i) + kRootFirst;
    table[i] = static_cast<std::int32_t>((square_root((std::int64_t{1} << 39) / divisor) + 1) >> 1);
  }
  return table;
}();

// Returns 2^15 / sqrt(m / 2^30) for 2^30 <= m < 2^32, by a straight line between two entries.
template <class Watch = Silent>
VOXMELT_RULE std::int64_t inverse_root(std::int64_t m, Watch watch = {}) {
  const std::size_t i = (m >> 23) - kRootFirst;
  const std::int64_t root =
      kInverseRoot[i] - rounded((kInverseRoot[i] - kInverseRoot[i + 1]) * (m & 0x7FFFFF), 23);
  watch(Stage::unit, "m", m);
  watch(Stage::unit, "i", m >> 23);
  watch(Stage::unit, "R", std::array{kInverseRoot[i], kInverseRoot[i + 1]});
  watch(Stage::unit, "r", root);
  return root;
}

// Returns a vector of components within 2^15, stretched or shrunk to the length 2^14. The vector 0 stays 0.
template <class Watch = Silent>
VOXMELT_RULE Vector unit(Vector a, Watch watch = {}) {
  watch(Stage::unit, "vector", a);
  if (a == Vector{}) return a;
  a = a * (std::int64_t{1} << (15 - bits_of(largest(a))));
  const std::int64_t square = dot(a, a);  // 2^28 <= square < 2^32
  const int more = square < std::int64_t{1} << 30 ? 1 : 0;
  watch(Stage::unit, "g", a);
  watch(Stage::unit, "q", square);
  watch(Stage::unit, "e", more);
  const std::int64_t scale = inverse_root(square << (2 * more), watch) << more;
  const Vector vector{rounded(a.x * scale, 16), rounded(a.y * scale, 16), rounded(a.z * scale, 16)};
  watch(Stage::unit, "unit", vector);
  return vector;
}

// Holds the cell in which a position lies, along an axis. With it go the weights of the cell and its
// neighbours in a quadratic B-spline. Its blur is the same everywhere. Linear interpolation has none at the
// middle of a cell, which shows as ripples.
struct Spline {
  std::int64_t cell = 0;
  std::array<std::int32_t, 3> value{}, slope{};  // in 256ths; the slope points towards larger positions
};

VOXMELT_RULE Spline spline_of(std::int64_t position) {
  const std::int64_t shifted = position + kCell / (2 * kWeights);
  const std::int32_t u = weight_at(shifted);
  const std::int32_t before = kWeights - u,
                     behind = u;  // 1/2 - f and 1/2 + f, where f is the distance from the middle
  const std::int32_t low = (before * before) >> 9, high = (behind * behind) >> 9;
  return {shifted >> kPositionBits, {low, kWeights - low - high, high}, {-before, before - behind, behind}};
}

// Returns the sum of three numbers with weights, divided by 2^8 or 2^9.
VOXMELT_RULE std::int32_t splined(const std::array<std::int32_t, 3>& values,
                                  const std::array<std::int32_t, 3>& weight, int bits) {
  return (values[0] * weight[0] + values[1] * weight[1] + values[2] * weight[2] + (1 << (bits - 1))) >> bits;
}

template <class Watch>
VOXMELT_RULE void tell_weights(Watch watch, const char* name, const Spline& spline) {
  watch(Stage::normal, name,
        std::array{spline.value[0], spline.value[1], spline.value[2], spline.slope[0], spline.slope[1],
                   spline.slope[2]});
}

// Returns the normal that points out of the matter. It points against the slope of the spline through 27
// levels, along x, then y, then z.
template <class Levels, class Watch = Silent>
VOXMELT_RULE Vector normal_at(const Levels& levels, Vector position, Watch watch = {}) {
  using Three = std::array<std::int32_t, 3>;
  const Spline x = spline_of(position.x), y = spline_of(position.y), z = spline_of(position.z);
  watch(Stage::normal, "position", position);
  watch(Stage::normal, "cell", Vector{x.cell, y.cell, z.cell});
  tell_weights(watch, "weights along x", x);
  tell_weights(watch, "weights along y", y);
  tell_weights(watch, "weights along z", z);
  Three slope_x{}, slope_y{}, value{};
  for (std::size_t k = 0; k < 3; ++k) {
    Three slopes{}, values{};
    for (std::size_t j = 0; j < 3; ++j) {
      Three row{};
      for (std::size_t i = 0; i < 3; ++i) row[i] = levels(x.cell + i - 1, y.cell + j - 1, z.cell + k - 1);
      slopes[j] = splined(row, x.slope, 9);
      values[j] = splined(row, x.value, 8);
      watch(Stage::normal, "along x", std::array{slopes[j], values[j]});
    }
    slope_x[k] = splined(slopes, y.value, 8);
    slope_y[k] = splined(values, y.slope, 9);
    value[k] = splined(values, y.value, 8);
    watch(Stage::normal, "along y", std::array{slope_x[k], slope_y[k], value[k]});
  }
  const Vector slope{splined(slope_x, z.value, 8), splined(slope_y, z.value, 8), splined(value, z.slope, 9)};
  watch(Stage::normal, "slope", slope);
  return unit(Vector{} - slope, watch);
}

}  // namespace voxmelt::picture
