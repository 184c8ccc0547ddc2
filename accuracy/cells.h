// These functions write start states from formulas, cell by cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy {

inline constexpr double kOne = 4096;       // amount of a full cell
inline constexpr double kFlatBed = 2048;   // amount of an inert cell with its surface at its upper face
inline constexpr double kHottest = 65535;  // heat at the top of a scene's range

template <class Visit>  // visit(x, y, z), x fastest
void for_each_cell(state::Grid grid, const Visit& visit) {
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) visit(x, y, z);
}

inline std::uint16_t to_units(double value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 65535.0)));
}

// Puts a full solid cell. `heat` is in the units of the state, 0..65535.
inline void put_solid(state::Volume& volume, int x, int y, int z, double heat = 0) {
  const state::Slot cell = volume.at(x, y, z);
  volume.solid.set(x, y, z, true);
  volume.amount[cell] = to_units(kOne);
  volume.heat[cell] = to_units(heat);
}

// Puts liquid. `amount` is in cells; if it rounds to 0, the cell stays empty.
inline void put_liquid(state::Volume& volume, int x, int y, int z, double amount) {
  const std::uint16_t units = to_units(amount * kOne);
  volume.amount[volume.at(x, y, z)] = units;
  volume.liquid.set(x, y, z, units > 0);
}

// Puts an inert cell. `rise` says how far its surface lies above its upper face, in cells, -1/2 to 1/2.
inline void put_inert(state::Volume& volume, int x, int y, int z, double rise = 0) {
  volume.inert.set(x, y, z, true);
  volume.amount[volume.at(x, y, z)] = to_units(std::min(kFlatBed + rise * kOne, kOne - 1));
}

// Puts a column of liquid `depth` cells deep, its first cell at y = bottom.
inline void put_column(state::Volume& volume, int x, int z, double depth, int bottom = 0) {
  for (int y = bottom; y < volume.grid.y && y - bottom < depth; ++y)
    put_liquid(volume, x, y, z, std::min(1.0, depth - (y - bottom)));
}

// Puts a column of inert cells with its surface at `height`, and `depth` of liquid on it.
inline void put_column_on_bed(state::Volume& volume, int x, int z, double height, double depth) {
  const int top = static_cast<int>(std::lround(height));
  for (int y = 0; y < top; ++y) put_inert(volume, x, y, z, y + 1 == top ? height - top : 0);
  put_column(volume, x, z, depth, top);
}

}  // namespace voxmelt::accuracy
