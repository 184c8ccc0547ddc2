#include "kernel/engine/cpu/workers.h"

#include <algorithm>
#include <atomic>
#include <exception>

#if defined(VOXMELT_PLAIN_THREADS)
#include <limits>
#include <thread>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#endif

namespace voxmelt::cpu {

#if defined(VOXMELT_PLAIN_THREADS)

// The thread sanitizer does not understand TBB's own synchronisation. So it gets plain threads for each call.
struct Workers::Arena {
  template <class Work>
  void run(int threads, const Work& work) {
    std::vector<std::thread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
  }
};

Workers::Workers(int threads) : threads_(threads), arena_(std::make_unique<Arena>()) {}

int Workers::most() { return std::numeric_limits<int>::max(); }

#else

struct Workers::Arena {
  // TBB writes two lines to the terminal if somebody asks for more than it has.
  explicit Arena(int threads) : arena(std::min(threads, Workers::most())) {}
  template <class Work>
  void run(int threads, const Work& work) {
    arena.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<int>(0, threads, 1), [&](const tbb::blocked_range<int>&) { work(); },
          tbb::simple_partitioner());
    });
  }
  tbb::task_arena arena;
};

Workers::Workers(int threads)
    : threads_(threads), arena_(threads > 1 ? std::make_unique<Arena>(threads) : nullptr) {}

int Workers::most() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

#endif

Workers::~Workers() = default;

void Workers::spread(int count, Call call, const void* context) {
  // The last task runs first. So a task that relies on what an earlier one left fails on any machine.
  std::atomic<int> left{count};
  std::atomic_flag failed;
  std::exception_ptr thrown;
  arena_->run(std::min(threads_, count), [&] {
    try {
      for (int i = --left; i >= 0; i = --left) call(context, i);
    } catch (...) {
      if (!failed.test_and_set()) thrown = std::current_exception();
      left = 0;
    }
  });
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace voxmelt::cpu
