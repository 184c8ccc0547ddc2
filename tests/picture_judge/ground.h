// The ground's heights, its crossing with a ray and its normal follow docs/picture/ground.md sections 1 to 5.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "rays.h"

class Ground {
 public:
  Ground(const Input& in, const std::vector<Column>& columns) : nx(in.nx), nz(in.nz) {
    Ints height, wetness;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Int h =
          in.has_terrain ? scaled_number(in.terrain[i], 12) : columns[i].bed * ONE + columns[i].offset;
      height.push_back(clamped(h, 0, 4096 * in.ny));
      wetness.push_back(columns[i].film);
      if (height.back() != 0) exists = true;
    }
    const auto softened = [](Int a, Int h, Int b) { return (a + 2 * h + b + 2) >> 2; };
    const auto prefiltered = [](Int a, Int h, Int b) { return (43 * a + 170 * h + 43 * b + 128) >> 8; };
    for (Int pass = 0; pass < in.smooth; ++pass) {
      height = swept(height, softened);
      wetness = swept(wetness, softened);
    }
    Ints lowered;
    for (std::size_t i = 0; i < height.size(); ++i) lowered.push_back(height[i] - ((wetness[i] + 1) >> 1));
    bare = swept(height, prefiltered);
    drawn = swept(lowered, prefiltered);
    highest = *std::max_element(bare.begin(), bare.end());
    lowest = *std::min_element(bare.begin(), bare.end());
  }
  // Section 2 defines the height.
  Int height_of(const Ints& heights, Int px, Int pz) const {
    const CellWeight x = cell_weight(px), z = cell_weight(pz);
    const auto at = [&](Int i, Int k) { return heights[clamped(k, 0, nz - 1) * nx + clamped(i, 0, nx - 1)]; };
    return blended(blended(at(x.cell, z.cell), at(x.cell + 1, z.cell), x.weight),
                   blended(at(x.cell, z.cell + 1), at(x.cell + 1, z.cell + 1), x.weight), z.weight);
  }
  Int bare_height(Int px, Int pz) const { return height_of(bare, px, pz); }
  // Section 3 defines the inside.
  bool contains(Vec p) const {
    return 0 <= p.x && p.x < (nx << 20) && 0 <= p.z && p.z < (nz << 20) && 0 <= p.y &&
           (p.y >> 8) < height_of(drawn, p.x, p.z);
  }
  // Returns the normal of the top (section 5).
  Vec top_normal(Int px, Int pz) const {
    const Int h = power_of_two(19);
    const auto rim = [h](Int p, Int n) {
      return (std::max<Int>(0, h - ((n << 20) - p)) >> 7) - (std::max<Int>(0, h - p) >> 7);
    };
    const Int gx = bare_height(px - h, pz) - bare_height(px + h, pz) + rim(px, nx);
    const Int gz = bare_height(px, pz - h) - bare_height(px, pz + h) + rim(pz, nz);
    const Vec g{gx, 4096, gz};
    return unit(g >> std::max<Int>(0, bits(largest_magnitude(g)) - 14));
  }
  Int nx, nz;
  bool exists = false;  // section 1: a height 0 of all columns is no ground
  Ints bare, drawn;
  Int highest = 0, lowest = 0;

 private:
  template <class Filter>
  Ints swept(const Ints& values, Filter filter) const {
    Ints along_x(values.size()), along_z(values.size());
    for (Int k = 0; k < nz; ++k)
      for (Int i = 0; i < nx; ++i)
        along_x[k * nx + i] = filter(values[k * nx + std::max<Int>(i - 1, 0)], values[k * nx + i],
                                     values[k * nx + std::min(i + 1, nx - 1)]);
    for (Int k = 0; k < nz; ++k)
      for (Int i = 0; i < nx; ++i)
        along_z[k * nx + i] = filter(along_x[std::max<Int>(k - 1, 0) * nx + i], along_x[k * nx + i],
                                     along_x[std::min(k + 1, nz - 1) * nx + i]);
    return along_z;
  }
};

enum class Face { low_x, high_x, low_z, high_z, underside, top, inside };

struct GroundHit {
  bool met = false;
  Int part = 0;
  Vec crossing;
  Face face = Face::top;
  Int halvings = 0;  // halvings of the step: docs/picture/definition.md 10
  // Section 9 of docs/picture/definition.md defines the order.
  bool drawn_before(const MatterHit& matter) const {
    const Int bias = face == Face::top ? 0 : 1024 * power_of_two(halvings);
    return met && (!matter.met || 8 * part <= matter.place() + bias);
  }
};

// Section 4 defines where a ray meets the ground.
inline GroundHit meet_ground(const Ground& ground, const Ray& ray) {
  GroundHit hit;
  hit.halvings = ray.halvings;
  if (!ground.exists) return hit;
  const auto P = [&ray](Int t) { return ray.start + ((ray.step * t) >> 8); };
  const Vec high{ground.nx << 20, 256 * ground.highest, ground.nz << 20};
  const Range range = range_in_box(ray.start << 8, ray.step, Vec{}, high << 8);
  if (range.first > range.last) return hit;
  Int before = range.first - 1;
  for (Int t = range.first;;) {
    if (ground.contains(P(t))) {
      hit.met = true;
      Int A = before, B = t;
      while (B - A > 1) {
        const Int M = (A + B) >> 1;
        if (ground.contains(P(M)))
          B = M;
        else
          A = M;
      }
      hit.part = B;
      hit.crossing = P(B);
      const Vec Q = P(A);
      if (B == 0)
        hit.face = Face::inside;
      else if (Q.x < 0)
        hit.face = Face::low_x;
      else if (Q.x >= ground.nx << 20)
        hit.face = Face::high_x;
      else if (Q.z < 0)
        hit.face = Face::low_z;
      else if (Q.z >= ground.nz << 20)
        hit.face = Face::high_z;
      else if (Q.y < 0)
        hit.face = Face::underside;
      else
        hit.face = Face::top;
      return hit;
    }
    if (t == range.last) return hit;
    before = t;
    t = std::min(((t >> 8) + 1) << 8, range.last);  // the next multiple of 256, or the last
  }
}

// Section 5 defines the normal.
inline Vec ground_normal(const Ground& ground, const GroundHit& hit) {
  const Int length = power_of_two(14);
  switch (hit.face) {
    case Face::low_x:
      return {-length, 0, 0};
    case Face::high_x:
      return {length, 0, 0};
    case Face::low_z:
      return {0, 0, -length};
    case Face::high_z:
      return {0, 0, length};
    case Face::underside:
      return {0, -length, 0};
    case Face::inside:
      return {0, 0, 0};
    default:
      return ground.top_normal(hit.crossing.x, hit.crossing.z);
  }
}
