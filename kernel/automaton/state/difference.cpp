#include "kernel/automaton/state/difference.h"

#include "kernel/automaton/state/fields.h"

namespace voxmelt::state {
namespace {

// A field that a volume lacks is 0 in all of its cells.
template <class Column>
std::uint32_t value_or_0(const Column& column, int x, int y, int z) {
  return column.empty() ? 0 : value_at(column, x, y, z);
}

std::optional<Difference> difference_at(const Volume& expected, const Volume& actual, int x, int y, int z) {
  std::optional<Difference> found;
  for_each_field([&](const auto& row) {
    const std::uint32_t a = value_or_0(expected.*row.column, x, y, z),
                        b = value_or_0(actual.*row.column, x, y, z);
    if (!found && a != b) found = Difference{x, y, z, row.name, a, b};
  });
  return found;
}

}  // namespace

std::string text_of(const Difference& d) {
  return std::string(d.field) + " at " + std::to_string(d.x) + ", " + std::to_string(d.y) + ", " +
         std::to_string(d.z) + ": expected " + std::to_string(d.expected) + ", is " +
         std::to_string(d.actual);
}

std::optional<Difference> first_difference(const Volume& expected, const Volume& actual) {
  if (expected == actual) return {};  // the usual case, compared page by page
  const Grid g = expected.grid;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x)
        if (const auto found = difference_at(expected, actual, x, y, z)) return found;
  return {};
}

bool same_cell(const Volume& a, const Volume& b, int x, int y, int z) {
  return !difference_at(a, b, x, y, z);
}

}  // namespace voxmelt::state
