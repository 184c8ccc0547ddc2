// A ray may leave out samples: to the box of what is occupied, through empty blocks, and where the field
// cannot rise to the surface so fast. It never leaves out one too many, and one too few costs a cycle.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "hwmodel/caster/model/arithmetic.h"
#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/ray.h"
#include "hwmodel/caster/model/registers.h"

namespace voxmelt::hwmodel::raycast {

inline constexpr int kBlockBits = 22;  // bits of a position in a block of four places
inline constexpr std::int64_t kMostSamples = (std::int64_t{1} << 27) - 1;  // samples of a ray

struct Walker {
  Vec at, step;  // in the lattice
  Inverse x, y, z;
};
inline Walker walker_of(const Ray& ray) {
  return {to_lattice(ray.start), ray.step, inverse_of(ray.step.x), inverse_of(ray.step.y),
          inverse_of(ray.step.z)};
}

// Counts samples until the box low <= position < high. It is 0 within the box, and nothing if the ray misses
// it.
inline std::optional<std::int64_t> steps_to_box(const Walker& walker, Vec low, Vec high) {
  std::int64_t steps = 0;
  bool misses = false;
  const auto axis = [&](std::int64_t q, std::int64_t step, Inverse inverse, std::int64_t from,
                        std::int64_t to) {
    if (q < from) {
      misses |= step <= 0;
      steps = std::max(steps, steps_in(from - q - 1, inverse) + 1);
    } else if (q >= to) {
      misses |= step >= 0;
      steps = std::max(steps, steps_in(q - to, inverse) + 1);
    }
  };
  axis(walker.at.x, walker.step.x, walker.x, low.x, high.x);
  axis(walker.at.y, walker.step.y, walker.y, low.y, high.y);
  axis(walker.at.z, walker.step.z, walker.z, low.z, high.z);
  if (misses) return std::nullopt;
  return std::min(steps, kMostSamples);
}

// Counts samples until the ray leaves the blocks that are less than `reach` blocks away.
inline std::int64_t steps_out(const Walker& walker, std::int64_t reach) {
  constexpr std::int64_t kMask = (std::int64_t{1} << kBlockBits) - 1;
  const auto axis = [&](std::int64_t q, std::int64_t step, Inverse inverse) {
    if (step == 0) return std::int64_t{1} << 26;
    const std::int64_t in = q & kMask;
    const std::int64_t way = step > 0 ? (reach << kBlockBits) - in - 1 : ((reach - 1) << kBlockBits) + in;
    return steps_in(way, inverse) + 1;
  };
  return std::min(
      axis(walker.at.x, walker.step.x, walker.x),
      std::min(axis(walker.at.y, walker.step.y, walker.y), axis(walker.at.z, walker.step.z, walker.z)));
}

// Tabulates 2^20 / (3 slope), rounded down: a memory of 256 words.
inline constexpr auto kRises = [] {
  std::array<std::uint32_t, 256> values{};
  for (std::uint32_t slope = 1; slope < 256; ++slope) values[slope] = (1u << 20) / (3 * slope);
  values[0] = (1u << 20) - 1;
  return values;
}();
// Counts samples until the level may reach 0, if it rises by no more than 768 slope per cell. Weights are
// rounded to 1/256 cell, which moves a level by 768 / 512 slope at either end. Blends err by 3/2 each.
inline std::int64_t steps_to_rise(std::int64_t level, std::int64_t slope, int spacing) {
  const std::int64_t margin = -level - 4 - 3 * slope;
  if (margin <= 0) return 1;
  return ((margin * kRises[slope]) >> (28 - spacing)) + 1;
}

}  // namespace voxmelt::hwmodel::raycast
