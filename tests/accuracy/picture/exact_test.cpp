// The picture in double is held against truths by hand: a plane, a ball, a slope, colours by formula. It is
// also held against a dense march.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <utility>

#include "accuracy/picture/compare.h"
#include "accuracy/picture/exact_picture.h"
#include "accuracy/picture/integer_pixels.h"
#include "accuracy/picture/sampling.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/reference_picture.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

using accuracy::Exact;
using accuracy::ExactRay;

struct World {
  World(const state::Volume& volume, const scene::Look& look, const scene::Light& light,
        const scene::Terrain& terrain = {})
      : field(filtered(volume, look, terrain)), data(field, look, light, terrain), exact(data) {}
  static render::DensityField filtered(const state::Volume& volume, const scene::Look& look,
                                       const scene::Terrain& terrain) {
    render::DensityField field;
    field.update(volume, look, terrain);
    return field;
  }
  render::DensityField field;
  render::PictureScene data;
  accuracy::ExactScene exact;
};

scene::Look unfiltered() {
  scene::Look look;
  look.smooth = look.smooth_solid = 0;
  look.specular = look.metallic = 0;
  return look;
}

void expect_near(Exact a, Exact b, double most) {
  EXPECT_NEAR(a.x, b.x, most);
  EXPECT_NEAR(a.y, b.y, most);
  EXPECT_NEAR(a.z, b.z, most);
}

// Matter is solid below y = 9. Levels next to that plane are the same with opposite signs, so it is the
// surface.
state::Volume half_full(state::Grid grid) {
  state::Volume volume(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < grid.x; ++x) {
        volume.solid.set(x, y, z, true);
        volume.amount[volume.at(x, y, z)] = rule::kOne;
      }
  return volume;
}

TEST(Exact, ClearMatterIsRefused) {
  scene::Look look = unfiltered();
  look.clear = {0, 9, 0};
  EXPECT_THROW(World(half_full({8, 12, 8}), look, {}), std::invalid_argument);
}

TEST(Cubic, FirstReachedByHand) {
  // The parabola is -(t - 1/2)^2 + e, whose coefficients are -1/4, 1/12, 1/12, -1/4, all plus e.
  const auto parabola = [](double e) {
    return accuracy::Cubic{-0.25 + e, 1.0 / 12 + e, 1.0 / 12 + e, -0.25 + e};
  };
  EXPECT_NEAR(accuracy::first_reached(parabola(1e-4)), 0.49, 1e-6);
  EXPECT_NEAR(accuracy::first_reached(parabola(0.04)), 0.3, 1e-6);
  EXPECT_LT(accuracy::first_reached(parabola(-1e-9)), 0);
  EXPECT_EQ(accuracy::first_reached(parabola(0.25)), 0);
}

TEST(ExactPicture, APlaneOfMatter) {
  const World world(half_full({32, 24, 32}), unfiltered(), {});
  for (const Exact along : {Exact{0, -1, 0}, Exact{0.4, -1, 0.3}, Exact{-1, -0.5, 0.2}}) {
    const ExactRay ray{Exact{16, 9, 16} - along * 5.25, along};
    EXPECT_NEAR(world.exact.field.first_crossing(ray), 5.25, 1e-6);
    expect_near(world.exact.field.normal({16, 9, 16}), {0, 1, 0}, 1e-9);
  }
  EXPECT_LT(world.exact.field.first_crossing({{16, 12, 16}, {1, 0.1, 0.2}}), 0);
  EXPECT_EQ(world.exact.field.first_crossing({{16, 4, 16}, {1, 0, 0}}), 0);
  // The near plane is 23 - 24.5 = 1.5 cells above the grid: from there it is 15.5 cells to y = 9.
  scene::Camera camera = test::small_camera({32, 24, 32}, 8, 8);
  camera.target = {16, 9, 16};
  camera.elevation = 89;
  camera.azimuth = 0;
  camera.distance = 60;
  const accuracy::ExactPicture picture(world.exact, render::camera_in_integers(camera), {32, 24, 32});
  const double slope = 89 * std::acos(-1.0) / 180;
  // The grid's corner next to the eye is (x, 24.5, 32.5): 15.5 up and 16.5 to the front of the target.
  EXPECT_NEAR(picture.matter(4, 4).depth, 15.5 * std::sin(slope) + 16.5 * std::cos(slope), 1e-6);
}

// Light comes from straight above. Above the plane all of it arrives, so lamp and sky add up: no mirror, no
// highlight.
TEST(ExactPicture, ColoursByFormula) {
  scene::Light light;
  light.direction = {0, 1, 0};
  light.ambient = 0.5;
  scene::Look look = unfiltered();
  look.solid = {0.5, 0.25, 0.125};
  const World world(half_full({32, 24, 32}), look, light);
  const Exact color = world.exact.shade.matter_color({16, 9, 16}, {0, 1, 0}, {0, 1, 0}, {});
  // Red has lamp 1.06 x 1.2 x 0.5 and sky 0.94 x 0.5. Green has 1 and 1, blue has 0.92 and 1.08.
  expect_near(color, {0.5 * (0.636 + 0.47), 0.25 * (0.6 + 0.5), 0.125 * (0.552 + 0.54)}, 2e-3);
  // Lit at 60 degrees, with nothing around, it has (1/2 + 0.15) / 1.15 of the lamp, 3/4 of the way to the
  // sky.
  const Exact tilted{std::sqrt(0.75), 0.5, 0};
  look.ground = {0, 0, 0};
  const World empty(state::Volume({32, 24, 32}), look, light);
  const Exact aside = empty.exact.shade.ground_color({16, 12, 16}, tilted, {1, 1, 1});
  expect_near(
      aside,
      {0.636 * 0.65 / 1.15 + 0.47 * 0.75, 0.6 * 0.65 / 1.15 + 0.5 * 0.75, 0.552 * 0.65 / 1.15 + 0.54 * 0.75},
      2e-3);
  expect_near(accuracy::pressed({0.5, 0.7, 1.0}), {0.5, 0.7, 0.7 + 0.3 * (1 - std::exp(-1.0))}, 1e-12);
  EXPECT_EQ(accuracy::bytes_of({0, 0.2140411, 1}), (render::Rgb{0, 127, 255}));  // sRGB's 127.5 is 0.21404114
}

// Liquid ends at y = 9 and at the sides of the grid: it is liquid there, too.
TEST(ExactPicture, ACutHasTheMatterBehindIt) {
  state::Volume volume = half_full({12, 16, 14});
  std::swap(volume.solid, volume.liquid);
  const World world(volume, unfiltered(), {});
  for (const Exact& p :
       {Exact{0, 4, 7}, Exact{-0.5, 4, 7}, Exact{12, 4, 7}, Exact{12.5, 4, 7}, Exact{6, 0, 7}, Exact{6, 4, 0},
        Exact{6, 4, 14}, Exact{12.5, 4, 14.5}, Exact{6, 9, 7}})
    EXPECT_NEAR(world.exact.field.matter(p).liquid, 255, 1e-9) << p.x << ' ' << p.y << ' ' << p.z;
}

TEST(ExactPicture, ABall) {
  const state::Grid grid{40, 40, 40};
  state::Volume volume(grid);
  test::ball(volume, 20, 20, 20, 12);
  scene::Look look = unfiltered();
  look.smooth_solid = 1;
  const World world(volume, look, {});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 500; ++i) {
    const Exact out = accuracy::unit({any(random), any(random), any(random)});
    const double met = world.exact.field.first_crossing({Exact{20, 20, 20} + out * 30, out * -1});
    ASSERT_NEAR(met, 18, 0.15);  // the blur makes a ball of 12 cells smaller by 0.1
    const Exact normal = world.exact.field.normal(Exact{20, 20, 20} + out * (30 - met));
    ASSERT_GT(dot(normal, out), std::cos(4 * std::acos(-1.0) / 180));
  }
}

// A quadratic spline is a linear one averaged over a cell. So its slope along an axis is the difference of
// the levels half a cell on either side, averaged over the square across.
TEST(ExactPicture, TheNormalIsThatOfAveragedLevels) {
  const state::Grid grid{24, 24, 24};
  state::Volume volume(grid);
  test::ball(volume, 11.3, 12.1, 12.7, 6);
  const World world(volume, unfiltered(), {});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  constexpr int kMiddles = 40;
  for (int i = 0; i < 50; ++i) {
    const Exact p = Exact{11.3, 12.1, 12.7} + accuracy::unit({any(random), any(random), any(random)}) * 6;
    Exact slope;
    for (int a = 0; a < kMiddles; ++a)
      for (int b = 0; b < kMiddles; ++b) {
        const double u = (a + 0.5) / kMiddles - 0.5, v = (b + 0.5) / kMiddles - 0.5;
        const auto level = [&](Exact aside) { return world.exact.field.level(p + aside); };
        slope =
            slope + Exact{level({0.5, u, v}) - level({-0.5, u, v}), level({u, 0.5, v}) - level({u, -0.5, v}),
                          level({u, v, 0.5}) - level({u, v, -0.5})};
      }
    expect_near(world.exact.field.normal(p), accuracy::unit(slope * -1), 1e-3);
  }
}

// The heights are 4 + x / 4, which the filters leave as they are away from the sides.
TEST(ExactPicture, AGroundWithASlope) {
  const state::Grid grid{32, 24, 32};
  scene::Terrain terrain = test::floor_terrain(grid);
  for (std::size_t i = 0; i < terrain.height.size(); ++i)
    terrain.height[i] = 4 + 0.25f * (static_cast<float>(i % 32) + 0.5f);
  const World world(state::Volume(grid), unfiltered(), {}, terrain);
  const accuracy::ExactGround& ground = world.exact.ground;
  // From (10, 20, 16) along (1, -1, 0) it meets 4 + x / 4 at x = 10 + t, 20 - t = 6.5 + t / 4.
  const auto top = ground.first_crossing({{10, 20, 16}, {1, -1, 0}});
  EXPECT_NEAR(top.place, 10.8, 0.01);
  EXPECT_EQ(top.face, picture::Face::top);
  expect_near(ground.surface({20.8, 9.2, 16}, top.face).normal, accuracy::unit({-0.25, 1, 0}), 1e-3);
  using picture::Face;
  const auto side = ground.first_crossing({{-3, 2, 16}, {1, 0.25, 0}});
  EXPECT_NEAR(side.place, 3, 1e-9);
  EXPECT_EQ(side.face, Face::low_x);
  EXPECT_EQ(ground.first_crossing({{35, 2, 16}, {-1, 0, 0.25}}).face, Face::high_x);
  EXPECT_EQ(ground.first_crossing({{16, 2, -2}, {0.25, 0, 1}}).face, Face::low_z);
  EXPECT_EQ(ground.first_crossing({{16, 2, 34}, {0.25, 0, -1}}).face, Face::high_z);
  EXPECT_EQ(ground.first_crossing({{16, -5, 16}, {0.25, 1, 0}}).face, Face::under);
  EXPECT_EQ(ground.first_crossing({{16, 2, 16}, {0.25, 1, 0}}).face, Face::none);
  EXPECT_LT(ground.first_crossing({{-3, 12, 16}, {1, 0.25, 0}}).place, 0);
}

// The march takes plain trilinear levels every 1/64 cell. No ray meets matter before the exact one says so,
// and none that says so is empty.
TEST(ExactPicture, MeetsWhatADenseMarchMeets) {
  const state::Grid grid{40, 36, 44};
  const World world(test::ball_and_puddle(grid), {}, {}, test::floor_terrain(grid));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  int met = 0, grazed = 0, ground_met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Exact eye{20 + 60 * any(random), 18 + 60 * any(random), 22 + 60 * any(random)};
    const Exact to = Exact{20 + 20 * any(random), 14 * (1 + any(random)), 22 + 22 * any(random)} - eye;
    const double largest = std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)});
    const ExactRay ray{eye, to * (1 / largest)};
    const auto level = [&](Exact p) {
      const double x = std::floor(p.x - 0.5), y = std::floor(p.y - 0.5), z = std::floor(p.z - 0.5);
      double sum = 0;
      for (int c = 0; c < 8; ++c) {
        const int a = c & 1, b = c >> 1 & 1, d = c >> 2;
        const double fx = p.x - 0.5 - x, fy = p.y - 0.5 - y, fz = p.z - 0.5 - z;
        sum += (a ? fx : 1 - fx) * (b ? fy : 1 - fy) * (d ? fz : 1 - fz) *
               world.data.levels(static_cast<int>(x) + a, static_cast<int>(y) + b, static_cast<int>(z) + d);
      }
      return sum;
    };
    const auto in_ground = [&](Exact p) {
      return p.x >= 0 && p.x < 40 && p.z >= 0 && p.z < 44 && p.y >= 0 &&
             p.y < world.exact.ground.drawn_height(p.x, p.z);
    };
    double dense = -1, ground = -1;
    for (int k = 0; k < 200 * 64 && (dense < 0 || ground < 0); ++k) {
      const Exact p = ray.at(k / 64.0);
      if (dense < 0 && level(p) >= 0) dense = k / 64.0;
      if (ground < 0 && in_ground(p)) ground = k / 64.0;
    }
    const double exact = world.exact.field.first_crossing(ray);
    if (dense >= 0) {
      ++met;
      ASSERT_GE(exact, 0);
      ASSERT_LE(exact, dense + 1e-6);
    }
    if (exact > 0) {
      ASSERT_NEAR(level(ray.at(exact)), 0, 0.01);
      if (dense < 0 || exact < dense - 1.0 / 64 - 1e-6) ++grazed;
    }
    const auto floor = world.exact.ground.first_crossing(ray);
    if (ground >= 0) {
      ++ground_met;
      ASSERT_GE(floor.place, 0);
      ASSERT_LE(floor.place, ground + 1e-6);
      ASSERT_GE(floor.place, ground - 1.0 / 64 - 1e-6);
    }
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(ground_met, 500);
  EXPECT_LT(grazed, 20);
}

TEST(ExactPicture, IsNearTheReference) {
  const state::Grid grid{40, 36, 44};
  scene::Look look;
  look.glow = true;
  look.metallic = 0.5;
  struct Asked {
    double elevation;
    bool orthographic;
  };
  for (const Asked& from : {Asked{20.0, false}, Asked{-30.0, false}, Asked{25.0, true}}) {
    scene::Terrain terrain = test::floor_terrain(grid);
    terrain.textured = true;
    const World world(test::ball_and_puddle(grid), look, {}, terrain);
    scene::Camera asked = test::small_camera(grid, 60, 50);
    asked.elevation = from.elevation;
    asked.orthographic = from.orthographic;
    asked.distance = 120;
    const picture::Camera camera = render::camera_in_integers(asked);
    const accuracy::ExactPicture picture(world.exact, camera, world.data.levels.cells());
    cpu::Workers workers(1);
    const auto exact = accuracy::sampled(
        60, 50, accuracy::fast_sampling(),
        [&](int x, int y, accuracy::Places p) { return picture.pixel(x, y, p); }, workers);
    const render::Image reference = render::reference_picture(world.data, camera, render::Setting::fast);
    EXPECT_GT(accuracy::psnr(exact.image, reference), 44);
    std::size_t far = 0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i)
      far += picture::differ(exact.image.pixels[i], reference.pixels[i], 3) ? 1 : 0;
    EXPECT_LT(far, reference.pixels.size() / 50);
  }
}

TEST(IntegerPixels, AreThoseOfTheReference) {
  const state::Grid grid{40, 36, 44};
  const World world(test::ball_and_puddle(grid), {}, {}, test::floor_terrain(grid));
  scene::Camera asked = test::small_camera(grid, 48, 36);
  asked.distance = 110;
  const picture::Camera camera = render::camera_in_integers(asked);
  cpu::Workers workers(2);
  const auto drawn = [&](int spacing, const accuracy::Sampling& sampling) {
    const accuracy::IntegerPixels integers(world.data, world.exact.field, camera, spacing);
    return accuracy::sampled(
        48, 36, sampling, [&](int x, int y, accuracy::Places p) { return integers.pixel(x, y, p); }, workers);
  };
  using render::Setting;
  EXPECT_EQ(drawn(2, accuracy::fast_sampling()).image,
            render::reference_picture(world.data, camera, Setting::fast));
  EXPECT_EQ(drawn(2, accuracy::normal_sampling()).image,
            render::reference_picture(world.data, camera, Setting::normal));
  EXPECT_EQ(drawn(3, accuracy::best_sampling()).image,
            render::reference_picture(world.data, camera, Setting::best));
  EXPECT_EQ(drawn(2, accuracy::fast_sampling()).samples, 1);
}

TEST(Compare, PsnrByHand) {
  const render::Image a(2, 1, {10, 20, 30});
  render::Image b = a;
  EXPECT_TRUE(std::isinf(accuracy::psnr(a, b)));
  b.at(1, 0) = {13, 20, 26};  // 9 + 16 over 6 bytes
  EXPECT_NEAR(accuracy::psnr(a, b), 10 * std::log10(65025 * 6 / 25.0), 1e-12);
  EXPECT_EQ(accuracy::difference_picture(a, b).at(1, 0), (render::Rgb{104, 128, 160}));
}

}  // namespace
}  // namespace voxmelt
