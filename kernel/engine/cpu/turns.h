// Repeated tasks run in turns. The task that took longest the last time begins first, so that all threads end
// at about the same time. No task's result may depend on the order.
#pragma once

#include <chrono>
#include <vector>

namespace voxmelt::cpu {

class Turns {
 public:
  // Sorts the tasks 0 .. count - 1, the longest last. With a new count all tasks count as equally long.
  void sort(int count);
  int at(int turn) const { return order_[turn]; }

  // Runs one task, and remembers how long it took. Several threads may do so at once, each for another task.
  template <class Task>
  void time(int task, const Task& run) {
    const auto begin = std::chrono::steady_clock::now();
    run(task);
    took(task, std::chrono::steady_clock::now() - begin);
  }
  void took(int task, std::chrono::nanoseconds time) { times_[task] = time; }

 private:
  std::vector<std::chrono::nanoseconds> times_;
  std::vector<int> order_;
};

}  // namespace voxmelt::cpu
