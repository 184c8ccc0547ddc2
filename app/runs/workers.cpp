#include "app/runs/workers.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

namespace voxmelt::app {
namespace {

struct Become {
  char* const* argv;
  const char *folder, *log;
  pid_t parent;
};

// Runs in the child, between fork and exec: system calls alone are allowed here.
[[noreturn]] void become(const Become& what) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != what.parent) ::_exit(4);  // it has died meanwhile
  const int nowhere = ::open("/dev/null", O_RDWR);
  const int log = ::open(what.log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(log >= 0 ? log : nowhere, STDERR_FILENO);
  for (const int ours : {SIGPIPE, SIGXFSZ}) std::signal(ours, SIG_DFL);
  if (::chdir(what.folder) == 0) ::execv(what.argv[0], what.argv);
  constexpr char kWords[] = "error: the program cannot be started\n";
  (void)!::write(STDERR_FILENO, kWords, sizeof kWords - 1);
  ::_exit(127);
}

}  // namespace

Worker::Worker(const std::filesystem::path& program, const std::vector<std::string>& words,
               const std::filesystem::path& folder, const std::filesystem::path& log, std::size_t job)
    : job_(job) {
  const std::string name = program.string();
  std::vector<char*> argv{const_cast<char*>(name.c_str())};
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const Become what{argv.data(), folder.c_str(), log.c_str(), ::getpid()};
  id_ = ::fork();
  if (id_ == 0) become(what);
  if (id_ < 0) throw std::system_error(errno, std::generic_category());
}

bool Worker::has_ended(int& code) {
  int status = 0;
  const pid_t ended = ::waitpid(id_, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
  code = ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return true;
}

void Worker::terminate() const { ::kill(id_, SIGTERM); }

}  // namespace voxmelt::app
