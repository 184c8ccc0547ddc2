// Integers, vectors, roots and angles follow docs/picture/definition.md sections 1, 2 and 8 (unit).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

using Int = std::int64_t;
using Ints = std::vector<Int>;

// Divides and rounds down, also for a negative a (docs/picture/definition.md 1).
inline Int floor_divided(Int a, Int b) {
  if (b <= 0) throw std::runtime_error("division by a number that is not positive");
  const Int q = a / b;
  return q * b > a ? q - 1 : q;
}
inline Int ceil_divided(Int a, Int b) { return -floor_divided(-a, b); }
inline Int modulo(Int a, Int b) { return a - b * floor_divided(a, b); }
inline Int power_of_two(Int n) { return Int{1} << n; }
inline Int rounded(Int a, Int n) { return (a + power_of_two(n - 1)) >> n; }
inline Int magnitude(Int a) { return a < 0 ? -a : a; }
inline Int clamped(Int v, Int low, Int high) { return v < low ? low : v > high ? high : v; }

// Returns floor(v 2^n + 1/2), with no rounding of the sum.
inline Int scaled_number(double v, int n) {
  const double product = std::ldexp(v, n);
  const double whole = std::floor(product);
  return static_cast<Int>(whole) + (product - whole >= 0.5 ? 1 : 0);
}

// Returns the least b with x < 2^b (docs/picture/definition.md 8).
inline Int bits(Int x) {
  Int b = 0;
  while (x >= power_of_two(b)) ++b;
  return b;
}

inline Int floor_root(Int x) {
  Int low = 0, high = Int{1} << 31;  // low^2 <= x < high^2
  while (high - low > 1) {
    const Int middle = (low + high) / 2;
    if (middle * middle <= x)
      low = middle;
    else
      high = middle;
  }
  return low;
}

// Blends a and b (docs/picture/definition.md 6).
inline Int blended(Int a, Int b, Int w) { return (a * (256 - w) + b * w + 128) >> 8; }

struct Vec {
  Int x = 0, y = 0, z = 0;
  Int at(int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  Int& at(int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
};
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator-(Vec a) { return {-a.x, -a.y, -a.z}; }
inline Vec operator*(Vec a, Int f) { return {a.x * f, a.y * f, a.z * f}; }
inline Vec operator>>(Vec a, Int n) { return {a.x >> n, a.y >> n, a.z >> n}; }
inline Vec operator<<(Vec a, Int n) { return a * power_of_two(n); }
inline Vec operator/(Vec a, Int d) {
  return {floor_divided(a.x, d), floor_divided(a.y, d), floor_divided(a.z, d)};
}
inline Int dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Int largest_magnitude(Vec a) { return std::max({magnitude(a.x), magnitude(a.y), magnitude(a.z)}); }

// Returns R[i], which is 2^15 / sqrt(i / 128) (docs/picture/definition.md 8).
inline Int inverse_root(Int i) { return (floor_root(power_of_two(39) / i) + 1) >> 1; }

// Brings components below 2^15 in magnitude to length 2^14 (docs/picture/definition.md 8).
inline Vec unit(Vec g) {
  const Int largest = largest_magnitude(g);
  if (largest == 0) return g;
  const Int n = 15 - bits(largest);
  if (n < 0) throw std::runtime_error("a component of 2^15 or more");
  g = g << n;
  const Int q = dot(g, g);
  const Int e = q < power_of_two(30) ? 1 : 0;
  const Int m = q << (2 * e);
  const Int i = m >> 23;
  const Int here = inverse_root(i), next = inverse_root(i + 1);
  const Int r = here - rounded((here - next) * (m & (power_of_two(23) - 1)), 23);
  const Vec product = g * (r << e);
  return {rounded(product.x, 16), rounded(product.y, 16), rounded(product.z, 16)};
}
inline Vec unit_of(Vec g) {
  const Int length = bits(largest_magnitude(g));
  return unit(length > 15 ? g >> (length - 14) : g);
}

struct SineCosine {
  Int sine, cosine;
};

// Takes the angle in 2^-16 degrees and gives results in 2^-30 (docs/picture/definition.md 2).
inline SineCosine sine_cosine(Int a) {
  const Int quarter = 5898240;
  const Int q = floor_divided(a, quarter);
  const Int x = rounded((a - quarter * q) * 1228166276394, 32);
  Int t = power_of_two(30), s = 0, c = power_of_two(30);
  for (Int n = 1; n <= 17; ++n) {
    t = floor_divided((t * x) >> 30, n);
    if (n % 4 == 1) s += t;
    if (n % 4 == 2) c -= t;
    if (n % 4 == 3) s -= t;
    if (n % 4 == 0) c += t;
  }
  switch (modulo(q, 4)) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}
