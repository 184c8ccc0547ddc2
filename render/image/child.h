// Another program runs beside this one. It cannot keep this one waiting for long, and it dies with it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace voxmelt::render {

// Says how long one waits for a child.
struct Patience {
  std::chrono::milliseconds idle{10'000};      // while it does nothing: no processor time, no output
  std::chrono::milliseconds in_all{600'000};   // for one thing, however busy it is
  std::chrono::milliseconds after_stop{2000};  // once `stop` says yes
  std::function<bool()> stop{};                // may be empty
};

class Child {
 public:
  Child() = default;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { end(); }

  // Starts a program found on PATH, with `input` for its standard input (-1: none). Its output is discarded.
  // It has a process group of its own, because an interrupt of ours is not one of the child. It is killed
  // when the calling thread ends. Returns 0, or errno.
  int start(const std::vector<std::string>& arguments, int input);
  bool is_there() const { return id_ != 0; }

  // Begins a wait for one thing. Growth of `output` shows that the child works.
  void begin_wait(const Patience& patience, const std::filesystem::path& output = {});
  // Tells, while one waits, why one should wait no more. The text is empty if one should go on.
  std::string lost_patience(const Patience& patience);

  // Waits for its end. Returns its exit status, or 128 if a signal ended it. Returns nothing if it was killed
  // because patience was lost; `why` says so then.
  std::optional<int> wait(const Patience& patience, std::string& why,
                          const std::filesystem::path& output = {});

  // Kills it and its own children, if it is there.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  long long work_done() const;

  pid_t id_ = 0;
  std::filesystem::path output_;
  long long work_ = 0;
  Clock::time_point begun_, worked_, stopped_;
  bool stop_seen_ = false;
};

}  // namespace voxmelt::render
