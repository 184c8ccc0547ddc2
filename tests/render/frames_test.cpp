// The frames of a run give the same files for any number of threads, stop at the first error, and do not pile
// up.
#include "render/frames/frames.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "render/frames/sheet_frames.h"
#include "render/image/contact_sheet.h"
#include "render/image/png.h"
#include "tests/render/fake_ffmpeg.h"

namespace voxmelt {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using render::Frames;
using render::Image;

constexpr int kWidth = 120, kHeight = 90;
constexpr std::size_t kBytes = 3UL * kWidth * kHeight;

Image frame(std::size_t number) {
  std::mt19937 random(static_cast<std::uint32_t>(number));
  Image image(kWidth, kHeight);
  for (render::Rgb& pixel : image.pixels)
    pixel = {static_cast<std::uint8_t>(number), static_cast<std::uint8_t>(random() & 31), 200};
  return image;
}

class FrameFiles : public testing::Test {
 protected:
  FrameFiles() : folder_(fs::temp_directory_path() / ("voxmelt_frames_test_" + std::to_string(::getpid()))) {}
  ~FrameFiles() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path fresh() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    return folder_;
  }
  // Returns all files by name.
  std::map<std::string, std::string> made(std::size_t planned, std::size_t count, int threads) {
    {
      Frames frames(fresh(), {planned, kBytes, threads});
      for (std::size_t i = 0; i < count; ++i) frames.add(frame(i), "step " + std::to_string(i));
      EXPECT_EQ(frames.finish().note, "");
      EXPECT_EQ(frames.count(), count);
    }
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.is_regular_file())
        files[entry.path().lexically_relative(folder_).string()] = FakeFfmpeg::bytes_of(entry.path());
    return files;
  }

  fs::path folder_;
  FakeFfmpeg ffmpeg_{"cat > \"$film\""};
};

TEST_F(FrameFiles, AreTheSameForAnyNumberOfThreads) {
  const auto files = made(30, 30, 1);
  ASSERT_EQ(files.size(), 32U);
  std::string film;
  for (std::size_t i = 0; i < 30; ++i) film += FakeFfmpeg::raw(frame(i));
  EXPECT_TRUE(files.at("film.mp4") == film);
  for (const int threads : {2, 8}) EXPECT_TRUE(made(30, 30, threads) == files) << threads;
  for (const std::size_t i : {0, 17, 29})
    EXPECT_TRUE(render::read_png(
                    folder_ / "frames" /
                    ("frame_000" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".png")) == frame(i));
}

TEST_F(FrameFiles, AnInterruptedRunHasTheSheetOfAShorterOne) {
  for (const std::size_t count : {1, 2, 13, 27})
    EXPECT_TRUE(made(60, count, 2) == made(count, count, 1)) << count;
}

TEST_F(FrameFiles, OneThreadDoesAllInTurn) {
  const auto threads = [] {
    const fs::directory_iterator tasks("/proc/self/task");
    return std::distance(begin(tasks), end(tasks));
  };
  const auto before = threads();
  Frames frames(fresh(), {2, kBytes, 1});
  frames.add(frame(0), "");
  EXPECT_TRUE(fs::exists(folder_ / "frames/frame_00000.png"));
  EXPECT_EQ(threads(), before);
}

// The frames, by hand, are k (n - 1) / 11, rounded down.
TEST(SheetFrames, AreChosenEvenly) {
  using List = std::vector<std::size_t>;
  EXPECT_EQ(render::shown_frames(0), List{});
  EXPECT_EQ(render::shown_frames(1), List{0});
  EXPECT_EQ(render::shown_frames(3), (List{0, 1, 2}));
  EXPECT_EQ(render::shown_frames(12), (List{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(render::shown_frames(51), (List{0, 4, 9, 13, 18, 22, 27, 31, 36, 40, 45, 50}));
}

// If the plan was right, nothing is read. The mean of four pixels of 10, 20, 30 and 41 is 25.
TEST(SheetFrames, ShowHalvesOfWhatWasOffered) {
  Image image(2, 2);
  image.pixels = {{10, 0, 0}, {20, 0, 0}, {30, 0, 0}, {41, 3, 2}};
  render::SheetFrames frames(2);
  frames.offer(0, image);
  frames.offer(1, image);
  frames.offer(7, image);
  const Image half(1, 1, {25, 1, 1});
  const auto none = [](std::size_t) -> Image { throw std::runtime_error("read"); };
  render::SheetStyle style;
  style.columns = 3;
  EXPECT_TRUE(frames.sheet({"", ""}, none) == render::contact_sheet({half, half}, {"", ""}, style));
  EXPECT_ANY_THROW(frames.sheet({"", "", ""}, none));
}

// A folder stands in the place of frame 5.
TEST_F(FrameFiles, TheFirstErrorIsThrownAndSaysWhere) {
  for (const int threads : {1, 2, 8}) {
    fs::create_directories(fresh() / "frames/frame_00005.png");
    fs::create_directories(folder_ / "frames/frame_00006.png");
    Frames frames(folder_, {1000, kBytes, threads});
    std::string message;
    std::size_t added = 0;
    try {
      for (; added < 1000; ++added) frames.add(frame(added), "");
      frames.finish();
    } catch (const render::ImageError& error) {
      message = error.what();
    }
    EXPECT_EQ(message, (folder_ / "frames/frame_00005.png").string() +
                           ": error: is not a file that a picture could replace");
    EXPECT_LT(added, 30U) << "the error came late";
    if (threads > 1) {
      EXPECT_THROW(frames.check(), render::ImageError);
    }
  }
  EXPECT_FALSE(fs::exists(folder_ / "film.mp4"));
  EXPECT_FALSE(fs::exists(folder_ / "film.mp4.part"));
}

// ffmpeg waits until it is told to read. Then frames come to a stop: some wait, and a socket holds some.
TEST_F(FrameFiles, ASlowFilmHoldsTheFramesUp) {
  const fs::path go = ffmpeg_.folder() / "go";
  const FakeFfmpeg slow("while [ ! -e " + go.string() + " ]; do sleep 0.02; done; cat > \"$film\"");
  Frames frames(fresh(), {200, kBytes, 2});
  std::atomic<std::size_t> added = 0;
  std::jthread adder([&] {
    for (; added < 200; ++added) frames.add(frame(added), "");
  });
  std::this_thread::sleep_for(1s);
  EXPECT_GE(added, 4U);
  EXPECT_LE(added, 20U);  // 32 KB a frame: a socket holds some
  fs::create_directory(go);
  adder.join();
  EXPECT_EQ(frames.finish().note, "");
  EXPECT_EQ(fs::file_size(folder_ / "film.mp4"), 200 * kBytes);
}

// Large pictures do not wait in numbers: no film reads them, and there is room for one.
TEST_F(FrameFiles, LargePicturesDoNotPileUp) {
  const fs::path go = ffmpeg_.folder() / "go";
  const FakeFfmpeg slow("while [ ! -e " + go.string() + " ]; do sleep 0.02; done; cat > \"$film\"");
  // The plan is told this size, but the test's own frames are small.
  const std::size_t large = std::size_t{80} << 20;
  Frames frames(fresh(), {20, large, 8});
  std::atomic<std::size_t> added = 0;
  std::jthread adder([&] {
    for (; added < 20; ++added) frames.add(Image(1000, 700), "");
  });
  std::this_thread::sleep_for(500ms);
  EXPECT_LE(added, 3U);
  fs::create_directory(go);
  adder.join();
  EXPECT_EQ(frames.finish().note, "");
}

}  // namespace
}  // namespace voxmelt
