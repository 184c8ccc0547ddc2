// Levels, samples, the crossing of matter and its normal follow docs/picture/definition.md sections 5 to 8.
#pragma once

#include <algorithm>

#include "camera.h"
#include "field.h"

// Holds cell and weight of a sample (section 6).
struct CellWeight {
  Int cell, weight;
};
inline CellWeight cell_weight(Int p) {
  const Int s = p - power_of_two(19) + power_of_two(11);
  return {s >> 20, (s >> 12) & 255};
}

// Blends eight values around a position along x, then y, then z.
template <class ValueOf>
Int blended_eight(Vec p, ValueOf value_of) {
  const CellWeight x = cell_weight(p.x), y = cell_weight(p.y), z = cell_weight(p.z);
  const auto row = [&](Int j, Int k) {
    return blended(value_of(x.cell, j, k), value_of(x.cell + 1, j, k), x.weight);
  };
  const auto plane = [&](Int k) { return blended(row(y.cell, k), row(y.cell + 1, k), y.weight); };
  return blended(plane(z.cell), plane(z.cell + 1), z.weight);
}

class Levels {
 public:
  Levels(const Input& in, const Field& field) : nx(in.nx), ny(in.ny), nz(in.nz), level(field.intensity) {
    const Int n[3] = {nx, ny, nz};
    for (int axis = 0; axis < 3; ++axis) {
      const Ints before = level;
      for (Int z = 0; z < nz; ++z)
        for (Int y = 0; y < ny; ++y)
          for (Int x = 0; x < nx; ++x) {
            Vec low{x, y, z}, high{x, y, z};
            low.at(axis) = std::max<Int>(low.at(axis) - 1, 0);
            high.at(axis) = std::min(high.at(axis) + 1, n[axis] - 1);
            level[in.cell(x, y, z)] =
                (43 * before[in.cell(low.x, low.y, low.z)] + 170 * before[in.cell(x, y, z)] +
                 43 * before[in.cell(high.x, high.y, high.z)] + 128) >>
                8;
          }
    }
    for (Int& value : level) value -= 32640;
  }
  bool inside(Int x, Int y, Int z) const { return x >= 0 && x < nx && y >= 0 && y < ny && z >= 0 && z < nz; }
  Int at(Int x, Int y, Int z) const { return inside(x, y, z) ? level[(z * ny + y) * nx + x] : -32640; }
  Int sample(Vec p) const {
    return blended_eight(p, [this](Int x, Int y, Int z) { return at(x, y, z); });
  }
  Vec box_low() const {
    const Int low = -power_of_two(19) - power_of_two(11);
    return {low, low, low};
  }
  Vec box_high() const {
    const Int more = power_of_two(19) - power_of_two(11);
    return {(nx << 20) + more, (ny << 20) + more, (nz << 20) + more};
  }
  const Int nx, ny, nz;

 private:
  Ints level;
};

struct Crossing {
  Vec position;
  Int part = 0;  // in 2048ths of the way from the sample in air to the one in matter
};

// Finds the crossing between A in air and B in matter (section 7).
inline Crossing crossing_between(const Levels& levels, Vec A, Vec B) {
  Int a = levels.sample(A), b = levels.sample(B), e = 0;
  for (int middle = 0; middle < 3; ++middle) {
    const Vec M = A + ((B - A) >> 1);
    const Int m = levels.sample(M);
    e *= 2;
    if (m < 0) {
      A = M;
      a = m;
      e += 1;
    } else {
      B = M;
      b = m;
    }
  }
  const Int f = floor_divided(-a * 256, b - a);
  return {A + (((B - A) * f) >> 8), 256 * e + f};
}

inline Vec place_of_sample(const Ray& ray, Int k) { return ray.start + ray.step * k; }

struct MatterHit {
  bool met = false;
  Int sample = 0;  // the first in matter
  Crossing crossing;
  bool at_start() const { return sample == 0; }
  Int place() const { return (sample - 1) * 2048 + crossing.part; }  // section 9
};

// Looks for matter from sample `from` on (section 7).
inline MatterHit meet_matter(const Levels& levels, const Ray& ray, Int from = 0) {
  const Range range = range_in_box(ray.start, ray.step, levels.box_low(), levels.box_high());
  for (Int k = std::max(range.first, from); k <= range.last; ++k) {
    const Vec here = place_of_sample(ray, k);
    if (levels.sample(here) < 0) continue;
    if (k == 0) return {true, 0, {ray.start, 2048}};
    return {true, k, crossing_between(levels, place_of_sample(ray, k - 1), here)};
  }
  return {};
}

// Section 8 defines the normal.
inline Vec matter_normal(const Levels& levels, Vec p) {
  struct Axis {
    Int cell, value[3], slope[3];
  };
  const auto axis_of = [](Int position) {
    const Int s = position + power_of_two(11), u = (s >> 12) & 255, t = 256 - u;
    const Int l = (t * t) >> 9, r = (u * u) >> 9;
    return Axis{s >> 20, {l, 256 - l - r, r}, {-t, t - u, u}};
  };
  const Axis x = axis_of(p.x), y = axis_of(p.y), z = axis_of(p.z);
  const auto splined_along = [&](int slope_axis) {
    Int planes[3];
    for (Int k = 0; k < 3; ++k) {
      Int rows[3];
      for (Int j = 0; j < 3; ++j) {
        const Int* w = slope_axis == 0 ? x.slope : x.value;
        Int sum = 0;
        for (Int i = 0; i < 3; ++i) sum += w[i] * levels.at(x.cell - 1 + i, y.cell - 1 + j, z.cell - 1 + k);
        rows[j] = rounded(sum, slope_axis == 0 ? 9 : 8);
      }
      const Int* w = slope_axis == 1 ? y.slope : y.value;
      planes[k] = rounded(rows[0] * w[0] + rows[1] * w[1] + rows[2] * w[2], slope_axis == 1 ? 9 : 8);
    }
    const Int* w = slope_axis == 2 ? z.slope : z.value;
    return rounded(planes[0] * w[0] + planes[1] * w[1] + planes[2] * w[2], slope_axis == 2 ? 9 : 8);
  };
  return unit({-splined_along(0), -splined_along(1), -splined_along(2)});
}

// Section 9 defines the direction to the eye.
inline Vec to_eye_of(const Ray& ray) { return unit_of(-ray.step); }
