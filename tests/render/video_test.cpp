// The tests look at the frames that ffmpeg gets, and at the message when it fails. Scripts stand for ffmpeg,
// and the real one is used if it is there.
#include "render/image/video.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <system_error>

#include "tests/render/fake_ffmpeg.h"

namespace voxmelt {
namespace {

namespace fs = std::filesystem;
using render::Image;
using render::VideoWriter;

class Video : public testing::Test {
 protected:
  Video() : folder_(fs::temp_directory_path() / ("voxmelt_video_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Video() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  Image frame(int width, int height) {
    Image image(width, height);
    for (render::Rgb& pixel : image.pixels) pixel = {static_cast<std::uint8_t>(random_()), 7, 9};
    return image;
  }
  // Makes a film of `count` frames of 300 x 200, much more than a pipe holds.
  std::optional<std::string> film(int count) {
    VideoWriter video(folder_ / "film.mp4", 10);
    for (int i = 0; i < count; ++i) {
      const Image image = frame(300, 200);
      sent_ += FakeFfmpeg::raw(image);
      video.add(image);
    }
    return video.finish();
  }
  bool nothing_is_left() const { return fs::is_empty(folder_); }

  fs::path folder_;
  std::string sent_;
  std::mt19937 random_{1};
};

TEST_F(Video, FramesArriveWholeAndInOrder) {
  const FakeFfmpeg ffmpeg("cat > \"$film\"");
  EXPECT_EQ(film(7), std::nullopt);
  EXPECT_TRUE(FakeFfmpeg::bytes_of(folder_ / "film.mp4") == sent_);
  const std::string arguments = ffmpeg.arguments();
  for (const char* part : {"-pix_fmt rgb24", "-video_size 300x200", "-framerate 10", "-c:v libx264"})
    EXPECT_NE(arguments.find(part), std::string::npos) << part << " in " << arguments;
  EXPECT_FALSE(fs::exists(folder_ / "film.mp4.part"));
}

TEST_F(Video, WithoutH264TheFilmIsMpeg4) {
  const FakeFfmpeg ffmpeg("cat > \"$film\"", "libx264");
  EXPECT_EQ(film(2), std::nullopt);
  EXPECT_NE(ffmpeg.arguments().find("-c:v mpeg4"), std::string::npos);
}

TEST_F(Video, ProblemsAreMessages) {
  const std::string place = (folder_ / "film.mp4").string();
  {
    const FakeFfmpeg missing("");
    EXPECT_EQ(film(3), place +
                           ": no film: ffmpeg cannot be started: No such file or directory (Debian's package "
                           "`ffmpeg` has it)");
    EXPECT_TRUE(nothing_is_left());
  }
  {
    const FakeFfmpeg failing("cat > \"$film\"; exit 3");
    EXPECT_EQ(film(3), place + ": no film: ffmpeg failed with exit status 3");
    EXPECT_TRUE(nothing_is_left());
  }
  {
    const FakeFfmpeg killed("head -c 200000 > \"$film\"; kill -9 $$");
    EXPECT_EQ(film(9), place + ": no film: ffmpeg failed with exit status 128");
    EXPECT_TRUE(nothing_is_left());
  }
  {
    const FakeFfmpeg sated("exec head -c 200000 > \"$film\"");  // it ends well, but has not taken all
    EXPECT_NE(film(9)->find("no film: ffmpeg takes no more frames"), std::string::npos);
    EXPECT_TRUE(nothing_is_left());
  }
  EXPECT_EQ(film(0), place + ": no film: there are no frames");
}

TEST_F(Video, AFilmThatIsNotFinishedIsNoFilm) {
  const FakeFfmpeg ffmpeg("exec cat > \"$film\"");
  {
    VideoWriter video(folder_ / "film.mp4", 10);
    for (int i = 0; i < 5; ++i) video.add(frame(300, 200));
    EXPECT_FALSE(nothing_is_left()) << "the test would prove nothing";
  }
  EXPECT_TRUE(nothing_is_left());

  const FakeFfmpeg stubborn("cat > \"$film\"; exec sleep 60");
  const auto begin = std::chrono::steady_clock::now();
  { VideoWriter(folder_ / "film.mp4", 10).add(frame(300, 200)); }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

// A child that sleeps uses no processor. It sleeps before it has read, and after it has read all.
TEST_F(Video, AnFfmpegThatHangsIsGivenUp) {
  const render::Patience little{.idle = std::chrono::milliseconds(300)};
  const std::string place = (folder_ / "film.mp4").string();
  for (const char* script :
       {"exec sleep 600", "cat > \"$film\"; exec sleep 600", "cat > \"$film\"; sleep 600"}) {
    const FakeFfmpeg hanging(script);
    const auto begin = std::chrono::steady_clock::now();
    VideoWriter video(folder_ / "film.mp4", 10, little);
    for (int i = 0; i < 9; ++i) video.add(frame(300, 200));
    EXPECT_EQ(video.finish(), place + ": no film: ffmpeg does nothing any more") << script;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
    EXPECT_TRUE(nothing_is_left());
  }
}

// It works for ever, and writes nothing.
TEST_F(Video, AnFfmpegThatNeverEndsIsGivenUp) {
  const render::Patience little{.in_all = std::chrono::milliseconds(500)};
  const FakeFfmpeg busy("cat > /dev/null; while :; do :; done");
  VideoWriter video(folder_ / "film.mp4", 10, little);
  video.add(frame(300, 200));
  EXPECT_EQ(video.finish(), (folder_ / "film.mp4").string() + ": no film: ffmpeg does not end");
}

TEST_F(Video, AStopIsHeededWhileFfmpegWorks) {
  bool stopped = false;
  render::Patience patience;
  patience.after_stop = std::chrono::milliseconds(200);
  patience.stop = [&] { return stopped; };
  const FakeFfmpeg busy("cat > /dev/null; while :; do :; done");
  VideoWriter video(folder_ / "film.mp4", 10, patience);
  video.add(frame(300, 200));
  stopped = true;
  EXPECT_EQ(video.finish(), (folder_ / "film.mp4").string() + ": no film: ffmpeg did not end in time");
}

// A slow one is no hanging one: each frame takes longer than one may do nothing.
TEST_F(Video, ASlowFfmpegHasItsTime) {
  const render::Patience little{.idle = std::chrono::milliseconds(400)};
  const FakeFfmpeg slow("i=0; while [ $i -lt 60000 ]; do i=$((i + 1)); done; cat > \"$film\"");
  VideoWriter video(folder_ / "film.mp4", 10, little);
  for (int i = 0; i < 9; ++i) video.add(frame(300, 200));
  EXPECT_EQ(video.finish(), std::nullopt);
}

TEST_F(Video, TheRealFfmpegTakesOddSizes) {
  if (!render::ffmpeg_found()) GTEST_SKIP() << "no ffmpeg";
  VideoWriter video(folder_ / "film.mp4", 10);
  for (int i = 0; i < 4; ++i) video.add(frame(33, 31));
  EXPECT_EQ(video.finish(), std::nullopt);
  EXPECT_EQ(FakeFfmpeg::bytes_of(folder_ / "film.mp4").substr(4, 4), "ftyp");
}

}  // namespace
}  // namespace voxmelt
