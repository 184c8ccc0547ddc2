// The random function has known answers, and good statistics over 16.8 million bits. Everything here is
// fixed, so a bound of 5 standard deviations either always holds or never. A perfect source would fail one of
// the about 8,000 numbers below with probability 0.5 %.
#include "kernel/automaton/rule/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt::rule {
namespace {

constexpr double kSigmas = 5;

// Computes Speck64/128 as its authors print it (Beaulieu et al. 2013), for any number of rounds.
struct Speck {
  std::vector<std::uint32_t> keys;
  Speck(std::uint32_t k, std::vector<std::uint32_t> l, int rounds) : keys{k} {
    for (int i = 0; i + 1 < rounds; ++i) {
      const auto at = static_cast<std::size_t>(i);
      l.push_back((keys[at] + ((l[at] >> 8) | (l[at] << 24))) ^ static_cast<std::uint32_t>(i));
      keys.push_back(((keys[at] << 3) | (keys[at] >> 29)) ^ l[at + 3]);
    }
  }
  std::uint64_t encrypt(std::uint32_t x, std::uint32_t y) const {
    for (const std::uint32_t k : keys) {
      x = (((x >> 8) | (x << 24)) + y) ^ k;
      y = ((y << 3) | (y >> 29)) ^ x;
    }
    return std::uint64_t{x} << 32 | y;
  }
};

TEST(Random, TheTestsSpeckIsSpeck) {
  const Speck full(0x03020100u, {0x0B0A0908u, 0x13121110u, 0x1B1A1918u}, 27);
  EXPECT_EQ(full.encrypt(0x3B726574u, 0x7475432Du), 0x8C6FA548454E028Bu);
}

TEST(Random, IsSpeckCutToTenRounds) {
  for (const std::uint64_t seed :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{0x123456789ABCDEF0}, ~std::uint64_t{0}}) {
    const Speck speck(static_cast<std::uint32_t>(seed),
                      {static_cast<std::uint32_t>(seed >> 32), 0x766F786Du, 0x656C7421u}, 10);
    const RoundKeys keys = round_keys(seed);
    for (std::size_t i = 0; i < keys.size(); ++i) EXPECT_EQ(keys[i], speck.keys[i]);
    for (const std::uint32_t step : {0u, 1u, 77u, 0xFFFFFFFFu})
      for (const std::uint32_t block : {0u, 1u, 4095u, 0xFFFFFFFFu})
        EXPECT_EQ(random_block(keys, step, block), speck.encrypt(step, block));
  }
}

TEST(Random, BlocksAndBytes) {
  EXPECT_EQ(random_block_index(0, 0, 0, 65, 7), 0u);
  EXPECT_EQ(random_block_index(64, 0, 0, 65, 7), 8u);
  EXPECT_EQ(random_block_index(0, 1, 0, 65, 7), 9u);
  EXPECT_EQ(random_block_index(9, 2, 3, 65, 7), 9u * (3 * 7 + 2) + 1);
  EXPECT_EQ(random_block_index(3, 0, 1, 1, 2), 2u);
  for (int x = 0; x < 16; ++x) EXPECT_EQ(random_byte(0x0706050403020100u, x), x % 8);
}

// The sample has eight steps of a cube of 64: 2^21 bytes, with the index ((step 64 + z) 64 + y) 64 + x.
constexpr int kSide = 64, kSteps = 8;
constexpr std::size_t kBytes = std::size_t{kSteps} * kSide * kSide * kSide;

std::vector<std::uint8_t> sample(std::uint64_t seed, std::uint32_t first_step) {
  const RoundKeys keys = round_keys(seed);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kBytes);
  for (std::uint32_t s = first_step; s < first_step + kSteps; ++s)
    for (int z = 0; z < kSide; ++z)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          bytes.push_back(random_byte(random_block(keys, s, random_block_index(x, y, z, kSide, kSide)), x));
  return bytes;
}
const std::vector<std::uint8_t>& bytes() {
  static const std::vector<std::uint8_t> all = sample(1, 0);
  return all;
}

// Returns the deviation of `count` hits in n trials of probability p, in standard deviations.
double sigmas(double count, double n, double p) {
  return std::abs(count - n * p) / std::sqrt(n * p * (1 - p));
}

TEST(Random, EveryBitIsFair) {
  std::vector<int> ones(64);  // ones of each bit of a block
  for (std::size_t i = 0; i < kBytes; ++i)
    for (std::size_t b = 0; b < 8; ++b) ones[8 * (i % 8) + b] += bytes()[i] >> b & 1;
  double total = 0;
  for (const int count : ones) {
    EXPECT_LT(sigmas(count, kBytes / 8.0, 0.5), kSigmas);
    total += count;
  }
  EXPECT_LT(sigmas(total, 8.0 * kBytes, 0.5), kSigmas);
}

// Returns the largest deviation, in sigmas, of "bit a of one cell equals bit b of the other" over all a, b.
double worst_agreement(const std::vector<std::uint8_t>& first, const std::vector<std::uint8_t>& second,
                       std::size_t offset, std::size_t row) {
  std::array<std::array<int, 8>, 8> equal{};
  std::array<std::array<int, 256>, 8> by_rotation{};  // histogram of first xor (second rotated by r)
  int pairs = 0;
  for (std::size_t i = 0; i + offset < first.size(); ++i) {
    if (row > 0 && i / row != (i + offset) / row) continue;  // the neighbour left the row, slice or step
    ++pairs;
    for (std::size_t r = 0; r < 8; ++r)
      ++by_rotation[r][first[i] ^ std::rotr(second[i + offset], static_cast<int>(r))];
  }
  double worst = 0;
  for (std::size_t r = 0; r < 8; ++r)
    for (std::size_t v = 0; v < 256; ++v)
      for (std::size_t a = 0; a < 8; ++a)
        if (!(v >> a & 1)) equal[a][(a + r) % 8] += by_rotation[r][v];
  for (const auto& row_of : equal)
    for (const int count : row_of) worst = std::max(worst, sigmas(count, pairs, 0.5));
  return worst;
}

TEST(Random, NeighboursAreIndependent) {
  constexpr std::size_t y = kSide, z = kSide * kSide, step = kSide * kSide * kSide;
  EXPECT_LT(worst_agreement(bytes(), bytes(), 1, y), kSigmas) << "x";
  EXPECT_LT(worst_agreement(bytes(), bytes(), 8, y), kSigmas) << "next block";
  EXPECT_LT(worst_agreement(bytes(), bytes(), y, z), kSigmas) << "y";
  EXPECT_LT(worst_agreement(bytes(), bytes(), z, step), kSigmas) << "z";
  EXPECT_LT(worst_agreement(bytes(), bytes(), step, 0), kSigmas) << "step";
}

TEST(Random, SeedsAndFarStepsAreIndependent) {
  EXPECT_LT(worst_agreement(bytes(), sample(2, 0), 0, 0), kSigmas);
  EXPECT_LT(worst_agreement(bytes(), sample(1 + (std::uint64_t{1} << 32), 0), 0, 0), kSigmas);
  EXPECT_LT(worst_agreement(bytes(), sample(1, 1u << 31), 0, 0), kSigmas);
}

TEST(Random, BitPlanesAreIndependent) {
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t b = a + 1; b < 8; ++b) {
      int equal = 0;
      for (const std::uint8_t byte : bytes()) equal += !((byte >> a ^ byte >> b) & 1);
      EXPECT_LT(sigmas(equal, kBytes, 0.5), kSigmas) << a << ' ' << b;
    }
}

// Every pattern, and every subset of every set of available directions, is equally likely.
TEST(Random, PatternsAndSubsetsAreEquallyLikely) {
  std::array<int, 256> pattern{};
  for (const std::uint8_t byte : bytes()) ++pattern[byte];
  for (unsigned available = 0; available < 256; ++available) {
    std::array<int, 256> subset{};
    for (std::size_t p = 0; p < 256; ++p) subset[p & available] += pattern[p];
    const double p = std::ldexp(1.0, -std::popcount(available));
    for (unsigned s = 0; s < 256; ++s) {
      if ((s & available) != s) {
        EXPECT_EQ(subset[s], 0);
      } else if (available != 0) {
        EXPECT_LT(sigmas(subset[s], kBytes, p), kSigmas) << available << ' ' << s;
      }
    }
  }
  // All 256 patterns are tested together, too: chi-square has mean 255 and deviation sqrt(2 x 255).
  double chi2 = 0;
  for (const int count : pattern)
    chi2 += (count - kBytes / 256.0) * (count - kBytes / 256.0) / (kBytes / 256.0);
  EXPECT_LT(std::abs(chi2 - 255), kSigmas * std::sqrt(510.0));
}

// Flipping one bit of seed, step or block flips half of the output bits.
TEST(Random, Avalanche) {
  constexpr int trials = 4096;
  for (int bit = 0; bit < 128; ++bit) {
    int flipped = 0;
    for (std::uint32_t t = 0; t < trials; ++t) {
      const std::uint64_t seed = t % 7;  // seeds as users give them
      const std::uint64_t other = bit < 64 ? seed ^ std::uint64_t{1} << bit : seed;
      const std::uint32_t step = bit >= 64 && bit < 96 ? t ^ 1u << (bit - 64) : t;
      const std::uint32_t block = bit >= 96 ? 3 * t ^ 1u << (bit - 96) : 3 * t;
      flipped += std::popcount(random_block(round_keys(seed), t, 3 * t) ^
                               random_block(round_keys(other), step, block));
    }
    EXPECT_LT(sigmas(flipped, 64.0 * trials, 0.5), kSigmas) << bit;
  }
}

}  // namespace
}  // namespace voxmelt::rule
