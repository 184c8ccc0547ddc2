#include "kernel/run/io/unfinished.h"

#include <utility>

namespace voxmelt::io {
namespace {

struct Everything {
  std::mutex mutex;
  std::list<std::function<void()>> unfinished;
  bool completed = false;
};

// Returns an object that is never destroyed, because the other thread may come while main() returns.
Everything& everything() {
  static Everything& all = *new Everything;
  return all;
}

}  // namespace

std::unique_lock<std::mutex> changing_places() { return std::unique_lock(everything().mutex); }

Unfinished::~Unfinished() {
  if (!entry_) return;
  const auto held = changing_places();
  everything().unfinished.erase(*entry_);
}

void Unfinished::begin(std::function<void()> discard) {
  auto& all = everything().unfinished;
  entry_ = all.insert(all.end(), std::move(discard));
}

void Unfinished::complete() {
  if (!entry_) return;
  everything().unfinished.erase(*entry_);
  entry_.reset();
  everything().completed = true;
}

bool discard_unfinished() {
  (void)changing_places().release();  // held until the process ends
  for (const auto& discard : everything().unfinished) discard();
  return everything().completed;
}

}  // namespace voxmelt::io
