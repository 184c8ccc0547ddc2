// Bounds of heights and slopes in blocks of cells tell of the ground without its columns, on the chip. By
// them the search leaves out samples that lie above all that a block holds, or above all that its slopes can
// reach. It never leaves out one too many, and one too few costs a cycle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hwmodel/caster/model/arithmetic.h"
#include "hwmodel/caster/model/ray.h"
#include "hwmodel/caster/model/registers.h"

namespace voxmelt::hwmodel::raycast {

// Makes blocks from the heights of nx x nz columns. The places of a block read its columns and those beside
// it.
template <class HeightAt>
GroundBlocks ground_blocks(std::int64_t nx, std::int64_t nz, const HeightAt& height_at) {
  GroundBlocks blocks;
  blocks.x = static_cast<int>((nx + 3) / 4);
  blocks.z = static_cast<int>((nz + 3) / 4);
  blocks.fine.resize(static_cast<std::size_t>(blocks.x) * blocks.z);
  blocks.coarse.resize(static_cast<std::size_t>(blocks.coarse_x()) * ((blocks.z + 3) / 4));
  const auto height = [&](std::int64_t x, std::int64_t z) -> std::int64_t {
    return height_at(std::clamp<std::int64_t>(x, 0, nx - 1), std::clamp<std::int64_t>(z, 0, nz - 1));
  };
  const auto up = [](std::int64_t v) {
    return static_cast<std::int32_t>((v + (1 << kBoundShift) - 1) >> kBoundShift);
  };
  for (int bz = 0; bz < blocks.z; ++bz)
    for (int bx = 0; bx < blocks.x; ++bx) {
      std::int64_t highest = 0, slope_x = 0, slope_z = 0;
      for (std::int64_t z = 4 * bz - 1; z <= 4 * bz + 4; ++z)
        for (std::int64_t x = 4 * bx - 1; x <= 4 * bx + 4; ++x) {
          highest = std::max(highest, height(x, z));
          if (x <= 4 * bx + 3) slope_x = std::max(slope_x, magnitude(height(x + 1, z) - height(x, z)));
          if (z <= 4 * bz + 3) slope_z = std::max(slope_z, magnitude(height(x, z + 1) - height(x, z)));
        }
      blocks.fine[bz * blocks.x + bx] = {up(highest), up(slope_x), up(slope_z)};
      std::int32_t& coarse = blocks.coarse[bz / 4 * blocks.coarse_x() + bx / 4];
      coarse = std::max(coarse, up(highest));
    }
  return blocks;
}

// Describes a ray in search of the ground.
struct Searcher {
  Vec step;
  Inverse x, y, z;
};
inline Searcher searcher_of(const Ray& ray) {
  return {ray.step, inverse_of(ray.step.x), inverse_of(ray.step.y), inverse_of(ray.step.z)};
}

inline constexpr std::int64_t kAlways = std::int64_t{1} << 26;  // samples: more than a ray has in the box

// Counts the samples behind p that lie in its block. A part's position is rounded down, so on the way up
// there is one unit less.
inline std::int64_t samples_in_block(const Searcher& searcher, Vec p, int bits) {
  const std::int64_t size = std::int64_t{1} << bits;
  const auto axis = [&](std::int64_t q, std::int64_t step, Inverse inverse) {
    if (step == 0) return kAlways;
    const std::int64_t in = q & (size - 1), way = step > 0 ? size - 2 - in : in;
    return way < 0 ? 0 : steps_in(way, inverse);
  };
  return std::min(axis(p.x, searcher.step.x, searcher.x), axis(p.z, searcher.step.z, searcher.z));
}

// Counts the samples behind p that are left out without a look at columns. Returns nothing if p itself may
// lie in the ground.
inline std::optional<std::int64_t> samples_above(const GroundBlocks& blocks, const Searcher& searcher,
                                                 Vec p) {
  const auto above = [&](std::int64_t highest, int bits) -> std::int64_t {
    const std::int64_t gap = p.y - (highest << (kCellBits - 12 + kBoundShift));
    if (gap < 0) return -1;
    const std::int64_t falling = searcher.step.y >= 0 ? kAlways : steps_in(gap, searcher.y);
    return std::min(falling, samples_in_block(searcher, p, bits));
  };
  const std::int64_t most =
      std::max(above(blocks.coarse_at(p), kCoarseBits), above(blocks.fine_at(p).highest, kFineBits));
  if (most < 0) return std::nullopt;
  return most;
}

// Returns by how much a ray comes nearer to the ground per sample at most, in 2^-32 cells. If this is 0 or
// less, it never does.
inline std::int64_t approach_of(Vec slopes, Vec step) {
  return magnitude(step.x) * slopes.x + magnitude(step.z) * slopes.z - 4096 * step.y;
}
// Returns a margin that covers the roundings of heights and positions, in the same unit.
inline std::int64_t margin_of(Vec slopes) { return ((slopes.x + slopes.z) << 13) + (std::int64_t{1} << 23); }
// Counts the samples behind p that lie in its block and outside of the ground. The height of p over the
// ground is `above`.
inline std::int64_t samples_over_slopes(const GroundBlocks& blocks, const Searcher& searcher, Vec p,
                                        std::int64_t above) {
  const GroundBlock& block = blocks.fine_at(p);
  const Vec slopes{std::int64_t{block.slope_x} << kBoundShift, 0, std::int64_t{block.slope_z} << kBoundShift};
  const std::int64_t left = (above << 20) - margin_of(slopes), nearer = approach_of(slopes, searcher.step);
  if (left <= 0) return 0;
  const std::int64_t most = nearer <= 0 ? kAlways : steps_in(left >> 12, inverse_of((nearer >> 12) + 1));
  return std::min(most, samples_in_block(searcher, p, kFineBits));
}

}  // namespace voxmelt::hwmodel::raycast
