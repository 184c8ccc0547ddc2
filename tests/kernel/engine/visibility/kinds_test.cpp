// Points, spheres, suns and skies agree with the page, with integrals, and with known answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "kernel/automaton/rule/ray.h"
#include "kernel/engine/visibility/kept_rays.h"
#include "tests/kernel/engine/visibility/kinds_check.h"

namespace voxmelt::visibility {
namespace {

using enum rule::SourceKind;

constexpr std::uint64_t kFull = std::uint64_t{256} * 16384;  // 16384 for a face that is turned to a sun

struct Providers {
  VoxelWalkProvider walk;
  KeptRays plain{std::make_unique<PlainCaster>()};
  KeptRays two_level{std::make_unique<TwoLevelCaster>()};
  std::vector<Provider*> all() { return {&walk, &plain, &two_level}; }
};

TEST(Kinds, InHostileWorldsAreAsThePageSays) {
  Providers providers;
  check_kinds_in_hostile_worlds(providers.all(), 501);
}
TEST(Kinds, OfAHundredPlacesEachAreAsThePageSays) {
  Providers providers;
  check_places_of_every_kind(providers.all(), 502);
}

state::Field<std::uint16_t> lit(const Volume& v, const Shine& shine, int rays, std::uint64_t seed = 1) {
  state::Field<std::uint16_t> result(v.grid);
  VoxelWalkProvider().irradiance(v, shone_by({shine}, rays, seed), 0, result);
  return result;
}

TEST(Sphere, OfRadius0IsAPoint) {
  Random random(12);
  for (int trial = 0; trial < 60; ++trial) {
    const Volume v = hostile_world(random, hostile_grid(random));
    Shine shine = awkward_shine(random, v.grid, point);
    const auto as_point = lit(v, shine, 4);
    shine.kind = sphere;
    EXPECT_EQ(lit(v, shine, 4), as_point) << trial;
  }
}

// A floor lies under a shade that ends at x = 16. A distant sphere of radius r is straight above the edge.
// From a place of the floor its disc is cut by a straight line, so its part is a circle segment, by the
// angle.
TEST(Sphere, ShadowEdgeIsTheSegmentOfADisc) {
  Volume v(Grid{32, 24, 64});
  for_each({0, 0, 0, 32, 1, 64}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  for_each({0, 20, 0, 16, 21, 64}, [&](int x, int y, int z) { put_inert(v, x, y, z); });
  const double height = 400, radius = 60;  // in cells above the floor
  Shine shine{sphere, {.power = 0}};
  shine.key.at = {16 * 16, 16 + static_cast<int>(16 * height), 32 * 16};
  shine.key.radius = static_cast<int>(16 * radius);
  shine.key.power = static_cast<std::uint64_t>(kFull * height * height);
  // The lower side of the shade, 19 above the floor, or the upper one, 20, ends the light.
  const auto visible = [&](double x) {
    double part = 1;
    for (const double edge : {19.0, 20.0}) {
      // The line from (x, 0) by (16, edge) meets the height of the disc at offset t from its middle.
      const double t = std::min(1.0, std::max(-1.0, ((16 - x) * height / edge + x - 16) / radius));
      const double right = (std::acos(t) - t * std::sqrt(1 - t * t)) / std::numbers::pi;
      part = std::min(part, right);
    }
    return part;
  };
  for (const int rays : {1, 4, 16}) {
    const auto result = lit(v, shine, rays);
    for (int x = 8; x < 24; ++x) {
      double mean = 0, wanted = 0;
      for (int z = 8; z < 56; ++z) mean += result[v.at(x, 0, z)] / 48.0 / 16384;
      for (int i = 0; i < 64; ++i) wanted += visible(x + (i + 0.5) / 64) / 64;
      EXPECT_NEAR(mean, wanted, rays == 1 ? 0.2 : 0.06) << "x " << x << ", rays " << rays;
    }
  }
}

// If a sphere is whole above the planes of three faces, it gives as much as a point at its centre. Nearer
// than its radius it gives no more than at its surface.
TEST(Sphere, UnhiddenIsAsItsCentre) {
  Volume v(Grid{9, 9, 9});
  put_solid(v, 4, 4, 4);
  for (const std::array<int, 3> to : {std::array{3, 8, 2}, {2, 5, 1}, {-3, 1, 7}, {4, -4, 4}}) {
    Shine shine{point, {.power = kFull * 40}};
    shine.key.at = {72 + 160 * to[0], 72 + 160 * to[1], 72 + 160 * to[2]};
    const double alone = lit(v, shine, 1)[v.at(4, 4, 4)];
    shine.kind = sphere;
    shine.key.radius = 120;
    double mean = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) mean += lit(v, shine, 16, seed)[v.at(4, 4, 4)] / 200.0;
    EXPECT_NEAR(mean / alone, 1, 0.02);
  }
  Shine inside{sphere, {.at = {72, 72 + 16, 72}, .power = kFull, .radius = 64}};
  double mean = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) mean += lit(v, inside, 16, seed)[v.at(4, 4, 4)] / 200.0;
  EXPECT_LT(mean, 16384 / 16.0 * 2) << "a surface at 4 cells, two faces at most";
  EXPECT_GT(mean, 0);
  inside.key.at = {72, 72, 72};
  EXPECT_EQ(lit(v, inside, 16)[v.at(4, 4, 4)], 0) << "at the very centre";
}

TEST(Directional, GivesTheCosineAndNoDistance) {
  Volume v(Grid{40, 9, 9});
  put_solid(v, 4, 4, 4);
  put_solid(v, 30, 1, 4);
  const auto one = [&](rule::Position d, int rays) {
    return lit(v, {directional, {.power = kFull, .direction = d}}, rays);
  };
  for (const int rays : {1, 4, 16}) {
    EXPECT_EQ(one({0, 32768, 0}, rays)[v.at(4, 4, 4)], 16384);
    EXPECT_EQ(one({0, 1, 0}, rays)[v.at(30, 1, 4)], 16384) << "any length";
    EXPECT_EQ(one({0, -7, 0}, rays)[v.at(30, 1, 4)], 16384) << "from below";
    EXPECT_EQ(one({3, 4, 0}, rays)[v.at(4, 4, 4)], 16384 * 7 / 5) << "two faces: 3 / 5 and 4 / 5";
    EXPECT_EQ(one({0, 0, 0}, rays)[v.at(4, 4, 4)], 0);
  }
}

// A wall of 10 cells stands under a sun at 45 degrees. Its shadow on the floor is as long, for any length of
// D.
TEST(Directional, ShadowsAreAsLongAsThePageSays) {
  for (const std::int64_t length : {1, 3, 16, 100, 5000, 65536}) {
    Volume v(Grid{30, 14, 5});
    for_each({0, 0, 0, 30, 1, 5}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
    for_each({20, 1, 0, 21, 11, 5}, [&](int x, int y, int z) { put_inert(v, x, y, z); });
    const auto result = lit(v, {directional, {.power = kFull, .direction = {length, length, 0}}}, 1);
    for (int x = 0; x < 20; ++x)  // at x = 10 the ray touches the wall's upper edge, and sees the sun
      EXPECT_EQ(result[v.at(x, 0, 2)] > 0, x <= 9) << "x " << x << ", length " << length;
  }
}

// The last cell before the end of the grid stops rays, too.
TEST(Directional, RaysReachTheEndOfTheGrid) {
  for (const std::int64_t length : {1, 7, 16, 17, 40, 300}) {
    Volume v(Grid{3, 20, 3});
    put_solid(v, 1, 1, 1);
    put_inert(v, 1, 19, 1);
    EXPECT_EQ(lit(v, {directional, {.power = kFull, .direction = {0, length, 0}}}, 1)[v.at(1, 1, 1)], 0);
  }
}

// An open floor has it all, by 1, 4 and 16 rays. An upright wall has half, and by 4 and 16 rays exactly half.
TEST(Sky, OpenFloorAndWall) {
  Volume v(Grid{20, 20, 20});
  for_each({0, 0, 0, 20, 1, 20}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  Volume wall(Grid{9, 40, 40});
  for_each({4, 0, 0, 5, 40, 40}, [&](int x, int y, int z) { put_solid(wall, x, y, z); });
  Volume alone(Grid{3, 3, 3});
  put_solid(alone, 1, 1, 1);
  const Shine shine{sky, {.power = kFull}};
  for (const int rays : {1, 4, 16}) {
    const auto open = lit(v, shine, rays);
    for_each({1, 0, 1, 19, 1, 19}, [&](int x, int y, int z) { ASSERT_EQ(open[v.at(x, y, z)], 16384); });
    const auto upright = lit(wall, shine, rays);
    double mean = 0;
    for_each({4, 1, 1, 5, 39, 39}, [&](int x, int y, int z) {
      mean += upright[wall.at(x, y, z)] / 38.0 / 38;
      if (rays > 1) {
        ASSERT_EQ(upright[wall.at(x, y, z)], 16384) << "two faces, half of the sky each";
      }
    });
    EXPECT_NEAR(mean / 16384, 1, 0.05);
    if (rays > 1) {
      EXPECT_EQ(lit(alone, shine, rays)[alone.at(1, 1, 1)], 3 * 16384) << "1 and four halves";
    }
  }
}

// Returns the part of the sky that a place sees through the opening of a hollow, by a double integral over
// the opening.
double view_factor(double x, double z, double width, double depth, double height) {
  constexpr int kParts = 200;
  double sum = 0;
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; j < kParts; ++j) {
      const double dx = width * (i + 0.5) / kParts - x, dz = depth * (j + 0.5) / kParts - z;
      const double d2 = dx * dx + dz * dz + height * height;
      sum += height * height / (std::numbers::pi * d2 * d2) * (width / kParts) * (depth / kParts);
    }
  return sum;
}

// The place is at the bottom of a shaft that is 8 x 12 wide and 5, 10, 20 deep.
TEST(Sky, BottomOfAHollowIsItsViewFactor) {
  for (const int deep : {5, 10, 20})
    for (const int rays : {1, 4, 16}) {
      Volume v(Grid{16, deep + 2, 20});
      for_each(whole(v.grid), [&](int x, int y, int z) {
        const bool hollow = y > 1 && x >= 4 && x < 12 && z >= 4 && z < 16;
        if (!hollow) y == 1 ? put_solid(v, x, y, z) : put_inert(v, x, y, z);
      });
      double mean = 0, wanted = 0;
      const int seeds = 160 / rays;
      for (int seed = 0; seed < seeds; ++seed) {
        const auto result = lit(v, {sky, {.power = kFull}}, rays, static_cast<std::uint64_t>(seed));
        for_each({4, 1, 4, 12, 2, 16},
                 [&](int x, int y, int z) { mean += result[v.at(x, y, z)] / 96.0 / 16384 / seeds; });
      }
      for (int x = 0; x < 8; ++x)
        for (int z = 0; z < 12; ++z) wanted += view_factor(x + 0.5, z + 0.5, 8, 12, deep) / 96;
      EXPECT_NEAR(mean, wanted, 0.02) << deep << " deep, " << rays << " rays";
    }
}

// Neighbours do not share their directions: no band of one cell is much brighter than another.
TEST(Sky, HasNoBands) {
  Volume v(Grid{48, 12, 48});
  for_each({0, 0, 0, 48, 1, 48}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  for_each({0, 6, 0, 48, 7, 48}, [&](int x, int y, int z) {
    if ((x / 4 + z / 4) % 2 == 0) put_inert(v, x, y, z);
  });
  const auto result = lit(v, {sky, {.power = kFull}}, 1);
  for (int z = 8; z < 40; ++z) {
    int seeing = 0;
    for (int x = 8; x < 40; ++x) seeing += result[v.at(x, 0, z)] > 0;
    EXPECT_GT(seeing, 4) << z;
    EXPECT_LT(seeing, 28) << z;
  }
}

// All numbers of a source move between its keys. A step in the middle is as a source at rest there.
TEST(Kinds, MoveByTheirKeys) {
  Random random(31);
  const Volume v = ray_scene(3, {30, 20, 20});
  rule::Heat heat = shone_by({Shine{sphere, {}}, Shine{directional, {}}, Shine{sky, {}}}, 4, 9);
  heat.sources[0].keys = {{.step = 4, .at = {0, 500, 100}, .power = kFull * 100, .radius = 10},
                          {.step = 14, .at = {333, 400, 101}, .power = kFull * 300, .radius = 115}};
  heat.sources[1].keys = {{.step = 4, .power = kFull / 3, .direction = {30000, 5, -7}},
                          {.step = 14, .power = kFull / 4, .direction = {-20000, 20000, 9}}};
  heat.sources[2].keys = {{.step = 4, .power = 0}, {.step = 14, .power = kFull / 2}};
  const auto between = [](std::int64_t a, std::int64_t b, std::int64_t step) {
    return a + static_cast<std::int64_t>(std::floor(static_cast<double>((b - a) * (step - 4)) / 10));
  };
  Providers providers;
  state::Field<std::uint16_t> kept(v.grid), expected(v.grid);
  for (std::uint32_t step = 0; step < 18; ++step) {
    const std::int64_t s = std::clamp<std::int64_t>(step, 4, 14);
    const auto power = [&](std::uint64_t a, std::uint64_t b) {
      return static_cast<std::uint64_t>(
          between(static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), s));
    };
    const std::vector<Shine> rest{
        {sphere,
         {.at = {between(0, 333, s), between(500, 400, s), between(100, 101, s)},
          .power = power(kFull * 100, kFull * 300),
          .radius = between(10, 115, s)}},
        {directional,
         {.power = power(kFull / 3, kFull / 4),
          .direction = {between(30000, -20000, s), between(5, 20000, s), between(-7, 9, s)}}},
        {sky, {.power = power(0, kFull / 2)}}};
    providers.walk.irradiance(v, shone_by(rest, 4, 9), 0, expected);
    providers.two_level.irradiance(v, heat, step, kept);
    ASSERT_EQ(kept, expected) << "step " << step;
  }
}

// A sky rests while its power changes, and so does a sphere. No ray is cast again.
TEST(Kinds, RestWhileOnlyTheirPowerChanges) {
  const Volume v = ray_scene(0, {30, 20, 20});
  rule::Heat heat = shone_by(
      {{sky, {.power = kFull}}, {sphere, {.at = {99, 600, 99}, .power = kFull, .radius = 90}}}, 4, 3);
  for (rule::HeatSource& source : heat.sources) {
    source.keys.push_back(source.keys[0]);
    source.keys[1].step = 20;
    source.keys[1].power *= 5;
  }
  KeptRays kept;
  state::Field<std::uint16_t> result(v.grid), expected(v.grid);
  std::int64_t first = 0;
  for (std::uint32_t step = 0; step < 24; step += 4) {
    kept.irradiance(v, heat, step, result);
    VoxelWalkProvider().irradiance(v, heat, step, expected);
    ASSERT_EQ(result, expected) << step;
    if (step == 0) first = kept.casts().cast;
  }
  EXPECT_EQ(kept.casts().cast, first);
  EXPECT_EQ(kept.casts().asked, 6 * first) << "rays that are not cast are not asked for";
}

// 4096 words by 16 rays fill the quarters and the rings of the disc evenly. Each place is rho away from the
// middle.
TEST(Places, FillTheDiscEvenly) {
  std::array<int, 4> quarters{}, rings{};
  for (std::uint64_t word = 0; word < 4096; ++word)
    for (int n = 0; n < 16; ++n) {
      const rule::DiscPlace place = rule::disc_place(word * 0x9E3779B97F4A7C15u, n, 16);
      ++quarters.at(static_cast<std::size_t>((place.p > 0 ? 0 : 1) + (place.q > 0 ? 0 : 2)));
      const std::int64_t squared = place.p * place.p + place.q * place.q;
      ++rings.at(static_cast<std::size_t>(std::min<std::int64_t>(3, squared >> 26)));
      ASSERT_NEAR(std::sqrt(static_cast<double>(squared)), static_cast<double>(place.rho), 3);
      ASSERT_LT(place.rho, 16384);
    }
  for (const int count : quarters) EXPECT_EQ(count, 4096 * 4);
  for (const int count : rings) EXPECT_NEAR(count, 4096 * 4, 100);
}

// By hand, word 0 and the only ray give u = v = 0 and rho = floor(sqrt(2048)) = 45. Then 45 x 16382 >> 14 =
// 44, and 45 x 201 >> 14 = 0. With u = 16384 (word 0x4000) it is turned once.
TEST(Places, ByHand) {
  const rule::DiscPlace first = rule::disc_place(0, 0, 1), turned = rule::disc_place(0x4000, 0, 1);
  EXPECT_EQ(first.rho, 45);
  EXPECT_EQ(first.p, 45);
  EXPECT_EQ(first.q, 1);
  EXPECT_EQ(turned.p, -1);
  EXPECT_EQ(turned.q, 45);
  // These are the vectors of a disc seen along -z: g = (0, -16384, 0) for least axis x, and v = f x g.
  const rule::DiscAxes axes = rule::disc_axes({0, 0, -1600});
  EXPECT_EQ(axes.g, (rule::Triple{0, -16384, 0}));
  EXPECT_EQ(axes.v, (rule::Triple{-16384, 0, 0}));
}

}  // namespace
}  // namespace voxmelt::visibility
