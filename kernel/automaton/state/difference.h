// Where two volumes of one size differ.
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

// Of the cells x fastest, and of a cell the fields in the order of their table; none where all are equal.
std::optional<Difference> first_difference(const Volume& expected, const Volume& actual);

// Does this cell have the same number in every field?
bool same_cell(const Volume& a, const Volume& b, int x, int y, int z);

}  // namespace voxmelt::state
