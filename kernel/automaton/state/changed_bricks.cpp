#include "kernel/automaton/state/changed_bricks.h"

#include <atomic>
#include <bit>
#include <utility>

namespace voxmelt::state {
namespace {

constexpr int kWordBricks = 64 / kBrickSide;

std::uint64_t next_volume() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

void ChangedBricks::follow(const Grid& cells) {
  volume_ = next_volume();
  version_ = 1;
  open_ = false;
  bricks_ = brick_grid(cells);
  for (auto& of_part : newest_) of_part.assign(bricks_.cells(), version_);
}

void ChangedBricks::forget() {
  volume_ = 0;
  open_ = false;
  newest_ = {};
}

void ChangedBricks::mark(Part part, std::uint64_t words, int y, int z) {
  newer(part, words, y, z);
  if (part == kMatter) newer(kWalls, words, y, z);
}

void ChangedBricks::newer(Part part, std::uint64_t words, int y, int z) {
  if (volume_ == 0) return;
  std::uint64_t* const row = newest_[part].data() + bricks_.index(0, y, z);
  for (; words != 0; words &= words - 1) {
    const int first = std::countr_zero(words) * kWordBricks;
    if (first >= bricks_.x) return;
    std::fill(row + first, row + std::min(first + kWordBricks, bricks_.x), version_);
  }
}

void ChangedBricks::take(ChangedBricks& other) noexcept {
  volume_ = std::exchange(other.volume_, 0);
  version_ = other.version_;
  open_ = other.open_;
  bricks_ = other.bricks_;
  newest_ = std::move(other.newest_);
}

}  // namespace voxmelt::state
