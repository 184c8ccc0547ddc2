// Where a ray first meets the ground, and the ground's normal there (docs/picture-ground.md, sections 3 to 5).
#pragma once

#include <algorithm>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/heights.h"
#include "render/rule/normal.h"
#include "render/rule/ray.h"

namespace voxmelt::picture {

// The ground is all that lies below the heights, within the grid's sides and above y = 0.
template <class Heights>
VOXMELT_RULE bool in_ground(const Heights& heights, Vector cells, Vector p) {
  return p.x >= 0 && p.x < cells.x * kCell && p.z >= 0 && p.z < cells.z * kCell && p.y >= 0 &&
         (p.y >> (kPositionBits - kHeightBits)) < height_at(heights, cells, p.x, p.z);
}

// Through which a ray enters. A ray that starts in the ground enters through none.
enum class Face : std::uint8_t { none, low_x, high_x, low_z, high_z, under, top };

// The face between a position outside of the ground and one inside that is near.
VOXMELT_RULE Face face_before(Vector cells, Vector outside) {
  if (outside.x < 0) return Face::low_x;
  if (outside.x >= cells.x * kCell) return Face::high_x;
  if (outside.z < 0) return Face::low_z;
  if (outside.z >= cells.z * kCell) return Face::high_z;
  return outside.y < 0 ? Face::under : Face::top;
}

inline constexpr int kGroundPartBits = 8;
inline constexpr std::int32_t kGroundParts = 1 << kGroundPartBits;  // of a step

struct GroundCrossing {
  bool found = false;
  std::int64_t sample = 0;  // the first that lies in the ground
  std::int32_t part = 0;    // of the step to that sample, 1 .. kGroundParts: the place is in the ground
  Vector position;
  Face face = Face::none;
  // In parts of a step from sample 0. A ray that starts in the ground has 0.
  constexpr std::int64_t distance() const {
    return std::max<std::int64_t>((sample - 1) * kGroundParts + part, 0);
  }
};

VOXMELT_RULE Vector part_of_step(Vector from, Vector step, std::int32_t part) {
  return from + ((step * part) >> kGroundPartBits);
}

// Sample `k` is the first in the ground. Bisections find the least part, if there is one crossing only.
template <class Heights>
VOXMELT_RULE GroundCrossing ground_at(const Heights& heights, Vector cells, const Ray& ray, std::int64_t k) {
  if (k == 0) return {true, 0, kGroundParts, ray.start, Face::none};
  const Vector from = ray.at(k - 1);
  std::int32_t outside = 0, inside = kGroundParts;
  while (inside - outside > 1) {
    const std::int32_t middle = (outside + inside) / 2;
    if (in_ground(heights, cells, part_of_step(from, ray.step, middle))) {
      inside = middle;
    } else {
      outside = middle;
    }
  }
  return {true, k, inside, part_of_step(from, ray.step, inside),
          face_before(cells, part_of_step(from, ray.step, outside))};
}

// The samples that can lie in the ground. No height is above the grid.
VOXMELT_RULE Samples ground_samples(Vector cells, const Ray& ray) {
  return samples_in(ray, {}, cells * kCell);
}

template <class Heights>
VOXMELT_RULE GroundCrossing first_ground(const Heights& heights, Vector cells, const Ray& ray) {
  const Samples in = ground_samples(cells, ray);
  for (std::int64_t k = in.first; k <= in.last; ++k)
    if (in_ground(heights, cells, ray.at(k))) return ground_at(heights, cells, ray, k);
  return {};
}

// The normal of a height field of such falls to a cell, in kHeight, along x and z.
VOXMELT_RULE Vector slope_normal(std::int64_t fall_x, std::int64_t fall_z) {
  const Vector a{fall_x, kHeight, fall_z};
  return unit(a >> std::max(0, bits_of(largest(a)) - 14));
}

// The slab's upper edges are rounded, over half a cell, so that they catch the light. This is how much the
// fall of the top grows there.
VOXMELT_RULE std::int64_t rim(std::int64_t position, std::int64_t cells) {
  const auto near = [](std::int64_t distance) {
    return std::max<std::int64_t>(0, kCell / 2 - distance) >> (kPositionBits - kHeightBits - 1);
  };
  return near(cells * kCell - position) - near(position);
}

// Out of the ground. `heights` are those before the lowering: a film does not bend the light beside it.
template <class Heights>
VOXMELT_RULE Vector ground_normal(const Heights& heights, Vector cells, Vector position, Face face) {
  const std::int64_t one = std::int64_t{1} << kNormalBits;
  const std::int64_t x = position.x, z = position.z, half = kCell / 2;
  const auto height = [&](std::int64_t px, std::int64_t pz) { return height_at(heights, cells, px, pz); };
  switch (face) {
    case Face::none:
      return {};
    case Face::low_x:
      return {-one, 0, 0};
    case Face::high_x:
      return {one, 0, 0};
    case Face::low_z:
      return {0, 0, -one};
    case Face::high_z:
      return {0, 0, one};
    case Face::under:
      return {0, -one, 0};
    default:
      return slope_normal(height(x - half, z) - height(x + half, z) + rim(x, cells.x),
                          height(x, z - half) - height(x, z + half) + rim(z, cells.z));
  }
}

}  // namespace voxmelt::picture
