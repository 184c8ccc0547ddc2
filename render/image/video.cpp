#include "render/image/video.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
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

constexpr std::array kH264{"-c:v", "libx264", "-crf", "18"}, kMpeg4{"-c:v", "mpeg4", "-q:v", "3"};

// Starts a program found on PATH, with `input` for its standard input, and discards its output. Returns 0, or
// an error number. The program has a process group of its own, because an interrupt of ours is not one of the
// film.
int start_quietly(const std::vector<std::string>& arguments, int input, pid_t& child) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (input >= 0)
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  else
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t ours;  // signals that we ignore get their default in the child
  sigemptyset(&ours);
  sigaddset(&ours, SIGPIPE);
  sigaddset(&ours, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &ours);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int error = posix_spawnp(&child, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

// Returns the exit status of a child, or 128 if a signal ended it.
int status_of(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::vector<std::string> raw_video(int width, int height) {
  return {"ffmpeg",      "-y",
          "-loglevel",   "error",
          "-f",          "rawvideo",
          "-pix_fmt",    "rgb24",
          "-video_size", std::to_string(width) + "x" + std::to_string(height)};
}

// Tells whether ffmpeg encodes a black picture.
bool encodes(const std::string& codec) {
  std::vector<std::string> arguments = raw_video(64, 64);
  for (const char* argument : {"-i", "/dev/zero", "-frames:v", "1", "-pix_fmt", "yuv420p", "-c:v"})
    arguments.emplace_back(argument);
  for (const std::string& argument : {codec, std::string("-f"), std::string("null"), std::string("-")})
    arguments.push_back(argument);
  pid_t child = 0;
  return start_quietly(arguments, -1, child) == 0 && status_of(child) == 0;
}

}  // namespace

VideoWriter::VideoWriter(std::filesystem::path file, int frames_per_second)
    : file_(std::move(file)), beside_(file_.string() + ".part"), frames_per_second_(frames_per_second) {}

VideoWriter::~VideoWriter() {
  close();
  if (ffmpeg_ == 0) return;
  kill(ffmpeg_, SIGKILL);
  status_of(ffmpeg_);
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
  for (const char* argument : encodes("libx264") ? kH264 : kMpeg4) arguments.emplace_back(argument);
  for (const char* argument : {"-movflags", "+faststart", "-f", "mp4"}) arguments.emplace_back(argument);
  arguments.push_back(beside_.string());

  // This is a socket and not a pipe. So a write to an ffmpeg that is gone is an error, and no signal.
  int ends[2];
  int error = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0 ? 0 : errno;
  if (error == 0) {
    error = start_quietly(arguments, ends[1], ffmpeg_);
    ::close(ends[1]);
    to_ffmpeg_ = ends[0];
  }
  if (error == 0) return;
  ffmpeg_ = 0;
  close();
  problem_ = std::string("ffmpeg cannot be started: ") + std::strerror(error) +
             (error == ENOENT ? " (Debian's package `ffmpeg` has it)" : "");
}

void VideoWriter::add(const Image& frame) {
  if (!begun_) start(frame.width, frame.height);
  const auto* bytes = reinterpret_cast<const char*>(frame.pixels.data());
  std::size_t left = frame.pixels.size() * sizeof(Rgb);
  while (left > 0 && to_ffmpeg_ >= 0) {
    const ssize_t sent = send(to_ffmpeg_, bytes, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {  // ffmpeg is gone; its exit status says why, if it is not 0
      problem_ = std::string("ffmpeg takes no more frames: ") + std::strerror(errno);
      return close();
    }
    bytes += sent;
    left -= sent;
  }
}

void VideoWriter::close() {
  if (to_ffmpeg_ >= 0) ::close(to_ffmpeg_);
  to_ffmpeg_ = -1;
}

std::optional<std::string> VideoWriter::finish() {
  close();
  const std::string no_film = file_.string() + ": no film: ";
  if (ffmpeg_ == 0) return no_film + (problem_.empty() ? "there are no frames" : problem_);
  const int status = status_of(std::exchange(ffmpeg_, 0));
  std::error_code error;
  const bool complete = status == 0 && problem_.empty();
  if (complete) std::filesystem::rename(beside_, file_, error);
  if (complete && !error) return std::nullopt;
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
  if (error) return no_film + error.message();
  return no_film + (status == 0 ? problem_ : "ffmpeg failed with exit status " + std::to_string(status));
}

bool ffmpeg_found() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((std::filesystem::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace voxmelt::render
