#include "kernel/cpu/workers.h"

#if defined(VOXMELT_PLAIN_THREADS)
#include <atomic>
#include <thread>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#endif

namespace voxmelt::cpu {

#if defined(VOXMELT_PLAIN_THREADS)

// For the thread sanitizer, which does not understand TBB's own synchronisation: plain threads for each call.
struct Workers::Arena {};

Workers::Workers(int threads) : threads_(threads) {}
Workers::~Workers() = default;

void Workers::spread(int count, Call call, const void* context) {
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) call(context, i);
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads_; ++t) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

#else

struct Workers::Arena {
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

Workers::Workers(int threads)
    : threads_(threads), arena_(threads > 1 ? std::make_unique<Arena>(threads) : nullptr) {}
Workers::~Workers() = default;

void Workers::spread(int count, Call call, const void* context) {
  arena_->arena.execute([&] {
    // The last first: who relies on what an earlier task left is seen on any machine.
    tbb::parallel_for(
        tbb::blocked_range<int>(0, count, 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int i = range.begin(); i < range.end(); ++i) call(context, count - 1 - i);
        },
        tbb::simple_partitioner());
  });
}

#endif

}  // namespace voxmelt::cpu
