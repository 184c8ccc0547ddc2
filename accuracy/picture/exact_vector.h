// This header has vectors in double, in cells, and the first crossing of a cubic along a ray.
#pragma once

#include <array>
#include <cmath>

#include "render/rule/fixed_point.h"

namespace voxmelt::accuracy {

struct Exact {
  double x = 0, y = 0, z = 0;

  friend Exact operator+(Exact a, Exact b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Exact operator-(Exact a, Exact b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Exact operator*(Exact a, double s) { return {a.x * s, a.y * s, a.z * s}; }
};

inline double dot(Exact a, Exact b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Scales a vector to length 1. A zero vector stays zero.
inline Exact unit(Exact a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? a * (1 / length) : a;
}

inline Exact exact(picture::Vector a, double one) {
  return Exact{static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)} * (1 / one);
}

struct ExactRay {
  Exact start, along;  // the largest component of `along` is 1 in magnitude
  Exact at(double t) const { return start + along * t; }
};

inline double blend(double a, double b, double weight) { return a + (b - a) * weight; }

// A cubic on 0 .. 1 is given by its four Bernstein coefficients. It lies between the least and the greatest
// of them.
using Cubic = std::array<double, 4>;

// Returns the first place at which the cubic is 0 or more, to 2^-26, or a negative number. Halves are looked
// at only where a coefficient reaches 0, so no graze is missed.
inline double first_reached(const Cubic& c, double low = 0, double width = 1, int depth = 26) {
  if (c[0] >= 0) return low;
  if (c[1] < 0 && c[2] < 0 && c[3] < 0) return -1;
  if (depth == 0) return c[3] >= 0 ? low + width : -1;
  const double ab = (c[0] + c[1]) / 2, bc = (c[1] + c[2]) / 2, cd = (c[2] + c[3]) / 2;
  const double abc = (ab + bc) / 2, bcd = (bc + cd) / 2, middle = (abc + bcd) / 2;
  const double first = first_reached({c[0], ab, abc, middle}, low, width / 2, depth - 1);
  return first >= 0 ? first : first_reached({middle, bcd, cd, c[3]}, low + width / 2, width / 2, depth - 1);
}

}  // namespace voxmelt::accuracy
