// Three floats: positions in cells, directions, linear colours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace voxmelt::render {

struct Vec {
  float x = 0, y = 0, z = 0;

  friend constexpr Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr Vec operator*(Vec a, float s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec operator*(float s, Vec a) { return a * s; }
  friend constexpr Vec operator-(Vec a) { return {-a.x, -a.y, -a.z}; }
  Vec& operator+=(Vec b) { return *this = *this + b; }
};

constexpr float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec a) { return std::sqrt(dot(a, a)); }
// A zero vector stays zero.
inline Vec normalized(Vec a) {
  const float size = length(a);
  return size > 0 ? a * (1.0f / size) : a;
}
constexpr Vec mix(Vec a, Vec b, float t) { return a * (1 - t) + b * t; }
constexpr float mix(float a, float b, float t) { return a * (1 - t) + b * t; }
// 0 below `from`, 1 above `to`, with a smooth step between.
inline float smooth_step(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

inline Vec vec(const std::array<double, 3>& a) {
  return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

struct Ray {
  Vec origin, direction;  // direction of length 1
  Vec at(float t) const { return origin + direction * t; }
};

}  // namespace voxmelt::render
