// Pictures: independent of threads and brick skipping, free of specks.
#include <gtest/gtest.h>

#include <cmath>

#include "render/raycast/draw.h"
#include "render/raycast/glow.h"
#include "render/raycast/surface.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

using render::DensityField;
using render::DrawSettings;
using render::Image;

const state::Grid kGrid{48, 40, 48};

TEST(Draw, SkippingBricksChangesNothing) {
  const scene::Look look;
  DensityField field;
  field.update(test::ball_and_puddle(kGrid), look);
  for (const double azimuth : {0.0, 35.0, 211.0}) {
    scene::Camera camera = test::small_camera(kGrid);
    camera.azimuth = azimuth;
    DrawSettings settings;
    const Image skipped = draw(field, camera, {}, look, test::floor_terrain(kGrid), settings);
    settings.skip_empty = false;
    EXPECT_TRUE(skipped == draw(field, camera, {}, look, test::floor_terrain(kGrid), settings)) << azimuth;
  }
}

TEST(Draw, ThreadsChangeNothing) {
  const scene::Look look;
  DensityField field;
  field.update(test::ball_and_puddle(kGrid), look);
  DrawSettings settings;
  settings.threads = 1;
  const scene::Camera camera = test::small_camera(kGrid);
  const Image one = draw(field, camera, {}, look, test::floor_terrain(kGrid), settings);
  for (const int threads : {2, 5, 200}) {
    settings.threads = threads;
    EXPECT_TRUE(one == draw(field, camera, {}, look, test::floor_terrain(kGrid), settings)) << threads;
  }
}

TEST(Draw, EmptyVolumeIsBackground) {
  const scene::Look look;
  DensityField field;
  field.update(state::Volume(kGrid), look);
  const Image image = draw(field, test::small_camera(kGrid, 16, 12), {}, look, {});
  for (const render::Rgb& pixel : image.pixels) EXPECT_EQ(pixel, image.pixels[0]);
}

TEST(Surface, BallIsRoundAndItsNormalsPointOut) {
  state::Volume volume(kGrid);
  test::ball(volume, 24, 20, 24, 10);
  DensityField field;
  scene::Look look;
  look.smooth = 1;
  field.update(volume, look);
  const render::Surface surface(field, true);
  const render::Vec centre{24, 20, 24};
  for (int i = 0; i < 200; ++i) {
    const float up = 1 - 2 * (static_cast<float>(i) + 0.5f) / 200, turn = 2.4f * static_cast<float>(i);
    const float side = std::sqrt(1 - up * up);
    const render::Vec out{side * std::cos(turn), up, side * std::sin(turn)};
    const auto hit = surface.find({centre + out * 60, -out}, 1000);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(length(hit->point - centre), 10, 0.25f);
    EXPECT_GT(dot(hit->normal, out), 0.99f);
  }
}

// A hot sheet from above: every pixel well inside the sheet glows, and neighbours differ little.
TEST(Draw, HotSheetHasNoSpecks) {
  state::Volume volume = test::floor_volume(kGrid);
  for (int z = 8; z < 40; ++z)
    for (int x = 8; x < 40; ++x)
      test::pour(volume, x, z, 0.3 + 1.5 * (0.5 + 0.5 * std::sin(x * 0.4) * std::cos(z * 0.5)), 0.85);
  scene::Look look;
  look.glow = true;
  DensityField field;
  field.update(volume, look);
  scene::Camera camera = test::small_camera(kGrid, 160, 160);
  camera.target = {24, 2, 24};
  camera.azimuth = 0;
  camera.elevation = 80;
  camera.distance = 44;  // the picture shows about 24 cells: sheet alone
  const Image image = draw(field, camera, {}, look, test::floor_terrain(kGrid));
  for (int y = 1; y < image.height; ++y)
    for (int x = 1; x < image.width; ++x) {
      const render::Rgb& pixel = image.at(x, y);
      ASSERT_GT(pixel[0], 200) << x << "," << y;
      ASSERT_LT(std::abs(pixel[1] - image.at(x - 1, y)[1]), 24) << x << "," << y;
      ASSERT_LT(std::abs(pixel[1] - image.at(x, y - 1)[1]), 24) << x << "," << y;
    }
}

// Even a film far thinner than a cell shows, and it hides the floor completely.
TEST(Draw, ThinFilmIsVisible) {
  for (const double height : {0.1, 0.2, 0.4}) {
    state::Volume volume = test::floor_volume(kGrid);
    for (int z = 0; z < kGrid.z; ++z)
      for (int x = 0; x < kGrid.x; ++x) test::pour(volume, x, z, height);
    scene::Look look;
    look.liquid = {0.0, 0.0, 0.9};
    look.specular = 0;
    DensityField field;
    field.update(volume, look);
    scene::Camera camera = test::small_camera(kGrid, 40, 40);
    camera.target = {24, 2, 24};
    camera.elevation = 50;
    camera.distance = 40;
    const Image image = draw(field, camera, {}, look, test::floor_terrain(kGrid));
    for (const render::Rgb& pixel : image.pixels) ASSERT_GT(pixel[2], pixel[0] + 40) << height;
  }
}

// The state says where its ground is; a scene's terrain is a refinement of it.
TEST(Draw, GroundComesFromTheFieldWithoutATerrain) {
  const scene::Look look;
  DensityField field;
  field.update(test::ball_and_puddle(kGrid), look);
  const scene::Camera camera = test::small_camera(kGrid);
  EXPECT_TRUE(draw(field, camera, {}, look, {}) == draw(field, camera, {}, look, test::floor_terrain(kGrid)));
}

TEST(Glow, RampNeverDarkensWithHeat) {
  render::Vec last;
  for (int i = 0; i <= 1000; ++i) {
    const render::Vec color = render::glow_color(static_cast<float>(i) / 1000);
    EXPECT_GE(color.x, last.x);
    EXPECT_GE(color.y, last.y);
    EXPECT_GE(color.z, last.z);
    last = color;
  }
}

}  // namespace
}  // namespace voxmelt
