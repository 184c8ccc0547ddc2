// The ray caster's ground is tested alone, by the worked ray of docs/picture/ground.md, section 9, and by
// hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "hwmodel/caster/model/ground.h"
#include "hwmodel/caster/model/ground_blocks.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::int64_t kOne = std::int64_t{1} << 20;

Registers slab(std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t highest) {
  Registers registers;
  registers.cells = {x, y, z};
  registers.ground.any = true;
  registers.ground.highest = highest;
  return registers;
}

// The grid has two columns along x and one along z. Outside, the nearest column counts.
std::int64_t worked_height(Vec p) {
  const auto column = [](std::int64_t i) { return std::int64_t{i <= 0 ? 32768 : 16384}; };
  const Spot x = spot_of(p.x), z = spot_of(p.z);
  return between_columns([&](std::size_t n) { return column(x.cell + static_cast<std::int64_t>(n & 1)); }, x,
                         z);
}

TEST(RaycastGround, TheWorkedRay) {
  const Registers registers = slab(2, 8, 1, 32768);
  const Ray ray{{1838153, 4456448, 524288}, {262144, -272629, 0}};
  const Parts parts = parts_of(registers, ray);
  EXPECT_EQ(parts.first, 0);
  EXPECT_EQ(parts.last, 252);
  EXPECT_EQ(at_part(ray, 253).x, 2097225);
  EXPECT_EQ(spot_of(ray.start.x).cell, 1);
  EXPECT_EQ(spot_of(ray.start.x).weight, 65);
  EXPECT_EQ(worked_height(ray.start), 16384);
  EXPECT_EQ(ray.start.y >> 8, 17408);
  EXPECT_EQ(at_part(ray, 252), (Vec{2096201, 4188078, 524288}));

  const auto in_ground = [&](std::int64_t t) {
    const Vec p = at_part(ray, t);
    return in_slab(registers, p) && (p.y >> 8) < worked_height(p);
  };
  std::int64_t outside = 0, inside = 252;
  ASSERT_FALSE(in_ground(outside));
  ASSERT_TRUE(in_ground(inside));
  std::vector<std::int64_t> middles;
  while (inside - outside > 1) {
    middles.push_back((outside + inside) / 2);
    (in_ground(middles.back()) ? inside : outside) = middles.back();
  }
  EXPECT_EQ(middles, (std::vector<std::int64_t>{126, 189, 220, 236, 244, 248, 246, 247}));
  EXPECT_EQ(inside, 247);
  EXPECT_EQ(at_part(ray, inside), (Vec{2091081, 4193403, 524288}));
  EXPECT_EQ(face_of(registers, at_part(ray, outside)), Face::top);
}

// By hand, 100 and 300 at 64/256 give 150, and 500 and 1000 give 625. These two at 192/256 give 506.
TEST(RaycastGround, AHeightIsBlendedAlongXAndThenZ) {
  const std::array<std::int64_t, 4> columns{100, 300, 500, 1000};
  const auto value = [&](std::size_t n) { return columns[n]; };
  EXPECT_EQ(between_columns(value, {0, 64}, {0, 192}), 506);
  EXPECT_EQ(between_columns(value, {0, 0}, {0, 0}), 100);
}

// The sixteen columns begin at (5, -1). Entry 4 z + x has 100 (4 z + x)^2.
TEST(RaycastGround, SixteenColumnsHoldAPlaceAndHalfACellAround) {
  NearColumns columns{5, -1, {}};
  for (std::int32_t i = 0; i < 16; ++i) columns.columns[static_cast<std::size_t>(i)] = {100 * i * i, -i};
  // The position for cell c and weight w is c + 1/2 cells and w 2^12.
  const auto place = [](std::int64_t cell, std::int64_t weight) {
    return cell * kOne + kOne / 2 + (weight << 12);
  };
  // Entries 5, 6, 9 and 10 count. 2500 and 3600 give 3050, 8100 and 10000 give 9050, and a quarter on is
  // 4550.
  EXPECT_EQ(columns.height(&Column::drawn, place(6, 128), place(0, 64)), 4550);
  EXPECT_EQ(columns.height(&Column::drawn, place(5, 0), place(-1, 0)), 0);
  EXPECT_EQ(columns.height(&Column::drawn, place(6, 0), place(-1, 0)), 100);
  EXPECT_EQ(columns.height(&Column::drawn, place(5, 0), place(0, 0)), 1600);
  EXPECT_EQ(columns.height(&Column::drawn, place(7, 0), place(1, 0)), 10000);
  EXPECT_EQ(columns.height(&Column::bare, place(6, 0), place(0, 0)), -5);
}

TEST(RaycastGround, TheFirstAndTheLastPartAreThoseOfAPlainSearch) {
  std::mt19937_64 random(21);
  const auto within = [&](std::int64_t n) {
    return static_cast<std::int64_t>(random() % static_cast<unsigned>(2 * n)) - n;
  };
  int found = 0;
  for (int n = 0; n < 3000; ++n) {
    const Registers registers = slab(1 + n % 2, 3, 1, 1 + static_cast<std::int64_t>(random() % 12288));
    const Ray ray{{within(2 * kOne), within(2 * kOne), within(2 * kOne)},
                  {n % 7 == 0 ? 0 : within(kOne / 4), n % 5 == 0 ? 0 : within(kOne / 4),
                   n % 11 == 0 ? 0 : within(kOne / 4)}};
    std::int64_t first = -1, last = -1;
    for (std::int64_t t = 0; t < 256 * 40; ++t) {
      const Vec p = ray.start + ((ray.step * t) >> 8);
      const bool in = p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < registers.cells.x * kOne &&
                      p.y < 256 * registers.ground.highest && p.z < kOne;
      if (in && first < 0) first = t;
      if (in) last = t;
    }
    const Parts parts = parts_of(registers, ray);
    if (last == 256 * 40 - 1) continue;  // a ray that is almost at rest
    if (first < 0) {
      ASSERT_TRUE(parts.first > parts.last || parts.first >= 256 * 40) << n;
      continue;
    }
    ASSERT_EQ(parts.first, first) << n;
    ASSERT_EQ(parts.last, last) << n;
    ++found;
  }
  EXPECT_GT(found, 200);
}

// At a quarter of a cell a step, part 1024 is exactly on the high side, which is outside. So is the start of
// the way back.
TEST(RaycastGround, TheHighSideIsOutside) {
  const Registers registers = slab(1, 1, 1, 4096);
  const std::int64_t quarter = kOne / 4, half = kOne / 2;
  for (const Vec& step : {Vec{quarter, 0, 0}, Vec{0, quarter, 0}, Vec{0, 0, quarter}}) {
    const Vec side{step.x == 0 ? half : 0, step.y == 0 ? half : 0, step.z == 0 ? half : 0};
    const Parts parts = parts_of(registers, {side, step});
    EXPECT_EQ(parts.first, 0);
    EXPECT_EQ(parts.last, 1023);
    const Parts back = parts_of(registers, {side + step * 4, Vec{} - step});
    EXPECT_EQ(back.first, 1);
    EXPECT_EQ(back.last, 1024);
  }
}

TEST(RaycastGround, FacesInTheirOrder) {
  const Registers registers = slab(2, 8, 3, 4096);
  EXPECT_EQ(face_of(registers, {-1, -5, -5}), Face::low_x);
  EXPECT_EQ(face_of(registers, {2 * kOne, -5, -5}), Face::high_x);
  EXPECT_EQ(face_of(registers, {2 * kOne - 1, -5, -1}), Face::low_z);
  EXPECT_EQ(face_of(registers, {0, -5, 3 * kOne}), Face::high_z);
  EXPECT_EQ(face_of(registers, {0, -1, 3 * kOne - 1}), Face::under);
  EXPECT_EQ(face_of(registers, {0, 0, 0}), Face::top);
  EXPECT_EQ(side_normal(Face::low_x), (Vec{-16384, 0, 0}));
  EXPECT_EQ(side_normal(Face::high_x), (Vec{16384, 0, 0}));
  EXPECT_EQ(side_normal(Face::low_z), (Vec{0, 0, -16384}));
  EXPECT_EQ(side_normal(Face::high_z), (Vec{0, 0, 16384}));
  EXPECT_EQ(side_normal(Face::under), (Vec{0, -16384, 0}));
  EXPECT_EQ(side_normal(Face::none), (Vec{}));
  EXPECT_TRUE(in_slab(registers, {0, 0, 0}));
  EXPECT_FALSE(in_slab(registers, {0, -1, 0}));
  EXPECT_FALSE(in_slab(registers, {2 * kOne, 0, 0}));
  EXPECT_FALSE(in_slab(registers, {0, 0, -1}));
  EXPECT_TRUE(in_slab(registers, {2 * kOne - 1, 0, 3 * kOne - 1}));
}

// In random columns, the distance straight down shrinks by no more than `approach` from one sample to the
// next, apart from what the margin covers.
TEST(RaycastGround, ARayComesNoNearerThanItsApproach) {
  std::mt19937_64 random(22);
  int near = 0;
  for (int n = 0; n < 300; ++n) {
    std::array<std::array<std::int64_t, 8>, 8> heights{};  // [z][x]
    for (auto& row : heights)
      for (std::int64_t& height : row)
        height = static_cast<std::int64_t>(random() % (n % 2 == 0 ? 512 : 16384));
    std::int64_t u = 0, v = 0;
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b < 7; ++b) {
        u = std::max(u, magnitude(heights[a][b] - heights[a][b + 1]));
        v = std::max(v, magnitude(heights[b][a] - heights[b + 1][a]));
      }
    const Vec slopes{u, 0, v};
    const auto height = [&](Vec p) {
      const Spot x = spot_of(p.x), z = spot_of(p.z);
      const auto inside = [](std::int64_t i) {
        return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, 7));
      };
      return between_columns(
          [&](std::size_t i) {
            return heights[inside(z.cell + static_cast<std::int64_t>(i >> 1))]
                          [inside(x.cell + static_cast<std::int64_t>(i & 1))];
          },
          x, z);
    };
    const auto within = [&](std::int64_t m) {
      return static_cast<std::int64_t>(random() % static_cast<unsigned>(2 * m)) - m;
    };
    const Ray ray{{within(2 * kOne), 6 * kOne, within(2 * kOne)},
                  {within(kOne / 4), -kOne / 8, within(kOne / 4)}};
    const auto above = [&](std::int64_t k) {
      const Vec p = ray.start + ray.step * k;
      return ((p.y >> 8) - height(p)) << 20;  // 2^-32 cells
    };
    const std::int64_t approach = approach_of(slopes, ray.step), margin = margin_of(slopes);
    for (std::int64_t k = 0; k < 40; ++k)
      for (std::int64_t steps = 1; steps < 12; ++steps) {
        ASSERT_GE(above(k + steps), above(k) - steps * approach - margin) << n;
        near += 16 * (above(k) - above(k + steps)) > 15 * steps * approach ? 1 : 0;
      }
  }
  EXPECT_GT(near, 20);  // some come almost so near
}

// Six columns along x, and one along z, hold 0, 4096, 4096, 0, 0, 12345. Block 0 reads columns 0 .. 4, and
// block 1 those from 3 on. Bounds are rounded up to 64, so 12345 becomes 193.
TEST(RaycastGround, BoundsOfBlocksByHand) {
  const std::array<std::int64_t, 6> heights{0, 4096, 4096, 0, 0, 12345};
  const GroundBlocks blocks =
      ground_blocks(6, 1, [&](std::int64_t x, std::int64_t) { return heights[static_cast<std::size_t>(x)]; });
  EXPECT_EQ(blocks.x, 2);
  EXPECT_EQ(blocks.z, 1);
  EXPECT_EQ(blocks.fine, (std::vector<GroundBlock>{{64, 64, 0}, {193, 193, 0}}));
  EXPECT_EQ(blocks.coarse, (std::vector<std::int32_t>{193}));
}

// Block 0 has a bound of 2 cells, and the ray is 2 1/2 cells high. It falls by 1/8 cell a sample, so 4
// samples pass. By its quarter of a cell along x it would stay for 9 more from 3/2 on: the last one is at
// 15/4.
TEST(RaycastGround, SamplesAboveABlockByHand) {
  GroundBlocks blocks;
  blocks.x = blocks.z = 1;
  blocks.fine = {{128, 0, 0}};
  blocks.coarse = {9999};
  const auto from = [&](Vec p, Vec step) { return samples_above(blocks, searcher_of({p, step}), p); };
  const std::int64_t half = kOne / 2, quarter = kOne / 4, eighth = kOne / 8;
  const auto near = [](std::optional<std::int64_t> found, std::int64_t exact) {
    return found && *found <= exact && *found >= exact - 1;  // a reciprocal is a little too small
  };
  EXPECT_TRUE(near(from({3 * half, 5 * half, kOne}, {quarter, -eighth, 0}), 4));
  EXPECT_TRUE(near(from({3 * half, 50 * half, kOne}, {quarter, -eighth, 0}), 9));
  EXPECT_TRUE(near(from({3 * half, 5 * half, kOne}, {-quarter, eighth, 0}), 6));
  EXPECT_TRUE(near(from({3 * half, 5 * half, kOne}, {-quarter, eighth, -quarter}), 4));
  EXPECT_EQ(from({3 * half, 4 * half, kOne}, {0, 0, 0}), kAlways);
  EXPECT_EQ(from({3 * half, 4 * half - 1, kOne}, {0, eighth, 0}), std::nullopt);
}

// In random columns and rays, no sample that is left out lies in the ground, and many are left out.
TEST(RaycastGround, NoSampleIsLeftOutInTheGround) {
  std::mt19937_64 random(23);
  std::int64_t above = 0, over = 0, next = 0;
  for (int n = 0; n < 400; ++n) {
    const std::int64_t nx = 3 + static_cast<std::int64_t>(random() % 40),
                       nz = 2 + static_cast<std::int64_t>(random() % 30);
    std::vector<std::int64_t> columns(static_cast<std::size_t>(nx * nz));
    const std::int64_t rough = n % 3 == 0 ? 40 : n % 3 == 1 ? 3000 : 20000;
    for (std::int64_t i = 0; i < nx * nz; ++i)
      columns[static_cast<std::size_t>(i)] =
          (n % 2 == 0 ? 300 * (i % nx) : 0) +
          static_cast<std::int64_t>(random() % static_cast<unsigned>(rough));
    const auto column = [&](std::int64_t x, std::int64_t z) {
      return columns[static_cast<std::size_t>(std::clamp<std::int64_t>(z, 0, nz - 1) * nx +
                                              std::clamp<std::int64_t>(x, 0, nx - 1))];
    };
    const GroundBlocks blocks = ground_blocks(nx, nz, column);
    const auto height = [&](Vec p) {
      const Spot x = spot_of(p.x), z = spot_of(p.z);
      return between_columns(
          [&](std::size_t i) {
            return column(x.cell + static_cast<std::int64_t>(i & 1),
                          z.cell + static_cast<std::int64_t>(i >> 1));
          },
          x, z);
    };
    const auto in_slab = [&](Vec p) { return p.x >= 0 && p.z >= 0 && p.x < nx * kOne && p.z < nz * kOne; };
    const auto within = [&](std::int64_t m) {
      return static_cast<std::int64_t>(random() % static_cast<unsigned>(2 * m)) - m;
    };
    const Ray ray{{static_cast<std::int64_t>(random() % static_cast<unsigned>(nx * kOne)), within(8 * kOne),
                   static_cast<std::int64_t>(random() % static_cast<unsigned>(nz * kOne))},
                  {within(kOne / 4), within(kOne / 8), within(kOne / 4)}};
    const Searcher searcher = searcher_of(ray);
    for (std::int64_t part = 0; part < 256 * 60; part += n % 5 == 0 ? 77 : 256) {
      const Vec p = at_part(ray, part);
      if (!in_slab(p)) break;
      const std::int64_t over_ground = (p.y >> 8) - height(p);
      const auto left_out = [&](std::int64_t samples) {
        for (std::int64_t k = (part >> 8) + 1; k <= (part >> 8) + std::min<std::int64_t>(samples, 80); ++k) {
          const Vec at = at_part(ray, 256 * k);
          ASSERT_FALSE(in_slab(at) && (at.y >> 8) < height(at)) << n << " " << part << " " << k;
        }
      };
      const std::optional<std::int64_t> samples = samples_above(blocks, searcher, p);
      if (samples) {
        ASSERT_GE(over_ground, 0) << n;
        left_out(*samples);
        above += *samples > 0 ? 1 : 0;
      } else if (over_ground >= 0) {
        const std::int64_t more = samples_over_slopes(blocks, searcher, p, over_ground);
        left_out(more);
        (more > 0 ? over : next) += 1;
      }
    }
  }
  EXPECT_GT(above, 1000);
  EXPECT_GT(over, 200);
  EXPECT_GT(next, 200);
}

void expect_near(Vec vector, Vec expected) {
  EXPECT_LE(largest(vector - expected), 2) << vector.x << " " << vector.y << " " << vector.z;
}

// 16384 / sqrt 2 is 11585. For 2048 : 4096 it is 16384 / sqrt 5 = 7327, and 14654.
TEST(RaycastGround, NormalsOfTheTopByHand) {
  const Registers registers = slab(2, 8, 2, 4096);
  const Vec middle{kOne, kOne, kOne};
  EXPECT_EQ(top_normal(registers, middle, {500, 500, 700, 700}), (Vec{0, 16384, 0}));
  expect_near(top_normal(registers, middle, {5096, 1000, 700, 700}), {11585, 11585, 0});
  expect_near(top_normal(registers, middle, {0, 0, 1000, 5096}), {0, 11585, -11585});
  expect_near(top_normal(registers, {kOne / 4, kOne, kOne}, {9, 9, 9, 9}), {-7327, 14654, 0});
  expect_near(top_normal(registers, {kOne, kOne, 2 * kOne - kOne / 4}, {9, 9, 9, 9}), {0, 14654, 7327});
  // A fall of 2^20 has 21 bits and is shifted by 7: 8192 to 32.
  expect_near(top_normal(registers, middle, {1 << 20, 0, 9, 9}), {16384, 64, 0});
  EXPECT_EQ(top_normal(registers, middle, {1 << 20, 0, 209, 9}).z, 2);  // 200 becomes 1 of 8192
}

// At half a cell the table of quarters is read at 2, half way between entries 1 and 2: -500. A bend of an
// eighth of a cell leads to entry 2. 2540 + (41 x -500 >> 8) = 2459; 2540 + (41 x -3000 >> 8) = 2059.
TEST(RaycastGround, ColoursOfTheCutByHand) {
  GroundRegisters ground;
  ground.color = {4096, 1000, 2};
  ground.textured = true;
  ground.bands = {1000, 2000, -3000, 400};
  ground.bends = {{{0}, {0}, {1 << 17}, {0, 1 << 18}}};
  const Vec p{kOne, kOne / 2, kOne / 2};
  EXPECT_EQ(cut_color(ground, p, Face::low_x), (Rgb{2459, 600, 1}));
  EXPECT_EQ(cut_color(ground, p, Face::high_x), (Rgb{2459, 600, 1}));
  EXPECT_EQ(cut_color(ground, p, Face::low_z), (Rgb{2059, 502, 1}));
  EXPECT_EQ(cut_color(ground, p, Face::high_z), (Rgb{2059, 502, 1}));  // half way between 0 and 2^18
  EXPECT_EQ(cut_color(ground, p, Face::under), (Rgb{2540, 620, 1}));
  EXPECT_EQ(cut_color(ground, p, Face::none), (Rgb{2540, 620, 1}));
  ground.textured = false;
  EXPECT_EQ(cut_color(ground, p, Face::low_z), (Rgb{2540, 620, 1}));
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
