// Only the native variant asks if there is anything in a row along x.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "measure/baseline/fields.h"

namespace voxmelt::baseline {

// Tells if a row has a flag. `first` is the index of the row's cell x = 0; flags are 0 or 1.
template <class Real>
[[gnu::always_inline]] inline bool row_has(const Fields<Real>& f, const std::vector<std::uint8_t>& flags,
                                           std::size_t first) {
  return std::memchr(flags.data() + first, 1, f.grid.x) != nullptr;
}
template <class Real>
[[gnu::always_inline]] inline bool row_has_matter(const Fields<Real>& f, std::size_t first) {
  return row_has(f, f.liquid, first) || row_has(f, f.solid, first);
}

// Tells if the row is marked, or a row that touches it in the same layer, or (`all_around`) any of the eight
// around it.
template <class Real>
[[gnu::always_inline]] inline bool marked_near(const Fields<Real>& f, std::size_t first, bool all_around) {
  const std::uint8_t* mark = f.row_marks.data() + first / f.row;
  const std::ptrdiff_t layer = f.slice / f.row;
  const auto beside = [=](std::ptrdiff_t dy) { return mark[dy - layer] || mark[dy] || mark[dy + layer]; };
  return beside(0) || (all_around && (beside(-1) || beside(1)));
}

}  // namespace voxmelt::baseline
