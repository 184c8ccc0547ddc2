// The clocks here tell how long something takes.
#pragma once

#include <algorithm>
#include <chrono>

namespace voxmelt::measure {

enum class Clock { wall, thread, process };  // wall-clock time, or processor time of this thread or of all

inline double now(Clock clock) {
  if (clock == Clock::wall)
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  timespec at{};
  clock_gettime(clock == Clock::thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &at);
  return static_cast<double>(at.tv_sec) + 1e-9 * static_cast<double>(at.tv_nsec);
}

// Work on one thread is timed by its processor time: work of other programs meanwhile does not count.
inline Clock clock_of(int threads) { return threads == 1 ? Clock::thread : Clock::wall; }

template <class Task>
double seconds_for(Clock clock, const Task& task) {
  const double begin = now(clock);
  task();
  return now(clock) - begin;
}

// Keeps the least of many values.
class Least {
 public:
  void add(double value) {
    value_ = any_ ? std::min(value_, value) : value;
    any_ = true;
  }
  double value() const { return value_; }

 private:
  double value_ = 0;
  bool any_ = false;
};

}  // namespace voxmelt::measure
