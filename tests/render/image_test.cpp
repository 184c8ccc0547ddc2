// Files and sheets of pictures are tested.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "render/image/contact_sheet.h"
#include "render/image/label.h"
#include "render/image/png.h"
#include "render/image/png_bytes.h"

namespace voxmelt {
namespace {

namespace fs = std::filesystem;
using render::Image;
using render::Image16;

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

// A smooth picture and a random one choose different filters.
TEST_F(Files, Png16RoundTrip) {
  std::mt19937 random(5);
  for (const int channels : {1, 3})
    for (const auto& [width, height] : {std::pair{1, 1}, {9, 4}, {33, 20}}) {
      Image16 smooth(width, height, channels), rough(width, height, channels);
      for (std::size_t i = 0; i < rough.numbers.size(); ++i) {
        smooth.numbers[i] = static_cast<std::uint16_t>(65535 - 7 * i);
        rough.numbers[i] = static_cast<std::uint16_t>(random());
      }
      for (const Image16& image : {smooth, rough}) {
        render::write_png(folder_ / "a.png", image);
        EXPECT_TRUE(render::read_png16(folder_ / "a.png") == image);
      }
    }
  render::write_png(folder_ / "colors.png", random_image(4, 4));
  EXPECT_THROW(render::read_png16(folder_ / "colors.png"), render::ImageError);
}

// The file begins with the signature, IHDR with its checksum as other programs write them, and sRGB. The
// checksum of IEND is in every PNG file.
TEST(Png, BytesOfAPictureAreAPngFile) {
  const std::string bytes = render::png_bytes(Image(1, 1));
  const std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\2\0\0\0\x90wS\xde", 33);
  const std::string srgb("\0\0\0\1sRGB\0\xae\xce\x1c\xe9", 13);
  const std::string end(
      "\0\0\0\0IEND\xae"
      "B`\x82",
      12);
  EXPECT_EQ(bytes.substr(0, 33), head);
  EXPECT_EQ(bytes.substr(33, 13), srgb);
  EXPECT_EQ(bytes.substr(bytes.size() - 12), end);
}

// Each row repeats the one above it, or each pixel the one on its left. So all differences are 0, except
// those of a side.
TEST(Png, TheBetterFilterIsTaken) {
  Image columns = random_image(300, 300), rows = columns;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) {
      columns.at(x, y) = columns.at(x, 0);
      rows.at(x, y) = rows.at(0, y);
    }
  EXPECT_LT(render::png_bytes(columns).size(), 3000U);
  EXPECT_LT(render::png_bytes(rows).size(), 3500U);
  EXPECT_GT(render::png_bytes(random_image(300, 300)).size(), 270000U);
}

TEST(ContactSheet, PlacesFramesInReadingOrder) {
  std::vector<Image> frames;
  frames.reserve(5);
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

}  // namespace
}  // namespace voxmelt
