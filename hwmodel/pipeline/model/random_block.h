// Random bits come from logic: the block cipher Speck64/128 cut to 10 rounds. A round is one 32-bit adder and
// two rows of exclusive-or gates, and rotations are wires. One block serves 8 neighbours along x, a byte
// each.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "hwmodel/fabric/wires.h"

namespace voxmelt::hwmodel {

inline constexpr std::size_t kSpeckRounds = 10;
using SpeckKeys = std::array<std::uint32_t, kSpeckRounds>;

// Returns the round keys. They are constant while a scene runs, and lie in registers that are filled once.
inline SpeckKeys speck_keys(std::uint64_t seed) {
  SpeckKeys keys{static_cast<std::uint32_t>(seed & 0xFFFFFFFFu)};
  std::array<std::uint32_t, 3> ring{static_cast<std::uint32_t>(seed >> 32), 0x766F786Du, 0x656C7421u};
  for (std::uint32_t i = 0; i + 1 < kSpeckRounds; ++i) {
    std::uint32_t& word = ring[i % 3];  // l[i], which becomes l[i + 3]
    word = (keys[i] + std::rotr(word, 8)) ^ i;
    keys[i + 1] = std::rotl(keys[i], 3) ^ word;
  }
  return keys;
}

inline std::uint64_t speck_block(const SpeckKeys& keys, std::uint32_t step, std::uint32_t block) {
  std::uint32_t high = step, low = block;
  for (const std::uint32_t key : keys) {
    high = (std::rotr(high, 8) + low) ^ key;
    low = std::rotl(low, 3) ^ high;
  }
  return std::uint64_t{high} << 32 | low;
}

// Returns the byte of the cell at x in the block of its eight.
inline UInt<8> speck_byte(std::uint64_t block, int x) { return block >> (8 * (x & 7)) & 0xFF; }

// Counts the blocks that the cells of a token draw from. Tokens begin at multiples of their lanes, so that of
// 8 lanes lies in one block, and one of 3 lanes in two at most.
constexpr int blocks_of_token(int lanes) {
  const int furthest = 8 - std::gcd(lanes, 8);  // at which a token begins, in a block
  return (furthest + lanes + 7) / 8;
}

}  // namespace voxmelt::hwmodel
