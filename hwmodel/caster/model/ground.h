// The slab has a height at each place, a hit by a ray, a normal and a colour (docs/picture/ground.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "hwmodel/caster/model/arithmetic.h"
#include "hwmodel/caster/model/ray.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/fabric/index_of.h"

namespace voxmelt::hwmodel::raycast {

// Holds a column as it lies in memory.
struct Column {
  std::int32_t drawn = 0, bare = 0;
};
// Holds a texel as it lies in memory.
struct Texel {
  std::uint16_t red = 0, green = 0, blue = 0;
  std::int8_t bump_x = 0, bump_z = 0;
};

enum class Face : std::uint8_t { none, low_x, high_x, low_z, high_z, under, top };

struct GroundHit {
  bool found = false;
  std::int64_t part = 0;  // 1/256 of a step
  Vec position;
  Face face = Face::none;
  Vec normal;  // normal of the top
};

// Blends between four numbers of columns: along x, then along z.
template <class Value>
std::int64_t between_columns(const Value& value, Spot x, Spot z) {
  return blended(blended(value(0), value(1), x.weight), blended(value(2), value(3), x.weight), z.weight);
}

// Holds the sixteen columns from a cell on along x and z. They give the height of any place on a step of a
// quarter of a cell, and half a cell around.
struct NearColumns {
  static constexpr std::size_t kSide = 4;
  std::int64_t x = 0, z = 0;  // first cell
  std::array<Column, kSide * kSide> columns{};

  template <class Value>
  SInt<24> height(Value value, std::int64_t px, std::int64_t pz) const {
    const Spot sx = spot_of(px), sz = spot_of(pz);
    const auto first = kSide * (sz.cell - z) + (sx.cell - x);
    const auto number = [&](std::size_t n) {
      return std::int64_t{columns[first + (n & 1) + kSide * (n >> 1)].*value};
    };
    return between_columns(number, sx, sz);
  }
};

inline Vec at_part(const Ray& ray, std::int64_t part) { return ray.start + ((ray.step * part) >> 8); }

// Holds the parts of a ray in the box around the ground. They take six quotients of 36 bits, which must be
// exact.
struct Parts {
  std::int64_t first = 0, last = -1;
};
inline Parts parts_of(const Registers& registers, const Ray& ray) {
  Parts parts{0, INT64_MAX};
  const auto axis = [&](std::int64_t start, std::int64_t step, std::int64_t high) {
    const std::int64_t before = -256 * start, behind = 256 * (high - start) - 1;
    if (step == 0) {
      if (before > 0 || behind < 0) parts.first = INT64_MAX;
    } else if (step > 0) {
      parts.first = std::max(parts.first, -divided(-before, step));
      parts.last = std::min(parts.last, divided(behind, step));
    } else {
      parts.first = std::max(parts.first, -divided(behind, -step));
      parts.last = std::min(parts.last, divided(-before, -step));
    }
  };
  axis(ray.start.x, ray.step.x, registers.cells.x * kCell);
  axis(ray.start.y, ray.step.y, registers.ground.highest << 8);
  axis(ray.start.z, ray.step.z, registers.cells.z * kCell);
  return parts.first > parts.last ? Parts{} : parts;
}

inline bool in_slab(const Registers& registers, Vec p) {
  return p.x >= 0 && p.x < registers.cells.x * kCell && p.z >= 0 && p.z < registers.cells.z * kCell &&
         p.y >= 0;
}

// Returns the face by which a ray came from `outside` into the ground.
inline Face face_of(const Registers& registers, Vec outside) {
  if (outside.x < 0) return Face::low_x;
  if (outside.x >= registers.cells.x * kCell) return Face::high_x;
  if (outside.z < 0) return Face::low_z;
  if (outside.z >= registers.cells.z * kCell) return Face::high_z;
  return outside.y < 0 ? Face::under : Face::top;
}

// The normal leans outwards near the rim, because the upper edges are rounded.
inline std::int64_t rim(std::int64_t p, std::int64_t cells) {
  const std::int64_t half = kCell / 2;
  return (std::max<std::int64_t>(0, half - (cells * kCell - p)) >> 7) -
         (std::max<std::int64_t>(0, half - p) >> 7);
}
// Returns the normal of the top, from the bare heights half a cell to the west, east, north and south.
inline Vec top_normal(const Registers& registers, Vec p, const std::array<std::int64_t, 4>& heights) {
  const Vec fall{heights[0] - heights[1] + rim(p.x, registers.cells.x), 4096,
                 heights[2] - heights[3] + rim(p.z, registers.cells.z)};
  return unit(fall >> std::max(0, bits_of(largest(fall)) - 14));
}
inline Vec side_normal(Face face) {
  constexpr std::int64_t one = 1 << 14;
  switch (face) {
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
      return {};
  }
}

// Reads a table of numbers along one axis. Its ends repeat themselves.
template <class Value>
std::int64_t along_table(const std::vector<Value>& table, std::int64_t position) {
  const Spot at = spot_of(position);
  const auto entry = [&](std::int64_t i) {
    return std::int64_t{table[std::clamp<std::int64_t>(i, 0, std::ssize(table) - 1)]};
  };
  return blended(entry(at.cell), entry(at.cell + 1), at.weight);
}
// Returns the colour of sides, of the underside, and around a camera in the ground.
inline Rgb cut_color(const GroundRegisters& ground, Vec p, Face face) {
  std::int64_t band = 0;
  if (ground.textured && face != Face::under && face != Face::none) {
    const bool by_z = face == Face::low_x || face == Face::high_x;
    const std::int64_t bend = along_table(ground.bends[index_of(face) - 1], by_z ? p.z : p.x);
    band = along_table(ground.bands, (p.y + bend) << 2);
  }
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<std::int32_t>((ground.color[c] * (2540 + ((41 * band) >> 8))) >> 12);
  return color;
}

}  // namespace voxmelt::hwmodel::raycast
