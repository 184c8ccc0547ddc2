// Runs are made by child processes, as many at a time as there are workers.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace voxmelt::app {

// Is a child process at work. It gets SIGTERM when this process dies, and keeps what it made.
class Worker {
 public:
  // Starts a program in a folder. Its errors go to `log`, all else nowhere. Throws std::system_error.
  Worker(const std::filesystem::path& program, const std::vector<std::string>& words,
         const std::filesystem::path& folder, const std::filesystem::path& log, std::size_t job);

  std::size_t job() const { return job_; }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  }
  // Tells if it has ended, and how: its exit code, or 128 if a signal ended it.
  bool has_ended(int& code);
  void terminate() const;

 private:
  pid_t id_ = 0;
  std::size_t job_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

}  // namespace voxmelt::app
