// Random words and bytes come from Speck64/128 cut to 10 rounds (docs/automaton.md section 2).
#pragma once
#include "arithmetic.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace oracle {

class RandomWords {
 public:
  static constexpr std::uint32_t BYTES = 0x656C7421u, TURNS = 0x72617973u;  // l[2] in section 2, in section 5

  constexpr RandomWords(std::uint64_t seed, std::uint32_t l2) {
    std::array<std::uint32_t, 12> l{};
    key[0] = static_cast<std::uint32_t>(seed & 0xFFFFFFFFu);
    l[0] = static_cast<std::uint32_t>(seed >> 32);
    l[1] = 0x766F786Du;
    l[2] = l2;
    for (std::uint32_t i = 0; i <= 8; ++i) {
      l[i + 3] = (key[i] + rotated_right(l[i], 8)) ^ i;
      key[i + 1] = rotated_left(key[i], 3) ^ l[i + 3];
    }
  }

  // Returns the word of step s and block b, both taken mod 2^32.
  constexpr std::uint64_t word(Int s, Int b) const {
    std::uint32_t X = static_cast<std::uint32_t>(s & 0xFFFFFFFF);
    std::uint32_t Y = static_cast<std::uint32_t>(b & 0xFFFFFFFF);
    for (std::size_t i = 0; i <= 9; ++i) {
      X = (rotated_right(X, 8) + Y) ^ key[i];
      Y = rotated_left(Y, 3) ^ X;
    }
    return (static_cast<std::uint64_t>(X) << 32) + Y;
  }

 private:
  static constexpr std::uint32_t rotated_right(std::uint32_t v, int n) { return (v >> n) | (v << (32 - n)); }
  static constexpr std::uint32_t rotated_left(std::uint32_t v, int n) { return (v << n) | (v >> (32 - n)); }

  std::array<std::uint32_t, 10> key{};
};

static_assert(RandomWords(0x123456789ABCDEF0u, RandomWords::BYTES).word(77, 5) == 0x9E9616A588A7C7A1u);

class RandomBytes {
 public:
  explicit RandomBytes(std::uint64_t seed) : words(seed, RandomWords::BYTES) {}

  // Returns the byte of cell (x, y, z) of an nx x ny x nz grid at step s.
  Int byte(Int x, Int y, Int z, Int nx, Int ny, Int s) const {
    const Int block = (z * ny + y) * ((nx + 7) / 8) + x / 8;
    return static_cast<Int>((words.word(s, block) >> (8 * (x % 8))) % 256);
  }

 private:
  RandomWords words;
};

}  // namespace oracle
