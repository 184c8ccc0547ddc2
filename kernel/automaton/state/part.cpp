#include "kernel/automaton/state/part.h"

#include <type_traits>

#include "kernel/automaton/state/fields.h"

namespace voxmelt::state {
namespace {

template <class Visit>  // visit(x, y, z), x fastest
void for_each_cell(const Box& box, const Visit& visit) {
  for (int z = box.from[2]; z < box.from[2] + box.size[2]; ++z)
    for (int y = box.from[1]; y < box.from[1] + box.size[1]; ++y)
      for (int x = box.from[0]; x < box.from[0] + box.size[0]; ++x) visit(x, y, z);
}

}  // namespace

Volume part_of(const Volume& volume, const Box& box) {
  Volume part;
  part.grid = {box.size[0], box.size[1], box.size[2]};
  for_each_field([&](const auto& row) {
    const auto& from = volume.*row.column;
    if (from.empty()) return;
    auto& to = part.*row.column;
    to = std::remove_reference_t<decltype(to)>(part.grid);
    for_each_cell(box, [&](int x, int y, int z) {
      set_value(to, x - box.from[0], y - box.from[1], z - box.from[2], value_at(from, x, y, z));
    });
  });
  return part;
}

void clear(Volume& volume, const Box& box) {
  for_each_field([&](const auto& row) {
    auto& column = volume.*row.column;
    if (column.empty()) return;
    for_each_cell(box, [&](int x, int y, int z) { set_value(column, x, y, z, 0); });
  });
}

bool holds_something(const Volume& volume, const Box& box) {
  bool any = false;
  for_each_cell(box, [&](int x, int y, int z) {
    any = any || volume.solid.test(x, y, z) || volume.liquid.test(x, y, z) || volume.inert.test(x, y, z);
  });
  return any;
}

}  // namespace voxmelt::state
