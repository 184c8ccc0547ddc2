// Rounding and the dither are tested.
#include "kernel/automaton/rule/fixed_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt::rule {
namespace {

// Returns floor(a / b) without shifts.
std::int64_t floored(std::int64_t a, std::int64_t b) {
  std::int64_t q = a / b;
  while (q * b > a) --q;
  while ((q + 1) * b <= a) ++q;
  return q;
}

TEST(Scaled, RoundsTowardsMinusInfinity) {
  for (const std::int32_t w : {0, 1, 2, 5461, 10922, 32767, 32768, 65535, 65536})
    for (const std::int32_t r : {0, 1, 32768, 65535})
      for (std::int32_t a = -65535; a <= 65535; a += 7)
        ASSERT_EQ(scaled(a, w, r), floored(std::int64_t{a} * w + r, 65536)) << a << " x " << w << " + " << r;
  EXPECT_EQ(scaled(-1, 1), -1);
  EXPECT_EQ(scaled(-1, 1, 65535), 0);
  EXPECT_EQ(scaled(1, 65535), 0);
  EXPECT_EQ(scaled(65535, 65536), 65535);
  EXPECT_EQ(scaled(-65535, 65536), -65535);
}

TEST(Dither, IsTheBitsOfTheStepInReverse) {
  EXPECT_EQ(dither(0), 0);
  EXPECT_EQ(dither(1), 32768);
  EXPECT_EQ(dither(2), 16384);
  EXPECT_EQ(dither(3), 49152);
  EXPECT_EQ(dither(0x8000), 1);
  EXPECT_EQ(dither(0x1234), 0x2C48);  // 0001 0010 0011 0100 -> 0010 1100 0100 1000
  EXPECT_EQ(dither(0xFFFF), 65535);
  EXPECT_EQ(dither(0x10000), dither(0));
  EXPECT_EQ(dither(0xABCD1234), dither(0x1234));
}

TEST(Dither, PartsAreEvenlySpaced) {
  EXPECT_EQ(dither(0, 1, 3), 21845);
  EXPECT_EQ(dither(0, 2, 3), 43690);
  EXPECT_EQ(dither(1, 2, 3), (32768 + 43690) % 65536);
  for (const int n : {3, 4, 6})
    for (std::uint32_t s = 0; s < 65536; s += 13)
      for (int k = 0; k < n; ++k) ASSERT_EQ(dither(s, k, n), (dither(s) + 65536 * k / n) % 65536);
}

// Any 2^m steps from a multiple of 2^m on hit each interval of 65536 / 2^m exactly once. All 65536 steps hit
// every value.
TEST(Dither, CoversEvenly) {
  for (const int n : {1, 3, 4, 6})
    for (int k = 0; k < n; ++k)
      for (int m = 0; m <= 16; m += n == 1 ? 1 : 4)
        for (const std::uint32_t run : {0u, 1u, 5u}) {
          const std::uint32_t length = 1u << m;
          const std::int32_t shift = 65536 * k / n;
          std::vector<int> hits(length);
          for (std::uint32_t s = run * length; s < (run + 1) * length; ++s) {
            const std::int32_t r = (dither(s, k, n) + 65536 - shift) % 65536;
            ++hits[static_cast<std::size_t>(r >> (16 - m))];
          }
          ASSERT_TRUE(std::all_of(hits.begin(), hits.end(), [](int h) { return h == 1; }))
              << n << ' ' << k << ' ' << m;
        }
}

// Therefore a flow of any fraction of a unit arrives in full over 65536 steps.
TEST(Dither, SumsToTheExactFlow) {
  for (const std::int32_t a : {-40000, -3, -1, 1, 2, 777, 65535})
    for (const std::int32_t w : {1, 3, 10922}) {
      std::int64_t sum = 0;
      for (std::uint32_t s = 0; s < 65536; ++s) sum += scaled(a, w, dither(s, 1, 3));
      EXPECT_EQ(sum, std::int64_t{a} * w);
    }
}

}  // namespace
}  // namespace voxmelt::rule
