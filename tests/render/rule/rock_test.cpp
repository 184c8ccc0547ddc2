// Noise and colours of rock are tested by hand, and by the properties that noise must have.
#include "render/rule/rock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/noise.h"

namespace voxmelt::picture {
namespace {

TEST(Noise, SmoothByHand) {
  EXPECT_EQ(smooth(0), 0);
  EXPECT_EQ(smooth(64), 40);  // 5/32 of 256
  EXPECT_EQ(smooth(128), 128);
  EXPECT_EQ(smooth(192), 216);  // 27/32 of 256
  EXPECT_EQ(smooth(256), 256);
  EXPECT_EQ(smooth_step(100, 200, 100), 0);
  EXPECT_EQ(smooth_step(100, 200, -5000), 0);
  EXPECT_EQ(smooth_step(100, 200, 150), 128);
  EXPECT_EQ(smooth_step(100, 200, 9000), 256);
}

// The hash is worked out in Python, mod 2^32: (1, 0, 0) of kind 0, (-1, 2, 3) of kind 5.
TEST(Noise, LatticeByHand) {
  EXPECT_EQ(lattice({0, 0, 0}, 0), -4096);  // 0 stays 0
  EXPECT_EQ(lattice({1, 0, 0}, 0), 3388);
  EXPECT_EQ(lattice({-1, 2, 3}, 5), -1628);
}

TEST(Noise, IsTheLatticeAtItsPointsAndHalfwayBetween) {
  const Vector p{3 * kCell, -2 * kCell, 7 * kCell};
  EXPECT_EQ(noise(p, 1), lattice({3, -2, 7}, 1));
  const std::int32_t next = lattice({3, -1, 7}, 1);
  EXPECT_EQ(noise(p + Vector{0, kCell / 2, 0}, 1), (lattice({3, -2, 7}, 1) + next + 1) >> 1);
}

// A number that is even in -1 .. 1 has the mean 0 and the spread 1 / sqrt 3. Neighbours are alike only where
// a lattice's cell is wide.
TEST(Noise, LatticeIsEven) {
  double sum = 0, squares = 0, beside = 0;
  int count = 0;
  for (int x = -20; x < 20; ++x)
    for (int y = -20; y < 20; ++y)
      for (int z = -20; z < 20; ++z, ++count) {
        const double a = lattice({x, y, z}, 3) / 4096.0;
        sum += a;
        squares += a * a;
        beside += a * lattice({x + 1, y, z}, 3) / 4096.0;
      }
  EXPECT_NEAR(sum / count, 0, 0.01);
  EXPECT_NEAR(squares / count, 1.0 / 3, 0.01);
  EXPECT_NEAR(beside / count, 0, 0.01);
}

TEST(Noise, LayeredByHand) {
  // At the origin the second octave lies at (1/16, 11/16, 5/16) beyond (1, 5, 31).
  const std::int32_t first = lattice({0, 0, 0}, 7), second = noise(kOctaveMoved, 8);
  EXPECT_EQ(layered_noise({0, 0, 0}, 3, 1, 7), first * 9 >> 4);
  EXPECT_EQ(layered_noise({0, 0, 0}, 3, 2, 7), (first + (second >> 1)) * 9 >> 4);
  // With a spacing of 8 cells, the first octave is at its next point at 8 cells along x. The second is at
  // twice that, with the axes exchanged.
  const std::int32_t one = lattice({1, 0, 0}, 7), turned = noise(Vector{0, 2 * kCell, 0} + kOctaveMoved, 8);
  EXPECT_EQ(layered_noise({8 * kCell, 0, 0}, 3, 2, 7), (one + (turned >> 1)) * 9 >> 4);
}

// The base is 1 in each channel. Low and level rock has 236, 251, 220 of 256, and high and level rock 287,
// 261, 241. A cliff takes three quarters of 159, 154, 154.
TEST(Rock, ColorByHand) {
  const Vector one{kColor, kColor, kColor};
  EXPECT_EQ(rock_color(one, 0, 1 << kNormalBits, 0, 0), (Vector{236 * 16, 251 * 16, 220 * 16}));
  EXPECT_EQ(rock_color(one, kHeight, 1 << kNormalBits, 0, 0), (Vector{287 * 16, 261 * 16, 241 * 16}));
  // 236 + (-77 x 192 + 128) / 256, rounded down, is 236 - 58. Likewise the others are 251 - 73 and 220 - 49.
  EXPECT_EQ(rock_color(one, 0, 0, 0, 0), (Vector{178 * 16, 178 * 16, 171 * 16}));
  // A grain of 1 lightens by 31 x 16 of 4096.
  EXPECT_EQ(rock_color(one, 0, 1 << kNormalBits, 0, 4096).x, 236 * 16 * 4592 / 4096);
  EXPECT_EQ(cut_color(one, 0), (Vector{2540, 2540, 2540}));
  EXPECT_EQ(cut_color(one, 4096), (Vector{3196, 3196, 3196}));
}

TEST(Rock, ElevationByHand) {
  EXPECT_EQ(elevation(3 * kCell, 2 * kHeight, 6 * kHeight), 1024);
  EXPECT_EQ(elevation(2 * kCell, 2 * kHeight, 2 * kHeight), 0);
}

// A fall of 1024 (a quarter) over half a cell, where texels lie a quarter apart, is a slope of a half. It
// counts times 0.22 in 256ths.
TEST(Rock, BumpByHand) {
  EXPECT_EQ(bump(1024, 0, 2), 28);  // 28.16
  EXPECT_EQ(bump(0, 1024, 2), -29);
  EXPECT_EQ(bump(1024, 0, 1), 14);
  EXPECT_EQ(bump(30000, 0, 2), 127);
  const Vector n = roughened({0, 1 << kNormalBits, 0}, 1 << kNormalBits >> 1, 0);
  EXPECT_NEAR(static_cast<double>(n.x), 16384 / std::sqrt(5), 2);
}

TEST(Rock, TexelsOfAnyGridAreFew) {
  for (const std::int64_t side : {1, 128, 129, 256, 257, 512, 1024}) {
    const std::int64_t texels = side << texel_fineness({side, 8, 1});
    EXPECT_LE(texels, std::max<std::int64_t>(512, side));
    EXPECT_GE(texels, side);
  }
  EXPECT_EQ(texel_middle(0, 2), kCell / 8);
  EXPECT_EQ(texel_middle(3, 1), kCell * 7 / 4);
}

}  // namespace
}  // namespace voxmelt::picture
