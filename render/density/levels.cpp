#include "render/density/levels.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::render {
namespace {

using rule::kOne;

constexpr std::int32_t kMostShift = kOne / 4;
constexpr std::int32_t kFraction = 16;  // heights are kept to this part of a unit between passes

// Stands for a column without a puddle. It is farther below any other level than a cliff, and yet no
// difference overflows.
constexpr std::int32_t kAbyss = -(1 << 29);

// Share of a difference between neighbours that is smoothed: all up to one cell, nothing from two.
std::int32_t share(std::int32_t difference) {
  return std::clamp(2 * kOne - std::abs(difference) / kFraction, 0, kOne);
}

// Second difference across a column, 0 where one of the two neighbours holds no puddle. In 32 bits: where a
// share is not 0 both differences are below 2^17.
std::int32_t bend(std::int32_t before, std::int32_t here, std::int32_t after) {
  const std::int32_t down = before - here, up = after - here;
  return (down + up) * std::min(share(down), share(up)) / kOne;
}

// The levels with a border of columns without puddle, and where in each row the puddles are.
class Sheet {
 public:
  explicit Sheet(const Levels& levels)
      : columns_(levels.x), rows_(levels.z), stride_(static_cast<std::size_t>(levels.x) + 2) {
    now_.assign(stride_ * (static_cast<std::size_t>(rows_) + 2), kAbyss);
    for (int z = 0; z < rows_; ++z) {
      int first = columns_, end = 0;
      for (int x = 0; x < columns_; ++x) {
        const std::int32_t level =
            levels.level[static_cast<std::size_t>(z) * static_cast<std::size_t>(columns_) +
                         static_cast<std::size_t>(x)];
        if (level == kNoLevel) continue;
        now_[at(x, z)] = level * kFraction;
        first = std::min(first, x);
        end = x + 1;
      }
      if (first < end) puddles_.push_back({z, first, end});
    }
    next_ = now_;
  }

  // The 3x3 binomial filter where all neighbours count.
  void smooth() {
    for (const Span& span : puddles_) {
      const std::int32_t* low = now_.data() + at(0, span.z - 1);
      const std::int32_t* mid = now_.data() + at(0, span.z);
      const std::int32_t* high = now_.data() + at(0, span.z + 1);
      std::int32_t* to = next_.data() + at(0, span.z);
      for (int x = span.first; x < span.end; ++x) {
        const std::int32_t here = mid[x];
        const std::int32_t straight = bend(mid[x - 1], here, mid[x + 1]) + bend(low[x], here, high[x]);
        const std::int32_t diagonal =
            bend(low[x - 1], here, high[x + 1]) + bend(high[x - 1], here, low[x + 1]);
        to[x] = here == kAbyss ? kAbyss : here + (2 * straight + diagonal) / 16;
      }
    }
    now_.swap(next_);
  }

  std::int32_t level(int x, int z) const { return now_[at(x, z)] / kFraction; }

 private:
  struct Span {
    int z, first, end;
  };
  std::size_t at(int x, int z) const {
    return static_cast<std::size_t>(z + 1) * stride_ + static_cast<std::size_t>(x + 1);
  }

  int columns_, rows_;
  std::size_t stride_;
  std::vector<std::int32_t> now_, next_;
  std::vector<Span> puddles_;
};

}  // namespace

std::vector<std::int32_t> level_shifts(const Levels& levels, int passes) {
  Sheet sheet(levels);
  for (int pass = 0; pass < passes; ++pass) sheet.smooth();
  std::vector<std::int32_t> shifts(levels.level.size(), 0);
  for (int z = 0; z < levels.z; ++z)
    for (int x = 0; x < levels.x; ++x) {
      const auto i =
          static_cast<std::size_t>(z) * static_cast<std::size_t>(levels.x) + static_cast<std::size_t>(x);
      if (levels.level[i] == kNoLevel) continue;
      const std::int32_t most = std::min(kMostShift, levels.depth[i] / 2);
      shifts[i] = std::clamp(sheet.level(x, z) - levels.level[i], -most, most);
    }
  return shifts;
}

}  // namespace voxmelt::render
