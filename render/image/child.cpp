#include "render/image/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

namespace voxmelt::render {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{5};

// Runs in the child, between fork and exec: system calls alone are allowed here.
[[noreturn]] void become(char* const* arguments, int input, int report, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // it has died meanwhile
  const int nowhere = ::open("/dev/null", O_RDWR);
  if (input >= 0 || nowhere >= 0) ::dup2(input >= 0 ? input : nowhere, STDIN_FILENO);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    if (nowhere >= 0) ::dup2(nowhere, stream);
  for (const int ignored : {SIGPIPE, SIGXFSZ}) ::signal(ignored, SIG_DFL);  // our business alone
  ::execvp(arguments[0], arguments);
  const int why = errno;
  (void)!::write(report, &why, sizeof why);
  ::_exit(127);
}

}  // namespace

int Child::start(const std::vector<std::string>& arguments, int input) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  int report[2];  // it closes when the program begins, and has an error number if it does not
  if (::pipe2(report, O_CLOEXEC) != 0) return errno;
  const pid_t parent = ::getpid();
  id_ = ::fork();
  if (id_ == 0) become(argv.data(), input, report[1], parent);
  const int forked = id_ < 0 ? errno : 0;
  ::close(report[1]);
  int why = forked;
  while (forked == 0 && ::read(report[0], &why, sizeof why) < 0 && errno == EINTR) {
  }
  ::close(report[0]);
  if (forked == 0 && why != 0) end();
  if (why != 0) id_ = 0;
  return why;
}

long long Child::work_done() const {
  long long work = 0;
  clockid_t its_time;
  timespec spent{};
  if (::clock_getcpuclockid(id_, &its_time) == 0 && ::clock_gettime(its_time, &spent) == 0)
    work = spent.tv_sec * 1'000'000'000LL + spent.tv_nsec;
  std::error_code error;
  const auto bytes = output_.empty() ? 0 : std::filesystem::file_size(output_, error);
  return error ? work : work + static_cast<long long>(bytes);
}

void Child::begin_wait(const Patience& patience, const std::filesystem::path& output) {
  output_ = output;
  begun_ = worked_ = Clock::now();
  work_ = work_done();
  if (!stop_seen_) stop_seen_ = patience.stop && patience.stop();
  stopped_ = begun_;
}

std::string Child::lost_patience(const Patience& patience) {
  const Clock::time_point now = Clock::now();
  if (const long long work = work_done(); work != work_) {
    work_ = work;
    worked_ = now;
  }
  if (!stop_seen_ && patience.stop && patience.stop()) {
    stop_seen_ = true;
    stopped_ = now;
  }
  if (now - worked_ >= patience.idle) return "does nothing any more";
  if (now - begun_ >= patience.in_all) return "does not end";
  if (stop_seen_ && now - stopped_ >= patience.after_stop) return "did not end in time";
  return "";
}

std::optional<int> Child::wait(const Patience& patience, std::string& why,
                               const std::filesystem::path& output) {
  begin_wait(patience, output);
  for (;;) {
    int status = 0;
    const pid_t ended = ::waitpid(id_, &status, WNOHANG);
    if (ended == id_ || (ended < 0 && errno != EINTR)) {
      id_ = 0;
      return ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    }
    why = lost_patience(patience);
    if (!why.empty()) {
      end();
      return std::nullopt;
    }
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

void Child::end() {
  if (id_ == 0) return;
  ::kill(-id_, SIGKILL);
  ::kill(id_, SIGKILL);  // if it has no group yet
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
  id_ = 0;
}

}  // namespace voxmelt::render
