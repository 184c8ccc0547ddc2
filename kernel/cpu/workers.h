// Runs independent tasks on a fixed number of threads. Nothing that they compute may depend on who runs what.
#pragma once

#include <memory>

namespace voxmelt::cpu {

class Workers {
 public:
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  // task(0) .. task(count - 1), in any order; returns when all are done. Tasks may not throw.
  template <class Task>
  void run(int count, const Task& task) {
    if (threads_ == 1 || count <= 1) {
      for (int i = 0; i < count; ++i) task(i);
      return;
    }
    spread(
        count, [](const void* context, int i) { (*static_cast<const Task*>(context))(i); }, &task);
  }

 private:
  using Call = void (*)(const void* context, int i);
  void spread(int count, Call call, const void* context);

  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace voxmelt::cpu
