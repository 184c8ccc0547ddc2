#include "kernel/vdb/helper.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace voxmelt::vdb {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "voxmelt-vdb";
constexpr std::size_t kLongestLine = 4096;

[[noreturn]] void fail_of_system(const std::string& what) {
  throw HelperError(std::string(kProgram) + ": " + what + ": " +
                    std::error_code(errno, std::generic_category()).message());
}

// Starts the program with one stream for its input and output. Returns its number, or 0 with errno. It has a
// process group of its own, because an interrupt of ours is not one of it. The memory of this process is not
// copied for it, however large it is.
pid_t spawn(const fs::path& program, char* const* arguments, int stream) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  sigset_t ours;  // signals that we treat in a way of our own
  ::sigemptyset(&ours);
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::sigaddset(&ours, signal);
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawnattr_init(&attributes);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO})
    ::posix_spawn_file_actions_adddup2(&actions, stream, standard);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setsigdefault(&attributes, &ours);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  pid_t id = 0;
  const int why = ::posix_spawn(&id, program.c_str(), &actions, &attributes, arguments, environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  errno = why;
  return why == 0 ? id : 0;
}

}  // namespace

std::string how_to_get_it() {
  std::error_code error;
  const fs::path build = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  std::string text = "OpenVDB is read and written by the program voxmelt-vdb, which is not here: ";
  text += "apt-get install libopenvdb-dev, then ";
  if (fs::exists(build / "CMakeCache.txt", error))
    return text + "cmake " + build.string() + " && cmake --build " + build.string() + " --target " + kProgram;
  return text + "configure, build and install voxmelt again";
}

fs::path helper_program() {
  std::error_code error;
  if (const char* const named = std::getenv("VOXMELT_VDB")) return named;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / kProgram;
  if (::access(beside.c_str(), X_OK) == 0) return beside;
  const char* const path = std::getenv("PATH");
  std::string_view left = path != nullptr ? path : "";
  while (!left.empty()) {
    const std::string_view folder = left.substr(0, left.find(':'));
    left.remove_prefix(std::min(folder.size() + 1, left.size()));
    const fs::path there = fs::path(folder) / kProgram;
    if (!folder.empty() && ::access(there.c_str(), X_OK) == 0) return there;
  }
  return {};
}

Helper::Helper(const std::vector<std::string>& arguments) {
  const fs::path program = helper_program();
  if (program.empty()) throw HelperError(how_to_get_it());
  std::vector<char*> argv{const_cast<char*>(kProgram)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  std::array<int, 2> streams{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, streams.data()) != 0) fail_of_system("no stream");
  stream_ = streams[0];
  id_ = spawn(program, argv.data(), streams[1]);
  const int why = errno;
  ::close(streams[1]);
  if (id_ != 0) return;
  ::close(stream_);
  errno = why;
  fail_of_system("cannot start " + program.string());
}

Helper::~Helper() {
  ::close(stream_);
  if (id_ == 0) return;
  ::kill(id_, SIGKILL);
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Helper::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(stream_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {
      answer();  // it says why
      throw HelperError(std::string(kProgram) + ": it takes no more");
    }
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

void Helper::end_of_input() { ::shutdown(stream_, SHUT_WR); }

std::size_t Helper::take(char* to, std::size_t bytes) {
  std::size_t taken = 0;
  while (taken < bytes) {
    const ssize_t count = ::recv(stream_, to + taken, bytes - taken, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    taken += static_cast<std::size_t>(count);
  }
  return taken;
}

std::string Helper::line() {
  std::string text;
  for (char c = 0; text.size() < kLongestLine; text += c) {
    if (take(&c, 1) == 0) fail_of_its_end();
    if (c == '\n') return text;
  }
  throw HelperError(std::string(kProgram) + ": its answer has no end");
}

std::string Helper::answer() {
  const std::string text = line();
  if (text.starts_with("ok")) return text.substr(2);
  const bool is_full = text.starts_with("full ");
  throw HelperError(is_full ? text.substr(5) : text.starts_with("error ") ? text.substr(6) : text, is_full);
}

void Helper::receive(char* to, std::size_t bytes) {
  if (take(to, bytes) < bytes) fail_of_its_end();
}

void Helper::finish() {
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  id_ = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (!WIFSIGNALED(status)) throw HelperError("OpenVDB ended with " + std::to_string(WEXITSTATUS(status)));
  const int signal = WTERMSIG(status);
  throw HelperError(signal == SIGXCPU ? std::string("OpenVDB takes too long for it")
                                      : "OpenVDB crashes on it (signal " + std::to_string(signal) + ")");
}

void Helper::fail_of_its_end() {
  finish();
  throw HelperError(std::string(kProgram) + ": it ended too early");
}

}  // namespace voxmelt::vdb
