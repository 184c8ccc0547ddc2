#include "hwmodel/pipeline/check/wanted_cell.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>

#include "hwmodel/pipeline/model/volume_port.h"
#include "kernel/automaton/state/fields.h"

namespace voxmelt::hwmodel {
namespace {

constexpr std::int64_t kBareFlank = std::int64_t{1} << 21;

void add_bands(const SideBands& bands, int x, int y, int z, state::Slot at, Cell& cell) {
  if (bands.pattern != nullptr) cell.pattern = (*bands.pattern)[at];
  if (bands.axes != nullptr) cell.exposed_axes = bands.axes->exposed_axes(at);
  if (bands.sides != nullptr && (bands.sides_of_blocked || !cell.blocked()))
    cell.beside_wall = bands.sides->beside_wall(at);
  if (bands.touched != nullptr) cell.touches = bands.touched->touches(at);
  if (bands.set != nullptr) cell.set = bands.set->test(x, y, z);
  const ShownRuns::Run* run = bands.runs != nullptr ? bands.runs->at(x, y, z) : nullptr;
  if (run == nullptr) return;
  cell.in_run = 1;
  if (!bands.shown) return;
  cell.head = run->head;
  cell.limit = run->limit;
  cell.mobility = std::max(run->mobility, run->exposed);
  cell.dead = run->dead;
  cell.shut = run->shut;
}

bool same(const state::BitPlane& a, const state::BitPlane& b, int x, int cells, int y, int z) {
  const std::span<const std::uint64_t> left = a.row(y, z), right = b.row(y, z);
  std::uint64_t differ = 0;
  for (int i = x; i < x + cells; ++i) differ |= (left[i / 64] ^ right[i / 64]) >> (i % 64) & 1;
  return differ == 0;
}

template <class T>
bool same(const state::Field<T>& a, const state::Field<T>& b, int x, int cells, int y, int z) {
  if (a.empty() || b.empty()) return a.empty() == b.empty();
  const T* const row = a.row(y, z) + x;
  return std::equal(row, row + cells, b.row(y, z) + x);
}

}  // namespace

bool same_cells(const state::Volume& a, const state::Volume& b, int x, int cells, int y, int z) {
  return std::apply(
      [&](const auto&... row) { return (same(a.*row.column, b.*row.column, x, cells, y, z) && ...); },
      state::kFields);
}

Cell wanted_cell(const state::Volume& volume, int x, int y, int z) {
  const state::Slot at = volume.at(x, y, z);
  Cell cell;
  if (volume.solid.test(x, y, z))
    cell.state = State::solid;
  else if (volume.liquid.test(x, y, z))
    cell.state = State::liquid;
  else if (!volume.inert.test(x, y, z))
    cell.state = State::air;
  read_numbers(volume, at, cell);
  return cell;
}

Cell wanted_cell(const Expected& expected, int x, int y, int z) {
  Cell cell = wanted_cell(*expected.after, x, y, z);
  add_bands(expected.bands, x, y, z, expected.after->at(x, y, z), cell);
  return cell;
}

std::int64_t usable_mobility(const Cell& cell) {
  return std::min<std::int64_t>(cell.mobility, std::max(std::int64_t{cell.limit} << 8, kBareFlank));
}

}  // namespace voxmelt::hwmodel
