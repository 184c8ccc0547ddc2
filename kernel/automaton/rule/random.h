// Random bits are a function of (seed, step, cell): the block cipher Speck64/128 cut to 10 rounds.
//
// One 64-bit block serves 8 cells along x, one byte (8 directions) each. It takes 32-bit additions, rotations
// by 8 and 3, and exclusive-or, which are cheap in SIMD and in logic.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::rule {

inline constexpr int kRandomRounds = 10;
using RoundKeys = std::array<std::uint32_t, kRandomRounds>;

// Is the last word of the key: "elt!" for the random bits of cells, "rays" for the places where rays end.
inline constexpr std::uint32_t kCellWord = 0x656C7421, kRayWord = 0x72617973;

// Computes the Speck64/128 key schedule of (seed low, seed high, "voxm", last word).
VOXMELT_RULE RoundKeys round_keys(std::uint64_t seed, std::uint32_t last_word = kCellWord) {
  RoundKeys key{};
  std::array<std::uint32_t, kRandomRounds + 3> l{};
  key[0] = static_cast<std::uint32_t>(seed);
  l[0] = static_cast<std::uint32_t>(seed >> 32);
  l[1] = 0x766F786Du;
  l[2] = last_word;
  for (std::uint32_t i = 0; i + 1 < kRandomRounds; ++i) {
    l[i + 3] = (key[i] + std::rotr(l[i], 8)) ^ i;
    key[i + 1] = std::rotl(key[i], 3) ^ l[i + 3];
  }
  return key;
}

VOXMELT_RULE std::uint64_t random_block(const RoundKeys& key, std::uint32_t step, std::uint32_t block) {
  std::uint32_t x = step, y = block;
  for (int i = 0; i < kRandomRounds; ++i) {
    x = (std::rotr(x, 8) + y) ^ key[i];
    y = std::rotl(y, 3) ^ x;
  }
  return (std::uint64_t{x} << 32) | y;
}

// Blocks are numbered along x, then y, then z. A row of nx cells has ceil(nx / 8) of them.
VOXMELT_RULE std::uint32_t random_block_index(std::uint32_t x, std::uint32_t y, std::uint32_t z,
                                              std::uint32_t nx, std::uint32_t ny) {
  const std::uint32_t row_blocks = (nx + 7) / 8;
  return (z * ny + y) * row_blocks + x / 8;
}

VOXMELT_RULE std::uint8_t random_byte(std::uint64_t block, int x) {
  return static_cast<std::uint8_t>(block >> (8 * (x & 7)));
}

}  // namespace voxmelt::rule
