// The arithmetic has exact integers, dither and mixing (docs/automaton.md section 2).
#pragma once
#include <cstdint>

namespace oracle {

using Int = std::int64_t;
__extension__ typedef __int128 Sum;

constexpr Int ONE = 4096;    // section 1: a full cell
constexpr Int AMAX = 65535;  // section 1: the most a cell may hold
constexpr Int FLAT = 2048;   // section 1: the bed offset of a flat surface

// Divides and rounds down, for b > 0 (section 2).
template <typename Number>
constexpr Number floor_divide(Number a, Number b) {
  const Number quotient = a / b;
  return (a % b < 0) ? quotient - 1 : quotient;
}

// In C++20, a >> n is floor(a / 2^n), for negative a too (section 2).
constexpr Int scaled(Int a, Int w, Int r = 0) { return (a * w + r) >> 16; }

constexpr Int clamp(Int value, Int low, Int high) {
  return value < low ? low : (value > high ? high : value);
}

constexpr Int smaller(Int a, Int b) { return a < b ? a : b; }
constexpr Int larger(Int a, Int b) { return a > b ? a : b; }

// Returns the 16 lowest bits of the step number in reverse order (section 2).
constexpr Int bit_reversed(Int s) {
  Int result = 0;
  for (Int bit = 0; bit < 16; ++bit)
    if ((s >> bit) % 2 != 0) result += Int{1} << (15 - bit);
  return result;
}

// Returns D(s, k, n) of section 2; D(s) = D(s, 0, 1).
constexpr Int dither(Int s, Int k = 0, Int n = 1) { return (bit_reversed(s) + 65536 * k / n) % 65536; }

// Mixing (section 2) gives the heat of `amount` = sum a_i, with `products` = sum a_i h_i.
constexpr Int mixed(Int products, Int amount, Int B) { return (products + ((amount * B) >> 16)) / amount; }

// Returns the floor of the square root of a, for 0 <= a < 2^62: the greatest number whose square is at most
// a.
constexpr Int square_root(Int a) {
  Int root = 0;
  for (Int bit = Int{1} << 30; bit > 0; bit >>= 1)
    if ((root + bit) * (root + bit) <= a) root += bit;
  return root;
}

}  // namespace oracle
