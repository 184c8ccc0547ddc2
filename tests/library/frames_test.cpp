// Frames, depths and picked cells are held against a scene whose numbers are worked by hand, and against
// draw().
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>

#include "tests/library/scene_file.h"

namespace voxmelt {
namespace {

// Nothing is filtered, so flat faces of full cells are drawn where they are. The box has the cells 10..19,
// 3..12 and 8..11. Water lies beside it, and a pillar that never melts. The floor is two cells deep.
const char* const kBoxes = R"(
[grid]
size = [40, 20, 24]
[look]
smooth = 0
smooth_solid = 0
[[solid]]
shape = "box"
size = [10, 10, 4]
at = [15, 8, 10]
[[liquid]]
shape = "box"
size = [6, 8, 6]
at = [28, 7, 10]
[[inert]]
shape = "box"
size = [4, 12, 4]
at = [36, 9, 10]
[[inert]]
shape = "floor"
thickness = 2
)";

class Frames : public SceneFile {
 protected:
  Simulation boxes() { return Simulation(write("boxes.toml", kBoxes)); }

  // Looks from the front, in parallel. A pixel is an eighth of a cell, and pixel (0, 0) shows x = 0 and y =
  // 20. Half the height of the picture is 10 cells, which are distance x tan 45 degrees.
  static Picture from_the_front() {
    Camera camera;
    camera.target = {20, 10, 12};
    camera.distance = 10;
    camera.azimuth = camera.elevation = 0;
    camera.field_of_view = 90;
    camera.projection = Projection::orthographic;
    Picture picture;
    picture.camera = camera;
    picture.width = 320;
    picture.height = 160;
    picture.depth = true;
    return picture;
  }
  // These give the pixel that shows a place of the front.
  static int column(double x) { return static_cast<int>(8 * x); }
  static int row(double y) { return static_cast<int>(8 * (20 - y)); }
};

TEST_F(Frames, ThePickedCellIsTheOneInFrontByHand) {
  Simulation simulation = boxes();
  const Picture picture = from_the_front();
  const auto at = [&](double x, double y) { return simulation.pick(column(x), row(y), picture); };
  const std::optional<Hit> solid = at(15.5, 8.5), liquid = at(28.5, 6.5), obstacle = at(36.5, 9.5),
                           ground = at(5.5, 1.5), nothing = at(5.5, 12.5);
  ASSERT_TRUE(solid && liquid && obstacle && ground);
  EXPECT_FALSE(nothing);

  EXPECT_EQ(solid->shown, Shown::solid);
  EXPECT_EQ(solid->matter, (Cell{15, 8, 11}));
  EXPECT_NEAR(solid->position[0], 15.5 + 1.0 / 16, 1e-5);
  EXPECT_NEAR(solid->position[1], 8.5 - 1.0 / 16, 1e-5);
  EXPECT_NEAR(solid->position[2], 12, 0.01) << "the front face of cell 11";
  EXPECT_NEAR(solid->normal[2], 1, 1e-3);
  EXPECT_EQ(liquid->shown, Shown::liquid);
  EXPECT_EQ(liquid->matter, (Cell{28, 6, 12}));
  EXPECT_EQ(obstacle->shown, Shown::obstacle);
  EXPECT_EQ(obstacle->matter, (Cell{36, 9, 11}));
  EXPECT_EQ(ground->shown, Shown::ground);
  EXPECT_EQ(ground->matter, (Cell{5, 1, 23}));
  EXPECT_NEAR(ground->position[2], 24, 0.01) << "the side of the slab";
  for (const std::optional<Hit>& hit : {solid, liquid, obstacle, ground})
    EXPECT_TRUE(hit->cell == hit->matter ||
                hit->cell == (Cell{hit->matter.x, hit->matter.y, hit->matter.z + 1}))
        << hit->cell.z << " lies before " << hit->matter.z;
}

TEST_F(Frames, DepthsDifferByTheDistancesOfTheFaces) {
  Simulation simulation = boxes();
  const Frame frame = simulation.render(from_the_front());
  ASSERT_EQ(frame.depth.size(), 320u * 160u);
  const auto at = [&](double x, double y) {
    return double{frame.depth[static_cast<std::size_t>(row(y) * 320 + column(x))]};
  };
  EXPECT_GT(frame.eye[2], 24) << "before the grid";
  EXPECT_NEAR(at(15.5, 8.5), frame.eye[2] - 12, 0.01);
  EXPECT_NEAR(at(28.5, 6.5), frame.eye[2] - 13, 0.01);
  EXPECT_NEAR(at(5.5, 1.5), frame.eye[2] - 24, 0.01);
  EXPECT_EQ(at(5.5, 12.5), std::numeric_limits<double>::infinity());
}

// In perspective the eye is where the camera says, and a depth is no length along the ray.
TEST_F(Frames, PerspectiveDepthsCountFromTheCamera) {
  Simulation simulation = boxes();
  Picture picture = from_the_front();
  picture.camera->projection = Projection::perspective;
  picture.camera->distance = 50;
  const Frame frame = simulation.render(picture);
  EXPECT_NEAR(frame.eye[0], 20, 1e-5);
  EXPECT_NEAR(frame.eye[1], 10, 1e-5);
  EXPECT_NEAR(frame.eye[2], 62, 1e-5);
  // The box's face, z = 12, is 50 cells away: its place (15, 8) is 5 / 50 to the left, and 2 / 50 down.
  const int x = static_cast<int>(160 - 80 * 5.0 / 50), y = static_cast<int>(80 + 80 * 2.0 / 50);
  EXPECT_NEAR(double{frame.depth[static_cast<std::size_t>(y * 320 + x)]}, 50, 0.01);
  const std::optional<Hit> hit = simulation.pick(x, y, picture);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->position[0], 15, 0.5);
  EXPECT_NEAR(hit->position[1], 8, 0.5);
  EXPECT_EQ(hit->matter.z, 11);
}

// In any view and setting, pick() says what the frame has there.
TEST_F(Frames, PicksAreTheFramesDepths) {
  Simulation simulation(file);
  simulation.step(100);
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (const Quality quality : {Quality::fast, Quality::best}) {
      Picture picture;
      picture.camera = simulation.camera();
      picture.camera->projection = projection;
      picture.width = 48;
      picture.height = 32;
      picture.quality = quality;
      picture.depth = true;
      const Frame frame = simulation.render(picture);
      std::size_t seen = 0;
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
          const std::optional<Hit> hit = simulation.pick(x, y, picture);
          const float depth = frame.depth[static_cast<std::size_t>(48 * y + x)];
          ASSERT_EQ(hit.has_value(), std::isfinite(depth));
          if (!hit) continue;
          ++seen;
          ASSERT_EQ(hit->depth, double{depth});
          const State state = simulation.state();
          const Cell m = hit->matter;
          EXPECT_TRUE(state.solid.test(m.x, m.y, m.z) || state.liquid.test(m.x, m.y, m.z) ||
                      state.inert.test(m.x, m.y, m.z));
        }
      EXPECT_GT(seen, 100u);
    }
}

TEST_F(Frames, RowsAreAlignedAndTheSameBytes) {
  Simulation simulation(file);
  Picture picture;
  picture.width = 50;
  picture.height = 20;
  const Frame plain = simulation.render(picture);
  EXPECT_EQ(plain.stride, 150u);
  EXPECT_EQ(plain.rgb.size(), 3000u);
  EXPECT_TRUE(plain.depth.empty());
  picture.row_alignment = 64;
  const Frame aligned = simulation.render(picture);
  ASSERT_EQ(aligned.stride, 192u);
  ASSERT_EQ(aligned.rgb.size(), 20u * 192u);
  for (std::size_t y = 0; y < 20; ++y) {
    EXPECT_TRUE(std::equal(&plain.rgb[150 * y], &plain.rgb[150 * y] + 150, &aligned.rgb[192 * y]));
    for (std::size_t i = 150; i < 192; ++i) EXPECT_EQ(aligned.rgb[192 * y + i], 0);
  }
}

TEST_F(Frames, TheSceneSCameraIsTheOneThatDrawsItAnew) {
  Simulation simulation(file);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Picture picture;
    picture.width = 64;
    picture.height = 48;
    picture.camera = Camera{{35, 6, 10}, 0, 20, 30, 40, projection};
    const Frame fitted = simulation.render(picture);
    picture.camera = simulation.camera(picture);
    EXPECT_GT(picture.camera->distance, 10);
    EXPECT_EQ(simulation.render(picture).rgb, fitted.rgb);
    picture.camera->distance *= 1.5;
    EXPECT_NE(simulation.render(picture).rgb, fitted.rgb);
  }
  EXPECT_EQ(simulation.camera().azimuth, 35) << "the scene's, by default";
}

TEST_F(Frames, AStopEndsAPicture) {
  Simulation simulation(file);
  std::stop_source source;
  const Frame whole = simulation.render({}, source.get_token());
  source.request_stop();
  EXPECT_EQ(message_of<Stopped>([&] { (void)simulation.render({}, source.get_token()); }), "stopped");
  EXPECT_EQ(simulation.render().rgb, whole.rgb) << "the next one is drawn";
  simulation.draw(folder / "p.png");
}

TEST_F(Frames, NumbersOutOfTheirRangeAreNamed) {
  Simulation simulation(file);
  const auto said = [&](const auto& change) {
    Picture picture;
    picture.camera = Camera{};
    change(picture);
    return message_of<InputError>([&] { (void)simulation.render(picture); });
  };
  EXPECT_EQ(said([](Picture& p) { p.camera->field_of_view = 0.5; }),
            "Picture: error: camera.field_of_view = 0.500000 is outside 1.000000..120.000000");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(said([&](Picture& p) { p.camera->target[1] = nan; }).find("camera.target"), std::string::npos);
  EXPECT_NE(said([](Picture& p) { p.camera->distance = -1; }).find("camera.distance"), std::string::npos);
  EXPECT_NE(said([](Picture& p) { p.camera->elevation = 90; }).find("camera.elevation"), std::string::npos);
  EXPECT_NE(said([](Picture& p) { p.row_alignment = 0; }).find("row_alignment"), std::string::npos);
  EXPECT_NE(said([](Picture& p) { p.width = 15; }).find("width"), std::string::npos);
  Picture picture;
  picture.width = 100;
  EXPECT_EQ(message_of<InputError>([&] { (void)simulation.pick(100, 0, picture); }),
            "pick: error: x = 100 is outside 0..99");
  EXPECT_NE(message_of<InputError>([&] { (void)simulation.pick(0, -1, picture); }), "nothing");
}

}  // namespace
}  // namespace voxmelt
