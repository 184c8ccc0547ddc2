// A ray first meets the ground at a place with a normal (docs/picture/ground.md, sections 3 to 5).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/crossing.h"
#include "render/rule/fixed_point.h"
#include "render/rule/heights.h"
#include "render/rule/normal.h"
#include "render/rule/ray.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

// Returns how far a position lies above the ground of its column, in 1 / kHeight. In the ground it is below
// 0.
template <class Heights, class Watch = Silent>
VOXMELT_RULE std::int64_t above_ground(const Heights& heights, Vector cells, Vector p, Watch watch = {}) {
  watch(Stage::ground, "position", p);
  return (p.y >> (kPositionBits - kHeightBits)) - height_at(heights, cells, p.x, p.z, watch);
}

// Tells whether a position is in the ground. The ground is all that lies below the heights, within the grid's
// sides and above y = 0.
template <class Heights, class Watch = Silent>
VOXMELT_RULE bool in_ground(const Heights& heights, Vector cells, Vector p, Watch watch = {}) {
  return p.x >= 0 && p.x < cells.x * kCell && p.z >= 0 && p.z < cells.z * kCell && p.y >= 0 &&
         above_ground(heights, cells, p, watch) < 0;
}

// Names the face through which a ray enters. A ray that starts in the ground enters through none.
enum class Face : std::uint8_t { none, low_x, high_x, low_z, high_z, under, top };
// Returns the number of a side, from low_x on.
constexpr std::size_t side_of(Face face) { return static_cast<std::size_t>(face) - 1; }

// Returns the face between a position outside of the ground and a near one inside.
VOXMELT_RULE Face face_before(Vector cells, Vector outside) {
  if (outside.x < 0) return Face::low_x;
  if (outside.x >= cells.x * kCell) return Face::high_x;
  if (outside.z < 0) return Face::low_z;
  if (outside.z >= cells.z * kCell) return Face::high_z;
  return outside.y < 0 ? Face::under : Face::top;
}

// Places on a ray count in parts of its steps. Sample k lies at part k kParts.
inline constexpr int kPartBits = 8;
VOXMELT_RULE Vector position_at(const Ray& ray, std::int64_t part) {
  return ray.start + ((ray.step * part) >> kPartBits);
}

struct GroundCrossing {
  bool found = false;
  std::int64_t part = 0;  // place on the ray, in the ground; the part before it lies outside
  Vector position;
  Face face = Face::none;
};

// Returns the parts of a ray in the box around the ground. `highest` is the greatest height of the columns,
// before the lowering.
VOXMELT_RULE Samples ground_parts(Vector cells, std::int32_t highest, const Ray& ray) {
  const Vector high{cells.x * kCell, std::int64_t{highest} << (kPositionBits - kHeightBits), cells.z * kCell};
  return samples_in({ray.start * kParts, ray.step}, {}, high * kParts);
}

// Finds the crossing between `inside`, which is in the ground, and `outside` before it, which is not.
// Bisections end at neighbours with the same property.
template <class Heights, class Watch = Silent>
VOXMELT_RULE GroundCrossing ground_between(const Heights& heights, Vector cells, const Ray& ray,
                                           std::int64_t outside, std::int64_t inside, Watch watch = {}) {
  watch(Stage::ground, "A", outside);
  watch(Stage::ground, "B", inside);
  while (inside - outside > 1) {
    const std::int64_t middle = (outside + inside) >> 1;
    watch(Stage::ground, "M", middle);
    if (in_ground(heights, cells, position_at(ray, middle), watch)) {
      inside = middle;
    } else {
      outside = middle;
    }
  }
  const Face face = inside == 0 ? Face::none : face_before(cells, position_at(ray, outside));
  watch(Stage::ground, "place", inside);
  watch(Stage::ground, "crossing", position_at(ray, inside));
  watch(Stage::ground, "face", static_cast<std::int32_t>(face));
  return {true, inside, position_at(ray, inside), face};
}

// Looks at three kinds of places, in their order on the ray. They are the entry into the box around the
// ground, each sample, and the exit from the box. So edges of the slab have no teeth.
//
// leap(above) may tell how many samples behind a place so far above the ground are outside as well. A leap of
// 0 leaves out none.
template <class Heights, class Leap, class Watch = Silent>
VOXMELT_RULE GroundCrossing first_ground(const Heights& heights, Vector cells, std::int32_t highest,
                                         const Ray& ray, const Leap& leap, Watch watch = {}) {
  const Samples in = ground_parts(cells, highest, ray);
  watch(Stage::ground, "range", std::array{in.first, in.last});
  if (in.first > in.last) return {};
  for (std::int64_t part = in.first;;) {
    watch(Stage::ground, "part", part);
    const std::int64_t above = above_ground(heights, cells, position_at(ray, part), watch);
    if (above < 0) {
      const std::int64_t before = ((part - 1) >> kPartBits) * kParts;
      return ground_between(heights, cells, ray, part == in.first ? part - 1 : std::max(in.first, before),
                            part, watch);
    }
    if (part == in.last) return {};
    part = std::min(((part >> kPartBits) + leap(above) + 1) * kParts, in.last);
  }
}

template <class Heights>
VOXMELT_RULE GroundCrossing first_ground(const Heights& heights, Vector cells, std::int32_t highest,
                                         const Ray& ray) {
  return first_ground(heights, cells, highest, ray, [](std::int64_t) { return std::int64_t{0}; });
}

// Returns the normal of a height field. The field falls by fall_x and fall_z per cell along x and z, in
// kHeight.
template <class Watch = Silent>
VOXMELT_RULE Vector slope_normal(std::int64_t fall_x, std::int64_t fall_z, Watch watch = {}) {
  const Vector a{fall_x, kHeight, fall_z};
  watch(Stage::paint, "fall", a);
  return unit(a >> std::max(0, bits_of(largest(a)) - 14), watch);
}

// Returns how much the fall of the top grows at the slab's upper edges. They are rounded, over half a cell,
// so that they catch the light.
VOXMELT_RULE std::int64_t rim(std::int64_t position, std::int64_t cells) {
  const auto near = [](std::int64_t distance) {
    return std::max<std::int64_t>(0, kCell / 2 - distance) >> (kPositionBits - kHeightBits - 1);
  };
  return near(cells * kCell - position) - near(position);
}

// Returns the normal that points out of the ground. `heights` are those before the lowering, because a film
// does not bend the light beside it.
template <class Heights, class Watch = Silent>
VOXMELT_RULE Vector ground_normal(const Heights& heights, Vector cells, Vector position, Face face,
                                  Watch watch = {}) {
  const std::int64_t one = std::int64_t{1} << kNormalBits;
  const std::int64_t x = position.x, z = position.z, half = kCell / 2;
  const auto height = [&](std::int64_t px, std::int64_t pz) {
    return height_at(heights, cells, px, pz, watch, Stage::paint);
  };
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
      break;
  }
  const std::int32_t west = height(x - half, z), east = height(x + half, z);
  const std::int32_t north = height(x, z - half), south = height(x, z + half);
  return slope_normal(west - east + rim(x, cells.x), north - south + rim(z, cells.z), watch);
}

}  // namespace voxmelt::picture
