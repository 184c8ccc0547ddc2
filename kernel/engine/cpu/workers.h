// Runs independent tasks on a fixed number of threads. No result may depend on which thread runs which task.
#pragma once

#include <memory>

#include "kernel/engine/cpu/turns.h"

namespace voxmelt::cpu {

class Workers {
 public:
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  // Returns the machine's number of threads. No more run at a time, however many are asked for.
  static int most();

  // Runs task(0) .. task(count - 1) in any order (the last one begins first), and returns when all are done.
  // An exception of a task (memory may run out) is thrown from here. Tasks that have not begun are then
  // skipped.
  template <class Task>
  void run(int count, const Task& task) {
    if (threads_ == 1 || count <= 1) {
      for (int i = 0; i < count; ++i) task(i);
      return;
    }
    spread(
        count, [](const void* context, int i) { (*static_cast<const Task*>(context))(i); }, &task);
  }

  // Does the same for tasks that are repeated. The longest begins first.
  template <class Task>
  void run(int count, Turns& turns, const Task& task) {
    if (threads_ == 1 || count <= 1) return run(count, task);
    turns.sort(count);
    run(count, [&](int turn) { turns.time(turns.at(turn), task); });
  }

 private:
  using Call = void (*)(const void* context, int i);
  void spread(int count, Call call, const void* context);

  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace voxmelt::cpu
