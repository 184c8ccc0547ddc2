// Pictures depend neither on threads nor on the samples left out, and have no specks.
#include "render/packet/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "kernel/engine/cpu/instruction_set.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/picture_scene.h"
#include "render/reference/reference_picture.h"
#include "tests/render/shapes.h"
#include "tests/render/sight.h"

namespace voxmelt {
namespace {

using render::DensityField;
using render::Image;
using render::Picture;
using render::Setting;

const state::Grid kGrid{48, 40, 48};
constexpr Setting kSettings[] = {Setting::fast, Setting::normal, Setting::best};

Picture picture_of(const state::Volume& volume, const scene::Look& look = {},
                   const scene::Terrain& terrain = test::floor_terrain(kGrid)) {
  Picture picture;
  picture.update(volume, look, {}, terrain, 1);
  return picture;
}

Image drawn(const state::Volume& volume, const scene::Camera& camera, const scene::Look& look = {},
            const scene::Terrain& terrain = test::floor_terrain(kGrid)) {
  return picture_of(volume, look, terrain).draw(camera, Setting::normal, 1);
}

// The pictures are drawn by every instruction set that this processor has.
TEST(Picture, LeavingSamplesOutChangesNothing) {
  const Picture picture = picture_of(test::ball_and_puddle(kGrid));
  for (const double azimuth : {0.0, 35.0, 211.0})
    for (const double elevation : {28.0, -20.0})
      for (const cpu::InstructionSetRow& row : cpu::kInstructionSets) {
        if (!row.supported()) continue;
        scene::Camera camera = test::small_camera(kGrid);
        camera.azimuth = azimuth;
        camera.elevation = elevation;
        const render::Packets& packets = render::packets_of(row.set);
        const Image skipped = picture.draw(camera, Setting::best, 1, packets);
        render::PictureData data = picture.data(render::camera_in_integers(camera), Setting::best);
        data.skip = false;
        EXPECT_TRUE(skipped == draw_picture(data, Setting::best, packets, 1)) << azimuth << " " << row.name;
      }
}

TEST(Picture, ThreadsChangeNothing) {
  const Picture picture = picture_of(test::ball_and_puddle(kGrid));
  const scene::Camera camera = test::small_camera(kGrid);
  for (const Setting setting : kSettings) {
    const Image one = picture.draw(camera, setting, 1);
    const render::SurfacePicture surface = picture.surface(camera, setting, 1);
    for (const int threads : {2, 5, 200}) {
      EXPECT_TRUE(one == picture.draw(camera, setting, threads)) << threads;
      EXPECT_TRUE(surface == picture.surface(camera, setting, threads)) << threads;
      Picture other;
      other.update(test::ball_and_puddle(kGrid), {}, {}, test::floor_terrain(kGrid), threads);
      EXPECT_TRUE(one == other.draw(camera, setting, 1)) << threads;
    }
  }
}

TEST(Picture, IsThatOfTheReference) {
  const state::Volume volume = test::ball_and_puddle(kGrid);
  const Picture picture = picture_of(volume);
  DensityField field;
  field.update(volume, {}, test::floor_terrain(kGrid));
  const render::PictureScene scene(field, {}, {}, test::floor_terrain(kGrid));
  const scene::Camera camera = test::small_camera(kGrid, 67, 45);
  for (const Setting setting : kSettings) {
    const picture::Camera integers = render::camera_in_integers(camera);
    EXPECT_TRUE(picture.draw(camera, setting, 1) == reference_picture(scene, integers, setting));
    EXPECT_TRUE(picture.surface(camera, setting, 1) == reference_surface(scene, integers, setting));
  }
}

TEST(Picture, EmptyVolumeIsBackground) {
  const Picture picture = picture_of(state::Volume(kGrid), {}, {});
  const scene::Camera camera = test::small_camera(kGrid, 16, 12);
  const Image image = picture.draw(camera, Setting::normal, 1);
  for (const render::Rgb& pixel : image.pixels) EXPECT_EQ(pixel, image.pixels[0]);
  EXPECT_GT(image.pixels[0][0], 240);  // the look's background is nearly white
  for (const std::uint16_t depth : picture.surface(camera, Setting::normal, 1).depth)
    EXPECT_EQ(depth, picture::kNoDepth);
}

TEST(Picture, BallIsRoundAndItsNormalsPointOut) {
  state::Volume volume(kGrid);
  test::ball(volume, 24, 20, 24, 10);
  DensityField field;
  field.update(volume, {});
  const test::Sight sight(field);
  const test::Point centre{24, 20, 24};
  for (int i = 0; i < 200; ++i) {
    const double up = 1 - 2 * (i + 0.5) / 200, turn = 2.4 * i;
    const double side = std::sqrt(1 - up * up);
    const test::Point out{side * std::cos(turn), up, side * std::sin(turn)};
    const auto hit = sight.find(centre + out * 60, out * -1);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(length(hit->point - centre), 10, 0.25);
    EXPECT_GT(dot(hit->normal, out), 0.99);
  }
}

// A hot sheet is seen from above. Every pixel well inside the sheet glows, and neighbours differ little.
TEST(Picture, HotSheetHasNoSpecks) {
  state::Volume volume = test::floor_volume(kGrid);
  for (int z = 8; z < 40; ++z)
    for (int x = 8; x < 40; ++x)
      test::pour(volume, x, z, 0.3 + 1.5 * (0.5 + 0.5 * std::sin(x * 0.4) * std::cos(z * 0.5)), 0.85);
  scene::Look look;
  look.glow = true;
  scene::Camera camera = test::small_camera(kGrid, 160, 160);
  camera.target = {24, 2, 24};
  camera.azimuth = 0;
  camera.elevation = 80;
  camera.distance = 44;  // the picture shows about 24 cells, and the sheet alone
  const Image image = drawn(volume, camera, look);
  for (int y = 1; y < image.height; ++y)
    for (int x = 1; x < image.width; ++x) {
      const render::Rgb& pixel = image.at(x, y);
      ASSERT_GT(pixel[0], 200) << x << "," << y;
      ASSERT_LT(std::abs(pixel[1] - image.at(x - 1, y)[1]), 24) << x << "," << y;
      ASSERT_LT(std::abs(pixel[1] - image.at(x, y - 1)[1]), 24) << x << "," << y;
    }
}

// Even a film far thinner than a cell shows, and it hides the floor completely.
TEST(Picture, ThinFilmIsVisible) {
  for (const double height : {0.1, 0.2, 0.4}) {
    state::Volume volume = test::floor_volume(kGrid);
    for (int z = 0; z < kGrid.z; ++z)
      for (int x = 0; x < kGrid.x; ++x) test::pour(volume, x, z, height);
    scene::Look look;
    look.liquid = {0.0, 0.0, 0.9};
    look.specular = 0;
    scene::Camera camera = test::small_camera(kGrid, 40, 40);
    camera.target = {24, 2, 24};
    camera.elevation = 50;
    camera.distance = 40;
    const Image image = drawn(volume, camera, look);
    for (const render::Rgb& pixel : image.pixels) ASSERT_GT(pixel[2], pixel[0] + 40) << height;
  }
}

// The state says where its ground is. A scene's terrain is a refinement of it.
TEST(Picture, GroundComesFromTheFieldWithoutATerrain) {
  const state::Volume volume = test::ball_and_puddle(kGrid);
  const scene::Camera camera = test::small_camera(kGrid);
  EXPECT_TRUE(drawn(volume, camera, {}, {}) == drawn(volume, camera));
  EXPECT_FALSE(drawn(volume, camera) == drawn(state::Volume(kGrid), camera, {}, {}));
}

// The camera of a scene file is in degrees and cells. The middle of the picture shows its target, and up is
// up.
TEST(Picture, CameraLooksAtTheTarget) {
  state::Volume volume(kGrid);
  test::ball(volume, 12, 25, 30, 5);
  const Picture picture = picture_of(volume, {}, {});
  scene::Camera camera;
  camera.target = {12, 25, 30};
  camera.width = camera.height = 65;
  for (const double azimuth : {0.0, 90.0, 200.0}) {
    camera.azimuth = azimuth;
    const render::SurfacePicture seen = picture.surface(camera, Setting::fast, 1);
    const auto row = [&](std::size_t y) { return seen.normal[y * 65 + 32]; };
    // The middle of the ball faces the camera: azimuth 0 stands at +z, azimuth 90 at +x.
    const double turn = azimuth * 3.14159265 / 180, up = 28 * 3.14159265 / 180;
    EXPECT_NEAR(row(32)[0] / 16384.0, std::sin(turn) * std::cos(up), 0.06) << azimuth;
    EXPECT_NEAR(row(32)[1] / 16384.0, std::sin(up), 0.06) << azimuth;
    EXPECT_NEAR(row(32)[2] / 16384.0, std::cos(turn) * std::cos(up), 0.06) << azimuth;
    EXPECT_GT(row(30)[1], row(34)[1]) << azimuth;
  }
}

}  // namespace
}  // namespace voxmelt
