#include "hwmodel/pipeline/check/wanted_air.h"

#include <cstddef>
#include <cstring>
#include <iterator>
#include <span>

#include "kernel/automaton/state/fields.h"

namespace voxmelt::hwmodel {
namespace {

using Row = std::span<std::uint64_t>;

void add(const state::BitPlane& plane, int y, int z, Row holds) {
  const std::span<const std::uint64_t> row = plane.row(y, z);
  for (std::size_t w = 0; w < holds.size(); ++w) holds[w] |= row[w];
}

// Looks at 8 bytes at a time, and marks all of their cells if one is not 0. Rows are padded to 64 cells.
template <class T>
void add(const state::Field<T>& field, int y, int z, Row holds) {
  if (field.empty()) return;
  constexpr std::size_t kAtOnce = sizeof(std::uint64_t) / sizeof(T);
  const T* const row = field.row(y, z);
  for (std::size_t x = 0; x < 64 * holds.size(); x += kAtOnce) {
    std::uint64_t numbers = 0;
    std::memcpy(&numbers, row + x, sizeof(numbers));
    if (numbers != 0) holds[x / 64] |= ((std::uint64_t{1} << kAtOnce) - 1) << (x % 64);
  }
}

void add(const SideBands& bands, const state::Grid& grid, const state::Layout& layout, int y, int z,
         Row holds) {
  if (bands.pattern != nullptr) add(*bands.pattern, y, z, holds);
  if (bands.set != nullptr) add(*bands.set, y, z, holds);
  const bool around = bands.axes != nullptr || bands.sides != nullptr || bands.touched != nullptr;
  if (!around && bands.runs == nullptr) return;
  for (int x = 0; x < grid.x; ++x) {
    const state::Slot at = layout.at(x, y, z);
    const bool any = (bands.axes != nullptr && bands.axes->exposed_axes(at) != 0) ||
                     (bands.sides != nullptr && bands.sides->beside_wall(at)) ||
                     (bands.touched != nullptr && bands.touched->touches(at)) ||
                     (bands.runs != nullptr && bands.runs->at(x, y, z) != nullptr);
    holds[x / 64] |= std::uint64_t{any} << (x % 64);
  }
}

// Returns true if no bit of `count` is set from `first` on. A bit beyond the row counts as set.
bool none(Row holds, int first, int count) {
  for (int x = first; x < first + count; ++x)
    if (x / 64 >= std::ssize(holds) || (holds[x / 64] >> (x % 64) & 1) != 0) return false;
  return true;
}

}  // namespace

void WantedAir::look(const Expected& expected, const Shape& shape, const Place& place) {
  of_ = &expected;
  z_ = place.z;
  left_ = place.left;
  air_.assign(shape.plane(), 0);
  const state::Volume& volume = *expected.after;
  for (int y = 0; y < shape.grid.y; ++y) {
    holds_.assign(volume.solid.row_words(), 0);
    state::for_each_field([&](const auto& row) { add(volume.*row.column, y, z_, holds_); });
    add(expected.bands, shape.grid, volume.amount.layout(), y, z_, holds_);
    for (int block = 0; block < shape.blocks(); ++block) {
      const int x = left_ + block * shape.lanes;
      const bool air = x + shape.lanes <= shape.grid.x && none(holds_, x, shape.lanes);
      air_[block * shape.column() + y] = air ? 1 : 0;
    }
  }
}

}  // namespace voxmelt::hwmodel
