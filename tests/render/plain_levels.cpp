// The level of puddles is smoothed along the surface, column by column, in 64 bits.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "kernel/automaton/rule/fixed_point.h"
#include "tests/render/plain_field.h"

namespace voxmelt::test {
namespace {

using render::kNoLevel;
using render::PuddleLevels;
using rule::kOne;

constexpr std::int32_t kMostShift = kOne / 4;
constexpr std::int32_t kFraction = 16;  // heights are kept to this part of a unit between passes

std::int64_t floor_of(std::int64_t number, std::int64_t divisor) {
  return number >= 0 ? number / divisor : -((-number + divisor - 1) / divisor);
}

// Returns the smoothed share of a difference between neighbours: all up to one cell, nothing from two.
std::int32_t share(std::int32_t difference) {
  return std::clamp(2 * kOne - std::abs(difference) / kFraction, 0, kOne);
}

// Returns the second difference across a column, or 0 if one of the two neighbours holds no puddle.
std::int64_t bend(std::int32_t before, std::int32_t here, std::int32_t after) {
  if (before == kNoLevel || after == kNoLevel) return 0;
  const std::int32_t down = before - here, up = after - here;
  return floor_of((std::int64_t{down} + up) * std::min(share(down), share(up)), kOne);
}

}  // namespace

std::vector<std::int32_t> plain_level_shifts(const PuddleLevels& levels, int passes) {
  std::vector<std::int32_t> now = levels.level;
  for (std::int32_t& level : now)
    if (level != kNoLevel) level *= kFraction;
  std::vector<std::int32_t> next = now;
  const auto index = [&](int x, int z) {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(levels.x) + static_cast<std::size_t>(x);
  };
  for (int pass = 0; pass < passes; ++pass) {
    const auto at = [&](int x, int z) {
      return x < 0 || z < 0 || x >= levels.x || z >= levels.z ? kNoLevel : now[index(x, z)];
    };
    for (int z = 0; z < levels.z; ++z)
      for (int x = 0; x < levels.x; ++x) {
        const std::int32_t here = now[index(x, z)];
        if (here == kNoLevel) continue;
        // If all neighbours count, this is the 3x3 binomial filter.
        const std::int64_t straight =
            bend(at(x - 1, z), here, at(x + 1, z)) + bend(at(x, z - 1), here, at(x, z + 1));
        const std::int64_t diagonal =
            bend(at(x - 1, z - 1), here, at(x + 1, z + 1)) + bend(at(x - 1, z + 1), here, at(x + 1, z - 1));
        next[index(x, z)] = here + static_cast<std::int32_t>(floor_of(2 * straight + diagonal, 16));
      }
    now.swap(next);
  }
  std::vector<std::int32_t> shifts(now.size(), 0);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (levels.level[i] == kNoLevel) continue;
    const std::int32_t most = std::min(kMostShift, levels.depth[i] / 2);
    shifts[i] = std::clamp(now[i] / kFraction - levels.level[i], -most, most);
  }
  return shifts;
}

}  // namespace voxmelt::test
