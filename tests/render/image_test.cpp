// Files and sheets.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "render/image/camera.h"
#include "render/image/contact_sheet.h"
#include "render/image/label.h"
#include "render/image/png.h"
#include "render/image/video.h"

namespace voxmelt {
namespace {

namespace fs = std::filesystem;
using render::Image;

class Files : public testing::Test {
 protected:
  Files()
      : folder_(fs::temp_directory_path() / ("voxmelt_image_test_" + std::to_string(::getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~Files() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path folder_;
};

Image random_image(int width, int height) {
  std::mt19937 random(3);
  Image image(width, height);
  for (render::Rgb& pixel : image.pixels)
    for (std::uint8_t& part : pixel) part = static_cast<std::uint8_t>(random());
  return image;
}

TEST_F(Files, PngRoundTrip) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {64, 3}}) {
    const Image image = random_image(width, height);
    render::write_png(folder_ / "a.png", image);
    EXPECT_TRUE(render::read_png(folder_ / "a.png") == image);
  }
  EXPECT_FALSE(fs::exists(folder_ / "a.png.part"));
}

TEST_F(Files, PngErrorsNameFileAndReason) {
  try {
    render::write_png(folder_ / "missing" / "a.png", random_image(2, 2));
    FAIL() << "the folder does not exist";
  } catch (const render::ImageError& error) {
    EXPECT_NE(std::string(error.what()).find("missing"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
  std::ofstream(folder_ / "text.png") << "this is not a picture";
  EXPECT_THROW(render::read_png(folder_ / "text.png"), render::ImageError);
  EXPECT_THROW(render::read_png(folder_ / "none.png"), render::ImageError);
}

TEST_F(Files, VideoOrReason) {
  for (int i = 0; i < 4; ++i)
    render::write_png(folder_ / ("frame_0000" + std::to_string(i) + ".png"), random_image(33, 32));
  const auto problem =
      render::write_video(folder_ / "film.mp4", (folder_ / "frame_%05d.png").string(), 0, 10);
  if (problem) {
    EXPECT_NE(problem->find("film.mp4"), std::string::npos) << *problem;
    GTEST_SKIP() << *problem;
  }
  EXPECT_GT(fs::file_size(folder_ / "film.mp4"), 0u);
}

TEST_F(Files, VideoOfNothingIsAMessage) {
  const auto problem = render::write_video(folder_ / "film.mp4", (folder_ / "none_%05d.png").string(), 0, 10);
  ASSERT_TRUE(problem.has_value());
  EXPECT_FALSE(fs::exists(folder_ / "film.mp4"));
  EXPECT_FALSE(fs::exists(folder_ / "film.mp4.part"));
}

TEST(ContactSheet, PlacesFramesInReadingOrder) {
  std::vector<Image> frames;
  for (int i = 0; i < 5; ++i)
    frames.emplace_back(10, 6, render::Rgb{static_cast<std::uint8_t>(10 + i), 0, 0});
  render::SheetStyle style;
  style.columns = 3;
  style.gap = 2;
  const Image sheet = render::contact_sheet(frames, {}, style);
  EXPECT_EQ(sheet.width, 3 * 12 + 2);
  EXPECT_EQ(sheet.height, 2 * 8 + 2);
  EXPECT_EQ(sheet.at(2, 2)[0], 10);
  EXPECT_EQ(sheet.at(26, 2)[0], 12);
  EXPECT_EQ(sheet.at(14, 10)[0], 14);
  EXPECT_EQ(sheet.at(0, 0), style.gap_color);
  EXPECT_EQ(render::contact_sheet({}, {}).width, 0);
}

TEST(Label, DrawsInsideThePictureOnly) {
  Image image(20, 10);
  render::draw_label(image, "Step 120", -3, 4, 2, {255, 255, 255});
  render::draw_label(image, "1", 2, 1, 1, {9, 9, 9});
  EXPECT_EQ(image.at(4, 1), (render::Rgb{9, 9, 9})) << "the tip of the one";
  EXPECT_EQ(render::label_width("AB", 2), 22);
}

TEST(Camera, FitsTheGridAndLooksAtTheTarget) {
  const state::Grid grid{64, 32, 48};
  scene::Camera camera;
  camera.target = {32, 16, 24};
  const render::CameraView view(camera, grid);
  const render::Ray middle = view.ray(320, 240);
  const render::Vec to_target = normalized(render::vec(camera.target) - middle.origin);
  EXPECT_GT(dot(middle.direction, to_target), 0.99999f);
  EXPECT_GT(length(middle.origin - render::vec(camera.target)), 40);
  EXPECT_GT(view.ray(320, 0).direction.y, view.ray(320, 480).direction.y);

  // Azimuth 0 stands at +z, azimuth 90 at +x.
  camera.azimuth = 0;
  EXPECT_GT(render::CameraView(camera, grid).position().z, 48);
  camera.azimuth = 90;
  EXPECT_GT(render::CameraView(camera, grid).position().x, 64);
}

}  // namespace
}  // namespace voxmelt
