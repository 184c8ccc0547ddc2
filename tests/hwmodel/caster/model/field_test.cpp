// The ray caster's arithmetic up to the normal is tested alone. Expected numbers come from the worked pixel
// (docs/picture/trace.md, section 4), the worked ray (docs/picture/definition.md, section 11), or plain loops
// below.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <set>

#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/ray.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/tokens.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::int64_t kFull = 32640;

CameraRegisters worked_camera() {
  CameraRegisters registers;
  registers.eye = {-6945525, 7835297, 15011433};
  registers.forward = {578731322, -367241333, -826513985};
  registers.wide = {235676806, 0, 165022676};
  registers.high = {56441079, 270357325, -80606216};
  registers.near = 187;
  registers.near_wide = {5379829, 0, 3766997};
  registers.near_high = {1288388, 6171486, -1840011};
  registers.width = registers.height = 16;
  registers.spacing = 2;
  return registers;
}

TEST(RaycastRay, TheWorkedPixelsRay) {
  const Ray ray = ray_of(worked_camera(), 352, 288);
  EXPECT_EQ(ray.start, (Vec{-898897, 4993772, 4586858}));
  EXPECT_EQ(ray.step, (Vec{129340, -60781, -222986}));
}

TEST(RaycastRay, TheWorkedRayLooksAlongAnAxis) {
  CameraRegisters camera;
  camera.eye = {33554432, 33554432, 171966464};
  camera.forward = {0, 0, -(std::int64_t{1} << 30)};
  camera.wide = {std::int64_t{1} << 30, 0, 0};
  camera.high = {0, std::int64_t{1} << 30, 0};
  camera.near = 1589;
  camera.near_wide = camera.near_high = {};
  camera.width = 8;
  camera.height = 4;
  const Ray ray = ray_of(camera, 256, 128);
  EXPECT_EQ(ray.start, (Vec{33554432, 33554432, 67829760}));
  EXPECT_EQ(ray.step, (Vec{0, 0, -262144}));
}

// The test finds b by a search instead of a count of zeros, and rounds by an exact quotient.
TEST(RaycastRay, StepsAreTheDirectionsToNearest) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<std::int64_t> unit(-(std::int64_t{1} << 30), std::int64_t{1} << 30);
  for (int n = 0; n < 2000; ++n) {
    CameraRegisters camera = worked_camera();
    camera.forward = {unit(random), unit(random), unit(random)};
    camera.wide = {unit(random), n % 3 == 0 ? 0 : unit(random), unit(random)};
    camera.high = {unit(random), unit(random), unit(random)};
    camera.width = 1 + n % 40;
    camera.height = 1 + n % 23;
    camera.spacing = 2 + n % 4;
    const std::int64_t across = random() % static_cast<unsigned>(64 * camera.width);
    const std::int64_t down = random() % static_cast<unsigned>(64 * camera.height);
    const std::int64_t u = across - 32 * camera.width, v = 32 * camera.height - down;
    const auto direction = [&](std::int64_t f, std::int64_t w, std::int64_t h) {
      return f * 32 * camera.height + w * u + h * v;
    };
    const std::array<std::int64_t, 3> d{direction(camera.forward.x, camera.wide.x, camera.high.x),
                                        direction(camera.forward.y, camera.wide.y, camera.high.y),
                                        direction(camera.forward.z, camera.wide.z, camera.high.z)};
    const std::int64_t most = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    std::int64_t power = 1, b = 0;
    while (power < most) {
      power *= 2;
      ++b;
    }
    if (b < 27) continue;  // no camera is so close to nothing
    const std::int64_t unit_step = std::int64_t{1} << (b - 20 + camera.spacing);
    const Ray ray = ray_of(camera, across, down);
    const std::array<std::int64_t, 3> steps{ray.step.x, ray.step.y, ray.step.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t rest = 2 * (steps[axis] * unit_step - d[axis]);  // in (-unit_step, unit_step]
      EXPECT_GT(rest, -unit_step);
      EXPECT_LE(rest, unit_step);
    }
  }
}

// The rows are the page's, and no two samples share a row or a column.
TEST(RaycastRay, PlacesOfSamplesInAPixel) {
  EXPECT_EQ(sub_of(1, 0).across, 32);
  EXPECT_EQ(sub_of(1, 0).down, 32);
  const std::array<std::int64_t, 8> eight{3, 6, 0, 5, 2, 7, 1, 4};
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(sub_of(8, i).across, 8 * i + 4);
    EXPECT_EQ(sub_of(8, i).down, 8 * eight[static_cast<std::size_t>(i)] + 4);
  }
  std::set<std::int64_t> across, down;
  for (int i = 0; i < 32; ++i) {
    across.insert(sub_of(32, i).across);
    down.insert(sub_of(32, i).down);
  }
  EXPECT_EQ(across.size(), 32U);
  EXPECT_EQ(down.size(), 32U);
  for (const std::int64_t place : down) EXPECT_EQ(place % 2, 1);
  EXPECT_EQ(sub_of(32, 0).down, 5);
  EXPECT_EQ(sub_of(32, 31).down, 37);
}

// The steps never exceed floor(way / d), and fall short of it by at most a 500th and one.
TEST(RaycastRay, AWayIsNeverTooManySteps) {
  std::mt19937_64 random(6);
  for (int n = 0; n < 200000; ++n) {
    const std::int64_t d = 1 + static_cast<std::int64_t>(random() % (n % 2 == 0 ? 1U << 18 : 4096U));
    const std::int64_t way = static_cast<std::int64_t>(random() >> (19 + n % 40));
    const std::int64_t steps = steps_in(way, inverse_of(n % 4 < 2 ? d : -d));
    const std::int64_t exact = way / d;
    ASSERT_LE(steps, exact) << way << " / " << d;
    ASSERT_GE(steps, exact - exact / 500 - 1) << way << " / " << d;
  }
  EXPECT_EQ(steps_in(1 << 20, inverse_of(0)), 0);
}

struct Worked {
  std::int64_t k, level;
  std::array<std::int64_t, 3> cell;
};
constexpr std::array<Worked, 10> kSamples{{{5, -32180, {-1, 3, 2}},
                                           {6, -30492, {-1, 3, 2}},
                                           {7, -27849, {-1, 3, 2}},
                                           {8, -24301, {-1, 3, 2}},
                                           {9, -19952, {-1, 3, 1}},
                                           {10, -14567, {-1, 3, 1}},
                                           {11, -8160, {0, 3, 1}},
                                           {12, -4335, {0, 3, 1}},
                                           {13, -510, {0, 3, 1}},
                                           {14, 3315, {0, 3, 0}}}};

// The worked pixel's grid has four full cells a side.
std::int16_t worked_level(std::int64_t x, std::int64_t y, std::int64_t z) {
  const bool in = std::min({x, y, z}) >= 0 && std::max({x, y, z}) < 4;
  return static_cast<std::int16_t>(in ? kFull : -kFull);
}
std::int64_t worked_sample(Vec q) {
  const std::int64_t x = (q.x >> 20) - 2, y = (q.y >> 20) - 2, z = (q.z >> 20) - 2;
  std::array<std::int16_t, 8> levels{};
  for (std::size_t i = 0; i < 8; ++i)
    levels[i] = worked_level(x + static_cast<std::int64_t>(i & 1), y + static_cast<std::int64_t>(i >> 1 & 1),
                             z + static_cast<std::int64_t>(i >> 2));
  return sample_of(levels.data(), q);
}

TEST(RaycastField, TheWorkedPixelsSamples) {
  const Ray ray = ray_of(worked_camera(), 352, 288);
  for (const Worked& worked : kSamples) {
    const Vec q = to_lattice(ray.start + ray.step * worked.k);
    EXPECT_EQ((q.x >> 20) - 2, worked.cell[0]) << worked.k;
    EXPECT_EQ((q.y >> 20) - 2, worked.cell[1]) << worked.k;
    EXPECT_EQ((q.z >> 20) - 2, worked.cell[2]) << worked.k;
    EXPECT_EQ(worked_sample(q), worked.level) << worked.k;
    EXPECT_EQ(from_lattice(q), ray.start + ray.step * worked.k);
  }
  const Vec seventh = to_lattice({6483, 4568305, 3025956});
  EXPECT_EQ(weight_of(seventh.x), 130);
  EXPECT_EQ(weight_of(seventh.y), 219);
  EXPECT_EQ(weight_of(seventh.z), 99);
}

// The eight levels differ, so that a swap of two of them shows. A sample errs by 3/2 against a blend in
// floating point, but the numbers by hand are exact.
TEST(RaycastField, EachLevelHasItsWeight) {
  const std::array<std::int16_t, 8> levels{-30000, 12345, 777, -4096, 31000, -150, 8191, 20000};
  EXPECT_EQ(sample_of(levels.data(), {0, 0, 0}), -30000);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto far = [&](std::size_t bit) { return (i >> bit & 1) != 0 ? std::int64_t{255} << 12 : 0; };
    const std::int64_t level = sample_of(levels.data(), {far(0), far(1), far(2)});
    EXPECT_LE(std::abs(level - levels[i]), 3 * 65280 / 256 + 2) << i;
  }
  // The weights are 64, 128, 192. Along x, -30000 (3/4) + 12345/4 -> -19414; 777 and -4096 -> -441; 31000 and
  // -150 -> 23213; 8191 and 20000 -> 11143. Along y they give -9927 and 17178. Along z, -9927/4 + 17178 (3/4)
  // -> 10402.
  EXPECT_EQ(sample_of(levels.data(), {64 << 12, 128 << 12, 192 << 12}), 10402);
}

TEST(RaycastField, TheWorkedPixelsCrossing) {
  Bracket bracket{to_lattice({782523, 4203619, 1688040}), to_lattice({911863, 4142838, 1465054}), -510, 3315,
                  0};
  const std::array<Vec, 3> middles{
      {{847193, 4173228, 1576547}, {814858, 4188423, 1632293}, {798690, 4196021, 1660166}}};
  const std::array<std::int64_t, 3> levels{1275, 255, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(from_lattice(middle_of(bracket)), middles[i]);
    EXPECT_EQ(worked_sample(middle_of(bracket)), levels[i]);
    halve(bracket, levels[i]);
  }
  const Crossing crossing = crossing_of(bracket, 14);
  EXPECT_TRUE(crossing.found);
  EXPECT_EQ(crossing.sample, 14);
  EXPECT_EQ(crossing.part, 256);
  EXPECT_EQ(crossing.position, (Vec{798690, 4196021, 1660166}));
}

// The worked ray's first middle is air, the second matter, the third air, so e = 101 in bits.
TEST(RaycastField, TheWorkedRaysCrossing) {
  const auto at = [](std::int64_t z) { return to_lattice({33554432, 33554432, z}); };
  Bracket bracket{at(67829760 - 2 * 262144), at(67829760 - 3 * 262144), -12240, 4080, 0};
  EXPECT_EQ(middle_of(bracket), at(67174400));
  halve(bracket, -4080);
  EXPECT_EQ(middle_of(bracket), at(67108864));
  halve(bracket, 0);
  EXPECT_EQ(middle_of(bracket), at(67141632));
  halve(bracket, -2040);
  const Crossing crossing = crossing_of(bracket, 3);
  EXPECT_EQ(crossing.position.z, 67108864);
  EXPECT_EQ(crossing.part, 5 * 256 + 256);
  // Between -100 and 301, f = 25600 / 401 = 63, and (4096 x 63) >> 8 = 1008 of the way.
  const Crossing other = crossing_of({at(0), at(-4096), -100, 301, 2}, 9);
  EXPECT_EQ(other.position.z, -1008);
  EXPECT_EQ(other.part, 512 + 63);
}

TEST(RaycastField, TheWorkedPixelsNormal) {
  const Vec q = to_lattice({798690, 4196021, 1660166});
  EXPECT_EQ(middle_place(q.x) - 2, 0);
  EXPECT_EQ(middle_place(q.y) - 2, 4);
  EXPECT_EQ(middle_place(q.z) - 2, 1);
  std::array<std::int16_t, 27> levels{};
  for (int i = 0; i < 27; ++i)
    levels[static_cast<std::size_t>(i)] = worked_level(i % 3 - 1, 3 + i / 3 % 3, i / 9);
  const Slope slope = slope_of(levels.data(), q);
  EXPECT_EQ(slope.slope, (Vec{3889, -31747, 0}));
  EXPECT_EQ(slope.normal, (Vec{-1992, 16262, 0}));
}

// The slope comes from three plain passes over an array that shrinks, in the words of the page.
Vec plain_slope(const std::array<std::int16_t, 27>& levels, Vec position) {
  std::array<std::array<std::array<std::int64_t, 3>, 2>, 3> weights{};  // [axis][value, slope]
  const std::array<std::int64_t, 3> p{position.x, position.y, position.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t u = (p[axis] + 2048) / 4096 % 256, t = 256 - u, l = t * t / 512, r = u * u / 512;
    weights[axis] = {{{l, 256 - l - r, r}, {-t, t - u, u}}};
  }
  std::array<std::int64_t, 3> values{};
  for (std::size_t wanted = 0; wanted < 3; ++wanted) {
    std::array<std::int64_t, 27> now{};
    std::copy(levels.begin(), levels.end(), now.begin());
    std::size_t count = 27;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t kind = axis == wanted ? 1 : 0;
      const double unit = kind == 1 ? 512 : 256;
      count /= 3;
      for (std::size_t i = 0; i < count; ++i) {
        double sum = 0;
        for (std::size_t n = 0; n < 3; ++n)
          sum += static_cast<double>(now[3 * i + n] * weights[axis][kind][n]);
        now[i] = static_cast<std::int64_t>(std::floor(sum / unit + 0.5));
      }
    }
    values[wanted] = now[0];
  }
  return {values[0], values[1], values[2]};
}

TEST(RaycastField, SlopesAreThoseOfThreePlainPasses) {
  std::mt19937_64 random(7);
  for (int n = 0; n < 3000; ++n) {
    std::array<std::int16_t, 27> levels{};
    for (std::int16_t& level : levels)
      level = static_cast<std::int16_t>(n % 5 == 0 ? (random() % 2 == 0 ? kFull : -kFull)
                                                   : static_cast<std::int64_t>(random() % 65281) - kFull);
    const auto coordinate = [&] { return static_cast<std::int64_t>(random() % (64U << 20)); };
    const Vec p{coordinate(), coordinate(), coordinate()};
    ASSERT_EQ(slope_of(levels.data(), to_lattice(p)).slope, plain_slope(levels, p)) << n;
  }
}

TEST(RaycastField, TheWorkedVectorsOfLength1) {
  EXPECT_EQ(unit_of({-8084, 3798, 13936}), (Vec{-8002, 3759, 13794}));
  EXPECT_EQ(unit_of({-15949, 15680, 21742}), (Vec{-8378, 8236, 11420}));
  EXPECT_EQ(unit(Vec{-3889, 31747, 0}), (Vec{-1992, 16262, 0}));
  EXPECT_EQ(unit_of({}), (Vec{}));
  // The vector has 17 bits and is shifted by 3, to (8193, 5000, -1). Its last component is 16384 / 9598 = 1.7
  // and not half of it.
  EXPECT_EQ(unit_of({65551, 40007, -1}).z, -2);
  EXPECT_EQ(kInverseRoot[508 - 128], 16448);
  EXPECT_EQ(kInverseRoot[509 - 128], 16432);
  EXPECT_EQ(kInverseRoot[0], 32768);
  EXPECT_EQ(kInverseRoot[512 - 128], 16384);
}

// Every component is within 1.6 of the true one (docs/picture/definition.md, section 8). A shift of large
// vectors costs another 2^-14 of the largest component.
TEST(RaycastField, LengthsAreThoseOfRealNumbers) {
  std::mt19937_64 random(8);
  for (int n = 0; n < 100000; ++n) {
    const std::int64_t most = std::int64_t{1} << (1 + n % 15);
    const auto component = [&] {
      return static_cast<std::int64_t>(random() % static_cast<unsigned>(2 * most)) - most;
    };
    Vec g{component(), component(), component()};
    if (largest(g) > 32767 || g == Vec{}) continue;
    const Vec vector = unit(g);
    const double length = std::sqrt(static_cast<double>(g.x * g.x + g.y * g.y + g.z * g.z));
    ASSERT_LE(std::abs(static_cast<double>(vector.x) - 16384.0 * static_cast<double>(g.x) / length), 1.6);
    ASSERT_LE(std::abs(static_cast<double>(vector.y) - 16384.0 * static_cast<double>(g.y) / length), 1.6);
    ASSERT_LE(std::abs(static_cast<double>(vector.z) - 16384.0 * static_cast<double>(g.z) / length), 1.6);
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
