#include "render/density/levels.h"

#include <algorithm>
#include <cstddef>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::render {
namespace {

constexpr std::int32_t kMostShift = rule::kOne / 4;
constexpr int kFractionBits = 4;  // fraction bits of heights between passes

// Stands for a column without a puddle. It is farther below any other level than a cliff, and yet no
// difference overflows.
constexpr std::int32_t kAbyss = -(1 << 29);

// Holds the levels of a box with a border of columns without puddle. It knows the span of the puddles in each
// row.
class Sheet {
 public:
  Sheet(const PuddleLevels& levels, const ColumnBox& box)
      : box_(box), stride_(static_cast<std::size_t>(box.high_x - box.low_x) + 2) {
    now_.assign(stride_ * (static_cast<std::size_t>(box.high_z - box.low_z) + 2), kAbyss);
    for (int z = box.low_z; z < box.high_z; ++z) {
      int first = box.high_x, end = box.low_x;
      const std::int32_t* row = levels.level.data() + static_cast<std::size_t>(z) * levels.x;
      for (int x = box.low_x; x < box.high_x; ++x) {
        if (row[x] == kNoLevel) continue;
        now_[at(x, z)] = row[x] << kFractionBits;
        first = std::min(first, x);
        end = x + 1;
      }
      if (first < end) puddles_.push_back({z, first, end});
    }
    next_ = now_;
  }

  // Applies the 3x3 binomial filter, as far as neighbours count. An abyss stays one, because nothing near it
  // counts.
  void smooth(const Loops& with) {
    for (const Span& span : puddles_)
      with.smooth_levels({now_.data() + at(span.first, span.z - 1), now_.data() + at(span.first, span.z),
                          now_.data() + at(span.first, span.z + 1)},
                         span.end - span.first, next_.data() + at(span.first, span.z));
    now_.swap(next_);
  }

  std::int32_t level(int x, int z) const { return now_[at(x, z)] >> kFractionBits; }

 private:
  struct Span {
    int z, first, end;
  };
  std::size_t at(int x, int z) const { return (z - box_.low_z + 1) * stride_ + (x - box_.low_x + 1); }

  ColumnBox box_;
  std::size_t stride_;
  std::vector<std::int32_t> now_, next_;
  std::vector<Span> puddles_;
};

}  // namespace

void ColumnBox::add(int x, int z) {
  low_x = std::min(low_x, x);
  high_x = std::max(high_x, x + 1);
  low_z = std::min(low_z, z);
  high_z = std::max(high_z, z + 1);
}

ColumnBox ColumnBox::widened(int columns, int x, int z) const {
  return {std::max(low_x - columns, 0), std::max(low_z - columns, 0), std::min(high_x + columns, x),
          std::min(high_z + columns, z)};
}

// Values beyond the wider box are wrong there. The error moves in by one column with each pass.
void find_shifts(const PuddleLevels& levels, int passes, const ColumnBox& box,
                 std::vector<std::int32_t>& shifts, const Loops& with) {
  if (box.empty()) return;
  Sheet sheet(levels, box.widened(passes, levels.x, levels.z));
  for (int pass = 0; pass < passes; ++pass) sheet.smooth(with);
  for (int z = box.low_z; z < box.high_z; ++z)
    for (int x = box.low_x; x < box.high_x; ++x) {
      const auto i = static_cast<std::size_t>(z) * levels.x + x;
      const std::int32_t most = std::min(kMostShift, levels.depth[i] >> 1);
      shifts[i] =
          levels.level[i] == kNoLevel ? 0 : std::clamp(sheet.level(x, z) - levels.level[i], -most, most);
    }
}

std::vector<std::int32_t> level_shifts(const PuddleLevels& levels, int passes) {
  std::vector<std::int32_t> shifts(levels.level.size(), 0);
  find_shifts(levels, passes, {0, 0, levels.x, levels.z}, shifts);
  return shifts;
}

}  // namespace voxmelt::render
