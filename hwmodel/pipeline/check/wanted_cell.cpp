#include "hwmodel/pipeline/check/wanted_cell.h"

#include <algorithm>
#include <cstdint>

#include "hwmodel/pipeline/model/volume_port.h"

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

}  // namespace

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
