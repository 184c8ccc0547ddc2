// A beam holds all rays of a cell to a source. It tells if one of them may cross a box of cells: never "no"
// where one does. So only beams near what has appeared are cast anew.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/rule/ray_geometry.h"
#include "kernel/automaton/rule/source_kinds.h"
#include "kernel/engine/visibility/opaque.h"

namespace voxmelt::visibility {

class Beam {
 public:
  Beam(rule::SourceKind kind, const rule::SourceKey& source, const Opaque::Box& box)
      : kind_(kind), at_(rule::triple(source.at)), way_(rule::triple(source.direction)) {
    // A ray starts within half a cell of the cell's middle, and ends this far from `at` at most. So in
    // between it is no farther from the line of both than the greater of the two.
    std::int64_t width = rule::kPositionUnit / 2;
    if (kind == rule::SourceKind::sphere) width = std::max(width, rule::SphereSource::reach(source));
    for (std::size_t a = 0; a < 3; ++a) {
      low_[a] = rule::kPositionUnit * box.low[a] - width;
      high_[a] = rule::kPositionUnit * (box.high[a] + 1) + width;
    }
  }

  bool may_cross(const Cell& cell) const {
    if (kind_ == rule::SourceKind::sky) return rule::kPositionUnit * cell[1] <= high_[1];  // its rays go up
    const bool ends = kind_ != rule::SourceKind::directional;
    double first = 0, last = ends ? 1 : kFar;  // the part of the line that may lie in the box
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t from = rule::kPositionUnit * cell[a] + rule::kPositionUnit / 2;
      const std::int64_t way = ends ? at_[a] - from : way_[a];
      if (way == 0) {
        if (from < low_[a] || from > high_[a]) return false;
        continue;
      }
      const double by = 1.0 / static_cast<double>(way);
      const double one = static_cast<double>(low_[a] - from) * by,
                   other = static_cast<double>(high_[a] - from) * by;
      first = std::max(first, std::min(one, other));
      last = std::min(last, std::max(one, other));
    }
    return first <= last + kSlack;
  }

 private:
  static constexpr double kFar = 1e9;     // no direction is so short that a grid lies beyond it
  static constexpr double kSlack = 1e-6;  // far more than a quotient of these numbers is rounded

  rule::SourceKind kind_;
  rule::Triple at_, way_;
  rule::Triple low_{}, high_{};  // the box, wider by the beam's width
};

}  // namespace voxmelt::visibility
