// What stands on each column of the grid, and how far its surface is moved to be drawn smooth.
//
// The ground is the inert cells that reach up from y = 0, no higher than the terrain where that is known.
// Every other inert cell is part of an obstacle, which is drawn like a solid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/scene/shape/terrain.h"

namespace voxmelt::render {

inline constexpr int kGroundReach = 2;  // columns around matter whose ground is filled

// Columns are [z][x]; heights below one cell in rule::kOne.
struct Columns {
  int x = 0, z = 0;
  std::vector<std::int32_t> bed;     // cells of ground, counted up from y = 0
  std::vector<std::int32_t> top;     // the first cell above ground and obstacles
  std::vector<std::int32_t> offset;  // of the true ground from the top face of its cell
  std::vector<std::int32_t> wet;     // 0..kOne: covered by matter or an obstacle
  std::vector<std::int32_t> shift;   // by which the puddle moves, to smooth its terraces
  std::vector<std::uint8_t>
      distance;                // to the nearest wet column, 0..kGroundReach, kGroundReach + 1: farther
  std::vector<float> ground;   // height of the ground in cells, 0 where there is none
  std::vector<float> wetness;  // 0 dry ground .. 1 covered by at least a thin film
  bool obstacles = false;      // whether there are any

  std::size_t at(int cx, int cz) const {
    return static_cast<std::size_t>(cz) * static_cast<std::size_t>(x) + static_cast<std::size_t>(cx);
  }
};

// Heights for every column of the grid: only then a terrain says what is ground. All zero: nothing is.
bool fits(const scene::Terrain& terrain, const state::Grid& grid);

// `smooth`: how much the terraces of puddles are smoothed, 0: not at all. A terrain that does not fit counts
// as none.
Columns find_columns(const state::Volume& volume, int smooth, const scene::Terrain& terrain,
                     cpu::Workers& workers);

// The amount of matter in a cell, 0..kOne; 0 above the grid.
std::int32_t matter_amount(const state::Volume& volume, int x, int y, int z);

// The cell in which the puddle of a column begins: on the bed, or else on the highest obstacle.
int puddle_floor(const state::Volume& volume, const Columns& columns, int x, int z);

}  // namespace voxmelt::render
