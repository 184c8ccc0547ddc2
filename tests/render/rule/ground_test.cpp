// The ground's heights, faces and crossings are tested by hand, and against a dense march in double.
#include "render/rule/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "render/rule/camera.h"
#include "render/rule/fixed_point.h"
#include "render/rule/heights.h"
#include "render/rule/ray.h"
#include "tests/render/rule/dense_ground.h"

namespace voxmelt::picture {
namespace {

constexpr std::int64_t kHalf = kCell / 2;

struct Land {
  Vector cells;
  std::vector<std::int32_t> heights;
  std::int32_t operator()(std::int64_t x, std::int64_t z) const {
    return heights[static_cast<std::size_t>(z * cells.x + x)];
  }
  std::int32_t highest() const { return *std::max_element(heights.begin(), heights.end()); }
  GroundCrossing met_by(const Ray& ray) const { return first_ground(*this, cells, highest(), ray); }
};

Land flat(Vector cells, std::int32_t height) {
  return {cells, std::vector<std::int32_t>(static_cast<std::size_t>(cells.x * cells.z), height)};
}

TEST(Heights, FiltersByHand) {
  EXPECT_EQ(softened(0, 1, 0), 1);    // (2 + 2) / 4
  EXPECT_EQ(softened(1, 0, 0), 0);    // 3 / 4
  EXPECT_EQ(softened(-4, 0, 1), -1);  // -1 / 4, rounded down
  EXPECT_EQ(lowered(8192, 4096), 6144);
  EXPECT_EQ(lowered(8192, 1), 8191);
  EXPECT_EQ(lowered(8192, 0), 8192);
}

// The columns are 0 and 256 along x, and the same plus 512 behind. Halves and quarters are taken, and the
// ends repeat.
TEST(Heights, BetweenColumnsByHand) {
  const Land land{{2, 4, 2}, {0, 256, 512, 768}};
  const auto at = [&](std::int64_t x, std::int64_t z) { return height_at(land, land.cells, x, z); };
  EXPECT_EQ(at(kHalf, kHalf), 0);
  EXPECT_EQ(at(kCell, kHalf), 128);
  EXPECT_EQ(at(kCell + kCell / 4, kCell), 192 + 256);
  EXPECT_EQ(at(0, 0), 0);
  EXPECT_EQ(at(2 * kCell - 1, 0), 256);
  EXPECT_EQ(at(2 * kCell - 1, 2 * kCell - 1), 768);
}

// The widest product of two columns is 1024 cells, times 256.
TEST(Heights, TheHighestFit32Bits) {
  const std::int32_t most = 1024 * kHeight;
  static_assert(std::int64_t{1024} * kHeight * kWeights + kWeights / 2 < std::int64_t{1} << 31);
  EXPECT_EQ(height_at(flat({3, 1024, 3}, most), {3, 1024, 3}, kCell + 12345, kCell + 67890), most);
}

TEST(Ground, IsWhatLiesBelowTheHeights) {
  const Land land = flat({4, 8, 4}, 2 * kHeight);
  const auto in = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return in_ground(land, land.cells, {x, y, z});
  };
  EXPECT_TRUE(in(0, 0, 0));
  EXPECT_TRUE(in(4 * kCell - 1, 2 * kCell - 1, 4 * kCell - 1));
  EXPECT_FALSE(in(kCell, 2 * kCell, kCell));
  EXPECT_FALSE(in(kCell, -1, kCell));
  EXPECT_FALSE(in(-1, kCell, kCell));
  EXPECT_FALSE(in(4 * kCell, kCell, kCell));
  EXPECT_FALSE(in(kCell, kCell, -1));
  EXPECT_FALSE(in(kCell, kCell, 4 * kCell));
}

// A slab two cells high is met from all six sides at steps of a quarter of a cell. The distances are those of
// the faces, in 256ths of a step. On the far sides the first place inside comes after the face.
TEST(Ground, ASlabFromAllSides) {
  const Land land = flat({4, 8, 4}, 2 * kHeight);
  struct Case {
    Vector start, step, normal;
    Face face;
    std::int64_t part;
  };
  const std::int64_t q = kCell / 4, m = 1 << 14;
  const Case cases[] = {
      {{-3 * kCell, kCell, kCell}, {q, 0, 0}, {-m, 0, 0}, Face::low_x, 3 * 1024},
      {{7 * kCell, kCell, kCell}, {-q, 0, 0}, {m, 0, 0}, Face::high_x, 3 * 1024 + 1},
      {{kCell, kCell, -3 * kCell}, {0, 0, q}, {0, 0, -m}, Face::low_z, 3 * 1024},
      {{kCell, kCell, 7 * kCell}, {0, 0, -q}, {0, 0, m}, Face::high_z, 3 * 1024 + 1},
      {{kCell, -3 * kCell, kCell}, {0, q, 0}, {0, -m, 0}, Face::under, 3 * 1024},
      {{kCell, 5 * kCell, kCell}, {0, -q, 0}, {0, m, 0}, Face::top, 3 * 1024 + 1},
  };
  for (const Case& c : cases) {
    const GroundCrossing got = land.met_by({c.start, c.step});
    ASSERT_TRUE(got.found);
    EXPECT_EQ(got.face, c.face);
    EXPECT_EQ(got.part, c.part);
    EXPECT_EQ(got.position, c.start + ((c.step * c.part) >> 8));
    EXPECT_EQ(ground_normal(land, land.cells, got.position, got.face), c.normal);
  }
}

// A ray through no sample of the slab cuts an edge off.
TEST(Ground, AnEdgeBetweenTwoSamplesIsMet) {
  const Land land = flat({4, 8, 4}, 2 * kHeight);
  const std::int64_t q = kCell / 4;
  // From x = -0.15 and y = 0.24 the ray goes down by a cell for each cell along x. It goes in at x = 0 and y
  // = 0.09, and out at x = 0.09 and y = 0.
  const std::int64_t y = kCell * 24 / 100;
  const Ray ray{{-kCell * 15 / 100, y, kCell}, {q, -q, 0}};
  EXPECT_FALSE(in_ground(land, land.cells, ray.at(0)) || in_ground(land, land.cells, ray.at(1)));
  const GroundCrossing got = land.met_by(ray);
  ASSERT_TRUE(got.found);
  EXPECT_EQ(got.face, Face::low_x);
  EXPECT_EQ(got.part, 154);  // 0.15 x 1024 = 153.6, rounded up
  EXPECT_FALSE(land.met_by({{-kCell * 26 / 100, y, kCell}, {q, -q, 0}}).found);
}

// In the worked ray of docs/picture/ground.md, section 9, a ray goes in through the top and out through a
// side within one step.
TEST(Ground, WhereARayLeavesIsLookedAt) {
  const Land land{{2, 8, 1}, {8 * kHeight, 4 * kHeight}};
  // Beyond x = 1.5 the ground is 4 cells high. The ray is 0.25 above it, and below it after 25/26 of a step.
  // A step ends beyond x = 2.
  const Ray ray{{kCell * 1753 / 1000, 4 * kCell + kCell / 4, kHalf}, {kCell / 4, -kCell * 26 / 100, 0}};
  EXPECT_FALSE(in_ground(land, land.cells, ray.at(0)) || in_ground(land, land.cells, ray.at(1)));
  const GroundCrossing got = land.met_by(ray);
  ASSERT_TRUE(got.found);
  EXPECT_EQ(got.face, Face::top);
  EXPECT_EQ(got.part, 247);  // 25 / 26 of 256, rounded up
  EXPECT_EQ(got.position, (Vector{2091081, 4193403, kHalf}));
  const Samples in = ground_parts(land.cells, land.highest(), ray);
  EXPECT_EQ(in.first, 0);
  EXPECT_EQ(in.last, 252);
  EXPECT_EQ(position_at(ray, 252), (Vector{2096201, 4188078, kHalf}));
  EXPECT_EQ(place_of(ray.start.x).weight, 65);
}

TEST(Ground, ARayThatStartsInsideIsThere) {
  const GroundCrossing got = flat({4, 8, 4}, 2 * kHeight).met_by({{kCell, kCell, kCell}, {kCell / 4, 0, 0}});
  EXPECT_TRUE(got.found);
  EXPECT_EQ(got.part, 0);
  EXPECT_EQ(got.position, (Vector{kCell, kCell, kCell}));
  EXPECT_EQ(got.face, Face::none);
}

TEST(Ground, HeightZeroIsNoGround) {
  const Land none = flat({4, 8, 4}, 0), lowered_land = flat({4, 8, 4}, -2048);
  for (const Land& land : {none, lowered_land}) {
    EXPECT_FALSE(land.met_by({{kCell, 3 * kCell, kCell}, {0, -kCell / 4, 0}}).found);
    EXPECT_FALSE(land.met_by({{-kCell, 0, kCell}, {kCell / 4, 0, 0}}).found);
    EXPECT_FALSE(land.met_by({{kCell, -kCell, kCell}, {0, kCell / 4, 0}}).found);
  }
}

// At corners, a side along x goes first, then one along z, then the underside.
TEST(Ground, TiesOfFaces) {
  const Vector cells{4, 8, 4};
  EXPECT_EQ(face_before(cells, {-1, -1, -1}), Face::low_x);
  EXPECT_EQ(face_before(cells, {4 * kCell, -1, 4 * kCell}), Face::high_x);
  EXPECT_EQ(face_before(cells, {0, -1, -1}), Face::low_z);
  EXPECT_EQ(face_before(cells, {0, -1, 4 * kCell}), Face::high_z);
  EXPECT_EQ(face_before(cells, {0, -1, 0}), Face::under);
  EXPECT_EQ(face_before(cells, {0, 0, 0}), Face::top);
}

// The ground rises one cell for each cell along x. The normal leans back by 45 degrees, 11585 = 2^14 / sqrt
// 2.
TEST(Ground, NormalOfASlope) {
  Land land = flat({8, 8, 8}, 0);
  for (std::size_t i = 0; i < land.heights.size(); ++i) land.heights[i] = static_cast<int>(i % 8) * kHeight;
  const Vector n = ground_normal(land, land.cells, {4 * kCell, 0, 4 * kCell}, Face::top);
  EXPECT_NEAR(static_cast<double>(n.x), -11585, 2);
  EXPECT_NEAR(static_cast<double>(n.y), 11585, 2);
  EXPECT_EQ(n.z, 0);
}

// The steepest cliff rises 1024 cells from one column to the next.
TEST(Ground, NormalOfACliff) {
  const Land land{{2, 1024, 1}, {0, 1024 * kHeight}};
  const Vector n = ground_normal(land, land.cells, {kCell, 0, kHalf}, Face::top);
  EXPECT_NEAR(static_cast<double>(n.x), -16384, 2);
  EXPECT_NEAR(static_cast<double>(n.y), 16, 2);
  const Vector odd = slope_normal(-65535, -65535);     // an odd component must not overflow
  EXPECT_NEAR(static_cast<double>(odd.x), -11574, 3);  // from (-16, 1, -16)
}

// At the edge the fall is a whole cell more, and a quarter of a cell from it half of that. Further in it is
// nothing.
TEST(Ground, RimByHand) {
  EXPECT_EQ(rim(0, 16), -4096);
  EXPECT_EQ(rim(kCell / 4, 16), -2048);
  EXPECT_EQ(rim(kCell / 2, 16), 0);
  EXPECT_EQ(rim(16 * kCell - kCell / 4, 16), 2048);
  const Land land = flat({16, 8, 16}, kHeight);
  const Vector n = ground_normal(land, land.cells, {16 * kCell, kCell, 8 * kCell}, Face::top);
  EXPECT_NEAR(static_cast<double>(n.x), 11585, 2);
}

// Makes hills with crests a few cells wide.
Land hills(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  const double tall = 4 + 16 * any(random), fine = 0.2 + 0.5 * any(random), turn = 6 * any(random);
  Land land = flat({48, 32, 40}, 0);
  for (int z = 0; z < 40; ++z)
    for (int x = 0; x < 48; ++x) {
      const double u = x * std::cos(turn) + z * std::sin(turn), v = z * std::cos(turn) - x * std::sin(turn);
      const double h = 2 + tall * (0.5 + 0.3 * std::sin(fine * u) + 0.2 * std::sin(0.7 * fine * v));
      land.heights[static_cast<std::size_t>(z * 48 + x)] = static_cast<std::int32_t>(h * kHeight);
    }
  return land;
}

// Every ray of 200 views is checked. On slopes of up to 5, weights of 8 bits leave 0.02 cells open.
TEST(Ground, IsThatOfADenseMarchInDouble) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> azimuth(0, 359), elevation(-20, 60), distance(20, 90), field(5, 40);
  int rays = 0, met = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Land land = hills(i);
    const test::DenseGround<Land> dense(land, land.cells);
    const Camera camera{{24 * kCell, 8 * kCell, 20 * kCell},
                        distance(random) << 12,
                        azimuth(random) * kDegree,
                        elevation(random) * kDegree,
                        field(random) * kDegree,
                        12,
                        9};
    const View view = view_of(camera, land.cells);
    for (int p = 0; p < 12 * 9; ++p, ++rays) {
      const Ray ray = ray_through(view, p % 12 * kPixel + kPixel / 2, p / 12 * kPixel + kPixel / 2,
                                  1 + static_cast<int>(i % 3));
      const GroundCrossing got = land.met_by(ray);
      met += got.found;
      const char* fault = test::fault_of(dense, ray, got, 0.02);
      ASSERT_EQ(fault, nullptr) << fault << ", view " << i << ", ray " << p;
    }
  }
  EXPECT_GT(met, rays / 3);
  EXPECT_GT(rays - met, rays / 10);
}

}  // namespace
}  // namespace voxmelt::picture
