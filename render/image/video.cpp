#include "render/image/video.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

namespace voxmelt::render {
namespace {

constexpr int kBetweenLooks = 20;  // milliseconds

constexpr std::array kH264{"-c:v", "libx264", "-crf", "18"}, kMpeg4{"-c:v", "mpeg4", "-q:v", "3"};

std::vector<std::string> raw_video(int width, int height) {
  return {"ffmpeg",      "-y",
          "-loglevel",   "error",
          "-f",          "rawvideo",
          "-pix_fmt",    "rgb24",
          "-video_size", std::to_string(width) + "x" + std::to_string(height)};
}

// Tells whether ffmpeg encodes a black picture.
bool encodes(const std::string& codec, const Patience& patience) {
  std::vector<std::string> arguments = raw_video(64, 64);
  for (const char* argument : {"-i", "/dev/zero", "-frames:v", "1", "-pix_fmt", "yuv420p", "-c:v"})
    arguments.emplace_back(argument);
  for (const std::string& argument : {codec, std::string("-f"), std::string("null"), std::string("-")})
    arguments.push_back(argument);
  Child child;
  std::string why;
  return child.start(arguments, -1) == 0 && child.wait(patience, why) == 0;
}

}  // namespace

VideoWriter::VideoWriter(std::filesystem::path file, int frames_per_second, Patience patience)
    : file_(std::move(file)),
      beside_(file_.string() + ".part"),
      frames_per_second_(frames_per_second),
      patience_(std::move(patience)) {}

VideoWriter::~VideoWriter() {
  close();
  if (!ffmpeg_.is_there()) return;
  ffmpeg_.end();
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
}

void VideoWriter::start(int width, int height) {
  begun_ = true;
  std::vector<std::string> arguments = raw_video(width, height);
  for (const std::string& argument :
       {std::string("-framerate"), std::to_string(frames_per_second_), std::string("-i"),
        std::string("pipe:0"), std::string("-vf"), std::string("crop=trunc(iw/2)*2:trunc(ih/2)*2"),
        std::string("-pix_fmt"), std::string("yuv420p")})
    arguments.push_back(argument);
  for (const char* argument : encodes("libx264", patience_) ? kH264 : kMpeg4)
    arguments.emplace_back(argument);
  for (const char* argument : {"-movflags", "+faststart", "-f", "mp4"}) arguments.emplace_back(argument);
  arguments.push_back(beside_.string());

  // This is a socket and not a pipe. So a write to an ffmpeg that is gone is an error, and no signal.
  int ends[2];
  int error = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0 ? 0 : errno;
  if (error == 0) {
    error = ffmpeg_.start(arguments, ends[1]);
    ::close(ends[1]);
    to_ffmpeg_ = ends[0];
  }
  if (error == 0) return;
  close();
  problem_ = std::string("ffmpeg cannot be started: ") + std::strerror(error) +
             (error == ENOENT ? " (Debian's package `ffmpeg` has it)" : "");
}

void VideoWriter::add(const Image& frame) {
  if (!begun_) start(frame.width, frame.height);
  const auto* bytes = reinterpret_cast<const char*>(frame.pixels.data());
  std::size_t left = frame.pixels.size() * sizeof(Rgb);
  if (to_ffmpeg_ >= 0) ffmpeg_.begin_wait(patience_, beside_);
  while (left > 0 && to_ffmpeg_ >= 0) {
    const ssize_t sent = send(to_ffmpeg_, bytes, left, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      bytes += sent;
      left -= sent;
      ffmpeg_.begin_wait(patience_, beside_);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      wait_for_room();
    } else if (errno != EINTR) {  // it is gone: its exit status says why, if it is not 0
      problem_ = std::string("ffmpeg takes no more frames: ") + std::strerror(errno);
      close();
    }
  }
}

// Waits a moment, until ffmpeg takes more, or until it has had its time.
void VideoWriter::wait_for_room() {
  pollfd room{to_ffmpeg_, POLLOUT, 0};
  if (::poll(&room, 1, kBetweenLooks) > 0) return;
  const std::string why = ffmpeg_.lost_patience(patience_);
  if (why.empty()) return;
  problem_ = "ffmpeg " + why;
  close();
  ffmpeg_.end();
}

void VideoWriter::close() {
  if (to_ffmpeg_ >= 0) ::close(to_ffmpeg_);
  to_ffmpeg_ = -1;
}

std::optional<std::string> VideoWriter::finish() {
  close();
  const std::string no_film = file_.string() + ": no film: ";
  std::error_code error, ignored;
  if (!ffmpeg_.is_there()) {
    std::filesystem::remove(beside_, ignored);
    return no_film + (problem_.empty() ? "there are no frames" : problem_);
  }
  std::string why;
  const std::optional<int> status = ffmpeg_.wait(patience_, why, beside_);
  const bool complete = status == 0 && problem_.empty();
  if (complete) std::filesystem::rename(beside_, file_, error);
  if (complete && !error) return std::nullopt;
  std::filesystem::remove(beside_, ignored);
  if (error) return no_film + error.message();
  if (!status) return no_film + "ffmpeg " + why;
  return no_film + (*status == 0 ? problem_ : "ffmpeg failed with exit status " + std::to_string(*status));
}

bool ffmpeg_found() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((std::filesystem::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace voxmelt::render
