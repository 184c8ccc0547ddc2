// Two volumes of one size are compared cell by cell and field by field.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

struct Difference {
  int x = 0, y = 0, z = 0;
  std::string_view field;
  std::uint32_t expected = 0, actual = 0;
};
std::string text_of(const Difference& difference);  // "heat at 1, 2, 3: expected 4, is 5"

// Returns the first difference, or none. Cells come x fastest, and the fields of a cell in the order of their
// table.
std::optional<Difference> first_difference(const Volume& expected, const Volume& actual);

// Tells if this cell has the same number in every field.
bool same_cell(const Volume& a, const Volume& b, int x, int y, int z);

}  // namespace voxmelt::state
