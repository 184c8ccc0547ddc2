#include "render/image/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>
#include <vector>

namespace voxmelt::render {
namespace {

// Runs a program found on PATH and discards its output. Returns its exit status, or -errno when it could not
// be started.
int run_quietly(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int started = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (started != 0) return -started;

  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -errno;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace

std::optional<std::string> write_video(const std::filesystem::path& file, const std::string& frame_pattern,
                                       int first, int frames_per_second) {
  std::filesystem::path beside = file;
  beside += ".part";
  int status = 0;
  for (const std::vector<std::string>& codec :
       {std::vector<std::string>{"libx264", "-crf", "18"}, std::vector<std::string>{"mpeg4", "-q:v", "3"}}) {
    // H.264 in yuv420p needs even sides, so odd ones lose a pixel.
    std::vector<std::string> arguments{"ffmpeg",
                                       "-y",
                                       "-loglevel",
                                       "error",
                                       "-framerate",
                                       std::to_string(frames_per_second),
                                       "-start_number",
                                       std::to_string(first),
                                       "-i",
                                       frame_pattern,
                                       "-vf",
                                       "crop=trunc(iw/2)*2:trunc(ih/2)*2",
                                       "-pix_fmt",
                                       "yuv420p",
                                       "-c:v"};
    arguments.insert(arguments.end(), codec.begin(), codec.end());
    arguments.insert(arguments.end(), {"-movflags", "+faststart", "-f", "mp4", beside.string()});
    status = run_quietly(arguments);
    if (status <= 0) break;
  }

  std::error_code error;
  if (status == 0) std::filesystem::rename(beside, file, error);
  if (status == 0 && !error) return std::nullopt;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  if (status < 0) return file.string() + ": no film: ffmpeg cannot be started: " + std::strerror(-status);
  if (error) return file.string() + ": no film: " + error.message();
  return file.string() + ": no film: ffmpeg failed with exit status " + std::to_string(status);
}

bool ffmpeg_found() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((std::filesystem::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace voxmelt::render
